#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <set>

#include "cli/commands.h"
#include "cli/grown.h"
#include "cli/picture.h"
#include "cli/progress_display.h"
#include "cli/replacing.h"
#include "cli/version.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "core/write_protection.h"
#include "exchange/file_output.h"
#include "exchange/gltf_writer.h"
#include "exchange/scene_files.h"
#include "scene/model_builder.h"
#include "scene/project_file.h"

namespace bosquet::cli {
namespace {

using std::filesystem::path;

// Everything a writer may need of a run.
struct Made {
  const scene::GrownScene& grown;
  const scene::BuiltModel& built;
  const Options& options;
  Progress& progress;
  std::map<std::string, std::vector<std::string>>& required;  ///< extensions, by output
  std::vector<std::string>& warnings;
};
using Writer = Result<std::uint64_t> (*)(const Made&, const path&);

// 0 for what is no regular file, such as a pipe.
std::uint64_t size_of(const path& file) {
  std::error_code ec;
  return std::filesystem::is_regular_file(file, ec) ? std::filesystem::file_size(file, ec) : 0;
}

Result<std::uint64_t> write_model(const Made& made, const path& target) {
  const exchange::TextureCache cache = exchange::TextureCache::of_user();
  exchange::GltfOptions options;
  options.version = kVersion;
  options.textures = &cache;
  options.progress = &made.progress;
  options.instancing = made.options.instancing;
  options.compression = made.options.compression;
  options.lod = made.options.lod;
  auto written = exchange::write_gltf(made.built.model, target, options);
  if (!written) return written.error();
  if (!written->required_extensions.empty()) made.required[target.string()] = written->required_extensions;
  return written->bytes;
}

Result<std::uint64_t> write_png(const Made& made, const path& target) {
  made.progress.begin("picture", 1);
  if (auto drawn = write_picture(made.built, made.grown, made.options, target); !drawn) return drawn.error();
  return size_of(target);
}

Result<std::uint64_t> write_project_file(const Made& made, const path& target) {
  return scene::write_project(made.grown.given, target, way_between(target, made.options.file));
}

Result<std::uint64_t> write_file_of_scene(const Made& made, const path& target) {
  auto written = exchange::write_scene_file(made.grown, {made.options.file.stem().string(), made.options.tree}, target);
  if (!written) return written.error();
  made.warnings.insert(made.warnings.end(), written->warnings.begin(), written->warnings.end());
  return written->bytes;
}

struct Format {
  std::string_view ending;
  Writer write;
};
// Made of meshes.
constexpr Format kMeshFormats[] = {{".glb", write_model}, {".gltf", write_model}, {".png", write_png}};

Writer writer_of(const path& target) {
  if (exchange::writes_scene_file(target)) return write_file_of_scene;
  const std::string ending = exchange::lower_ending(target);
  for (const Format& format : kMeshFormats)
    if (format.ending == ending) return format.write;
  return ending == ".bosquet" ? write_project_file : nullptr;
}

bool is_made_of_meshes(const path& target) {
  const Writer writer = writer_of(target);
  return writer == write_model || writer == write_png;
}

bool is_model_file(const path& target) { return writer_of(target) == write_model; }

Result<void> check_folder(const path& target) {
  const path folder = target.has_parent_path() ? target.parent_path() : path(".");
  std::error_code ec;
  if (!std::filesystem::is_directory(folder, ec))
    return Error{fmt::format("{}: the folder {} does not exist; make it first", target.string(), folder.string())};
  if (std::filesystem::exists(target, ec) && !std::filesystem::is_regular_file(target, ec) &&
      !std::filesystem::is_character_file(target, ec))
    return Error{fmt::format("{}: is no regular file", target.string())};
  if (::access(folder.c_str(), W_OK) != 0)
    return Error{fmt::format("{}: no permission to write in {}", target.string(), folder.string())};
  return check_replaceable(target);
}

constexpr const char* kKnownOutputs =
    ".glb .gltf .png .plan.png .svg .dxf .csv .species.csv .gpkg .geojson .shp .vdb .tree.json .bosquet .toml";

Result<void> check_kind(const path& target, bool picture_only) {
  std::error_code ec;
  const char* known = picture_only ? ".png" : kKnownOutputs;
  if (std::filesystem::is_directory(target, ec))
    return Error{fmt::format("{}: is a folder; name a file in it, its ending one of: {}", target.string(), known)};
  if (picture_only ? exchange::lower_ending(target) == ".png" : writer_of(target) != nullptr) return {};
  if (target.extension().empty())
    return Error{fmt::format("{}: has no ending, which tells what to write; known: {}", target.string(), known)};
  return Error{
      fmt::format("{}: unknown kind of output '{}'; known: {}", target.string(), target.extension().string(), known)};
}

// What can be known to fail is refused before anything grows.
Result<void> check_targets(const Options& options) {
  std::set<path> seen;
  const auto is_tree = [](const path& target) { return exchange::lower_ending(target) == ".json"; };
  for (const path& target : options.outputs) {
    const bool render = options.command == Command::render;
    const std::string ending = exchange::telling_ending(target);
    if (is_tree(target) && !render && (!options.tree || ending != ".tree.json"))
      return Error{fmt::format("{}: a tree is saved with --tree ID as NAME.tree.json", target.string())};
    if (auto fine = check_kind(target, render); !fine) return fine;
    if (render && ending == ".plan.png" && options.view != ViewKind::trees)
      return Error{
          fmt::format("{}: is a plan sheet, which knows no --view; a picture of that view takes another name, "
                      "such as {}.png",
                      target.string(), target.stem().stem().string())};
    if (auto fine = check_folder(target); !fine) return fine;
    // What is read is refused as such when its names are known.
    if (std::error_code ec; !std::filesystem::equivalent(target, options.file, ec))
      if (auto fine = check_replacing(target, options.file, options.replace); !fine) return fine;
    if (!seen.insert(std::filesystem::absolute(target).lexically_normal()).second)
      return Error{fmt::format("{}: is asked for twice", target.string())};
  }
  if (options.wind && options.instancing) return Error{std::string(exchange::kNoWindOfInstances)};
  if (options.tree && std::none_of(options.outputs.begin(), options.outputs.end(), is_tree))
    return Error{fmt::format("--tree {}: needs an output that it goes into, -o NAME.tree.json", *options.tree)};
  return options.report.empty() ? Result<void>() : check_folder(options.report);
}

bool some_output(const Options& options, const auto& fits) {
  return std::any_of(options.outputs.begin(), options.outputs.end(), fits);
}

// What a picture may take where no budget is asked for.
constexpr std::size_t kPictureTriangles = 6'000'000;

// Internodes of trees that are meshed, whose memory goes back to the system at once; some 4 MB.
constexpr std::size_t kGivenBackAtOnce = 100'000;

bool grows_meshes(const Options& options) {
  return some_output(options, [](const path& p) { return is_made_of_meshes(p); });
}

Result<void> make(const Options& options, Report& report, Progress& progress) {
  Stopwatch total;
  const bool plain_view = options.command == Command::render && options.view != ViewKind::trees;
  // Meshes take most of the memory: what no output asks for any more makes room.
  const bool only_meshes = !plain_view && !some_output(options, [](const path& p) { return !is_made_of_meshes(p); });
  auto grown = grow_recipe(options, only_meshes, report, progress);
  if (!grown) return grown.error();

  scene::BuiltModel built;
  if (plain_view) {
    auto view = view_model(*grown, options);
    if (!view) return view.error();
    built.model = std::move(*view);
  } else if (grows_meshes(options)) {
    if (!some_output(options, [](const path& p) { return exchange::telling_ending(p) == ".vdb"; }))
      grown->space = {}, grown->light = {};
    scene::ModelOptions model{options.season, options.foliage,
                              options.max_triangles.value_or(grown->document.max_triangles)};
    // A model for a picture alone is made for what is seen in it, and files keep to their budget.
    if (!some_output(options, is_model_file)) {
      model.picture = picture_camera(grown->document, options);
      model.picture_height = options.height;
      if (!options.max_triangles && model.max_triangles > 0)
        model.max_triangles = std::max(model.max_triangles, kPictureTriangles);
    }
    const scene::PaintingCache paintings(exchange::TextureCache::of_user().folder());
    model.paintings = &paintings;
    model.wind = options.wind;
    model.grass = grown->document.ground_cover.in_files && some_output(options, is_model_file);
    model.levels = options.lod != exchange::LodFiles::none;
    std::atomic<std::size_t> given_up = 0;  // internodes
    if (only_meshes)
      model.meshed = [&](std::size_t tree) {
        auto& skeleton = grown->trees[tree].skeleton;
        const std::size_t internodes = skeleton->size(), before = given_up.fetch_add(internodes);
        skeleton.reset();
        if (before / kGivenBackAtOnce != (before + internodes) / kGivenBackAtOnce) give_back_freed_memory();
      };
    give_back_freed_memory();
    auto meshes = scene::build_model(*grown, model, &progress);

    if (!meshes) return meshes.error();
    give_back_freed_memory();
    built = std::move(*meshes);
  }
  report.leaves = built.leaf_cards;
  report.triangles = built.triangles;
  report.mesh_bytes = built.mesh_bytes;
  report.seconds.insert(built.seconds.begin(), built.seconds.end());

  Stopwatch exporting;
  const Made made{*grown, built, options, progress, report.required_extensions, report.warnings};
  for (const path& target : options.outputs) {
    if (progress.cancelled()) return cannot_finish(fmt::format("cancelled; {} was not written", target.string()));
    auto bytes = writer_of(target)(made, target);
    if (!bytes) return bytes.error();
    report.bytes.emplace_back(target.string(), *bytes);
  }
  report.seconds["export"] = exporting.seconds();
  report.seconds["total"] = total.seconds();
  report.threads = working_threads();
  return {};
}

std::string readable_bytes(std::uint64_t bytes) {
  return bytes >= 1'000'000 ? fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6)
                            : fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
}

// "park.plan.png" at 15 is "park-15.plan.png".
path of_year(const path& target, float year) {
  const std::string name = target.filename().string();
  std::size_t end = name.size() - target.extension().string().size();
  for (const std::string_view inner : {".plan", ".tree", ".species"})
    if (const std::string_view stem = std::string_view(name).substr(0, end); stem.ends_with(inner)) {
      end -= inner.size();
      break;
    }
  return target.parent_path() / fmt::format("{}-{:g}{}", name.substr(0, end), year, name.substr(end));
}

// What was made, in words for the person.
Result<std::string> make_and_report(const Options& options) {
  Report report;
  report.program_mb = peak_rss_mb();
  Progress progress;
  Result<void> done;
  {
    ProgressDisplay display(progress, options.quiet);
    run_with_threads(options.threads, [&] { done = make(options, report, progress); });
  }
  print_warnings(report.warnings, options.quiet);
  if (!done) return done.error();
  if (!options.report.empty())
    if (auto written = write_report(options.report, report); !written) return written.error();
  std::string words;
  if (options.quiet) return words;
  words = fmt::format("{}, {} internodes", count_of(report.trees, "tree"), report.internodes);
  if (report.triangles > 0) words += fmt::format(", {} triangles", report.triangles);
  words += fmt::format(" in {:.1f} s\n", report.seconds["total"]);
  if (report.removed > 0)
    words += fmt::format("{} more to be removed, so not grown; schedules and plans list {}\n",
                         count_of(report.removed, "tree"), report.removed == 1 ? "it" : "them");
  for (const auto& [output, bytes] : report.bytes) {
    const auto required = report.required_extensions.find(output);
    words += fmt::format("{}  {}{}\n", output, readable_bytes(bytes),
                         required == report.required_extensions.end()
                             ? ""
                             : fmt::format("; opens only in programs that know {}", fmt::join(required->second, ", ")));
  }
  return words;
}

Result<void> make_and_print(const Options& options) {
  auto words = make_and_report(options);
  if (!words) return words.error();
  fmt::print("{}", *words);
  return {};
}

}  // namespace

