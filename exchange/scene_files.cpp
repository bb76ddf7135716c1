#include "exchange/scene_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "crowns/vdb.h"
#include "exchange/file_output.h"
#include "exchange/plan_drawing.h"
#include "exchange/recipe_write.h"
#include "exchange/schedule.h"
#include "exchange/tree_file.h"
#include "exchange/vector_writer.h"

namespace bosquet::exchange {
namespace {

using std::filesystem::path;
using Written = Result<WrittenSceneFile>;

Written written(Result<std::uint64_t> bytes) {
  if (!bytes) return bytes.error();
  return WrittenSceneFile{*bytes, {}};
}

Written write_plan(const scene::GrownScene& scene, const SceneFileOptions& options, const path& target) {
  auto plan = draw_plan(scene, options.title);
  if (!plan) return Error{fmt::format("{}: {}", target.string(), plan.error().message)};
  const std::string ending = lower_ending(target);
  if (ending == ".svg") return written(write_plan_svg(*plan, target));
  if (ending == ".dxf") return written(write_plan_dxf(*plan, target));
  return written(write_plan_png(*plan, target));
}

Written write_list(const scene::GrownScene& scene, const SceneFileOptions&, const path& target) {
  return written(write_schedule(target, tree_records(scene)));
}

Written write_sums(const scene::GrownScene& scene, const SceneFileOptions&, const path& target) {
  return written(write_summary(target, summarise(tree_records(scene))));
}

Written write_map(const scene::GrownScene& scene, const SceneFileOptions&, const path& target) {
  const scene::Document& document = scene.document;
  auto map = write_trees(target, tree_records(scene), document.place, DVec2(document.terrain->size_m()));
  if (!map) return map.error();
  return WrittenSceneFile{map->bytes, std::move(map->warnings)};
}

Written write_regions(const scene::GrownScene& scene, const SceneFileOptions&, const path& target) {
  const scene::Document& document = scene.document;
  std::vector<std::pair<std::int32_t, std::string>> names;
  for (const scene::Obstacle& o : document.obstacles) names.emplace_back(o.id, o.name);
  for (const scene::HeroTree& h : document.heroes) names.emplace_back(h.id, h.name);
  for (const scene::Tree& tree : *document.trees)
    names.emplace_back(tree.id, fmt::format("{}-{}", document.species_of(tree).name, tree.id));
  if (auto done = crowns::write_vdb(crowns::build_grid(scene.space), target, names); !done) return done.error();
  std::error_code ec;
  const bool file = std::filesystem::is_regular_file(target, ec);  // not a pipe
  return WrittenSceneFile{file ? std::filesystem::file_size(target, ec) : 0, {}};
}

Written write_one_tree(const scene::GrownScene& scene, const SceneFileOptions& options, const path& target) {
  if (!options.tree) return Error{fmt::format("{}: no tree was chosen", target.string())};
  const scene::Document& document = scene.document;
  std::int32_t last = 0;
  for (std::size_t i = 0; i < scene.trees.size(); ++i) {
    const scene::Tree& tree = (*document.trees)[i];
    last = std::max(last, tree.id);
    if (tree.id != *options.tree) continue;
    const scene::Species& species = document.species_of(tree);
    const SavedTree saved{species.name,      document.seed,    tree.key,
                          tree.scale_height, tree.scale_width, *scene.trees[i].skeleton};
    return written(write_tree(saved, species.growth, target));
  }
  return Error{fmt::format("{}: there is no tree {}; ids run from 1 to {}", target.string(), *options.tree, last)};
}

Written write_recipe_files(const scene::GrownScene& scene, const SceneFileOptions&, const path& target) {
  auto recipe = write_recipe(scene.given, target);
  if (!recipe) return recipe.error();
  return WrittenSceneFile{recipe->bytes, std::move(recipe->warnings)};
}

struct Kind {
  std::string_view ending;
  Written (*write)(const scene::GrownScene&, const SceneFileOptions&, const path&);
};
constexpr std::array<Kind, 11> kKindsOfFile{{{".plan.png", write_plan},
                                             {".svg", write_plan},
                                             {".dxf", write_plan},
                                             {".csv", write_list},
                                             {".species.csv", write_sums},
                                             {".gpkg", write_map},
                                             {".geojson", write_map},
                                             {".shp", write_map},
                                             {".vdb", write_regions},
                                             {".tree.json", write_one_tree},
                                             {".toml", write_recipe_files}}};

const Kind* kind_of(const path& file) {
  const std::string ending = telling_ending(file);
  const auto found =
      std::find_if(kKindsOfFile.begin(), kKindsOfFile.end(), [&](const Kind& kind) { return kind.ending == ending; });
  return found == kKindsOfFile.end() ? nullptr : &*found;
}

}  // namespace

std::string telling_ending(const path& file) {
  const std::string last = lower_ending(file), both = lower_ending(file.stem()) + last;
  return both == ".plan.png" || both == ".species.csv" || both == ".tree.json" ? both : last;
}

bool writes_scene_file(const path& file) { return kind_of(file) != nullptr; }

Result<WrittenSceneFile> write_scene_file(const scene::GrownScene& scene, const SceneFileOptions& options,
                                          const path& target) {
  const Kind* kind = kind_of(target);
  if (!kind) return Error{target.string() + ": ends in nothing that is known"};
  return kind->write(scene, options, target);
}

}  // namespace bosquet::exchange