Result<void> run_make(const Options& options) {
  if (options.years.size() < 2) {
    if (auto fine = check_targets(options); !fine) return fine;
    return make_and_print(options);
  }
  scene::SkeletonCache skeletons;  // years only change how much of a tree is shown
  // The oldest first: its trees are the largest, and what shows them shows all.
  std::vector<float> years = options.years;
  std::sort(years.begin(), years.end(), std::greater());
  const auto camera = std::make_shared<std::optional<scene::Camera>>();
  std::vector<Options> all;
  for (const float year : years) {
    Options& at = all.emplace_back(options);
    at.set_camera = camera;
    at.grow.year = year;
    at.grow.skeletons = &skeletons;
    for (path& target : at.outputs) target = of_year(target, year);
    if (!at.report.empty()) at.report = of_year(at.report, year);
    if (auto fine = check_targets(at); !fine) return fine;
  }
  std::map<float, std::string> made;
  Result<void> done;
  for (const Options& at : all) {
    auto words = make_and_report(at);
    if (!words) {
      done = words.error();
      break;
    }
    made[*at.grow.year] = std::move(*words);
  }
  // Told in the order that was asked for.
  for (const float year : options.years)
    if (const auto words = made.find(year); words != made.end()) fmt::print("{}", words->second);
  return done;
}

Result<void> run_render(const Options& options) {
  if (auto fine = check_targets(options); !fine) return fine;
  return make_and_print(options);
}

}  // namespace bosquet::cli
