#include "exchange/recipe_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "exchange/csv.h"
#include "exchange/file_output.h"
#include "exchange/ground_rasters.h"
#include "exchange/reference_system.h"
#include "exchange/tree_file.h"
#include "scene/project_trees.h"

namespace bosquet::exchange {
namespace {

using std::filesystem::path;

constexpr std::uint64_t kMostTableBytes = std::uint64_t{4} << 30;

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

template <class Number>
std::string number(Number v) {
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", v);
  // TOML knows whole and other numbers apart; here all are the latter.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

// Whole numbers of TOML have 63 bits; larger ones are texts.
std::string natural(std::uint64_t v) {
  return v > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) ? fmt::format("\"{}\"", v)
                                                                                  : fmt::format("{}", v);
}

std::string point(Vec2 p) { return fmt::format("[{}, {}]", number(p.x), number(p.y)); }

std::string points(const std::vector<Vec2>& all) {
  std::string out = "[";
  for (Vec2 p : all) out += (out.size() > 1 ? ", " : "") + point(p);
  return out + "]";
}

// Visitor that writes described fields as TOML; tables come after the keys.
struct TomlText {
  std::string table;  ///< name of the table that the fields stand in
  std::string keys, below;

  void operator()(const Real& r, float v) { keys += fmt::format("{} = {}\n", r.name, number(v)); }
  void operator()(const Real& r, double v) { keys += fmt::format("{} = {}\n", r.name, number(v)); }
  void operator()(const Whole& w, int v) { keys += fmt::format("{} = {}\n", w.name, v); }
  void operator()(const Switch& s, bool v) { keys += fmt::format("{} = {}\n", s.name, v); }
  void operator()(const Text& t, const std::string& v) { keys += fmt::format("{} = {}\n", t.name, toml_text(v)); }
  void operator()(const Colour& c, const Vec3& v) {
    // Six hex digits where they tell it, else three numbers.
    const IVec3 bytes(v * 255.0f + 0.5f);
    if (Vec3(bytes) / 255.0f == v)
      keys += fmt::format("{} = \"{:02X}{:02X}{:02X}\"\n", c.name, bytes.x, bytes.y, bytes.z);
    else
      keys += fmt::format("{} = [{}, {}, {}]\n", c.name, number(v.x), number(v.y), number(v.z));
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& c, Enum v) {
    keys += fmt::format("{} = \"{}\"\n", c.name, c.names[static_cast<std::size_t>(v)]);
  }
  template <class Item>
  void operator()(const Tables& t, const std::vector<Item>& items) {
    for (const Item& item : items) {
      TomlText one{fmt::format("{}.{}", table, t.name), {}, {}};
      describe(item, one);
      below += fmt::format("\n[[{}]]\n{}{}", one.table, one.keys, one.below);
    }
  }
};

template <class... Parts>
std::string table(const std::string& name, const Parts&... parts) {
  TomlText text{name, {}, {}};
  (describe(parts, text), ...);
  return fmt::format("\n[{}]\n{}{}", name, text.keys, text.below);
}

std::string species_text(const scene::Species& s) {
  const auto list = [](const std::vector<std::string>& all) {
    std::string out = "[";
    for (const std::string& text : all) out += (out.size() > 1 ? ", " : "") + toml_text(text);
    return out + "]";
  };
  std::string text =
      fmt::format("name = {}\nbotanical_name = {}\ncommon_names = {}\ngenus_words = {}\n", toml_text(s.name),
                  toml_text(s.botanical_name), list(s.common_names), list(s.genus_words));
  text += table("shape", s.shape) + table("planting", s.planting) + table("growth", s.growth) +
          table("look", s.look, s.foliage) + table("allometry", s.allometry);
  for (const scene::OpenGrownSize& size : s.sizes) {
    TomlText one{"size", {}, {}};
    describe(size, one);
    text += fmt::format("\n[[size]]\n{}", one.keys);
  }
  return text;
}

// A field of a CSV, in quotes where it needs them.
std::string field(const std::string& text) {
  const bool plain = text.find_first_of(",\"\n\r") == std::string::npos && text == std::string(text.c_str()) &&
                     (text.empty() || (text.front() != ' ' && text.back() != ' '));
  if (plain) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string tree_table_text(const scene::Document& document) {
  const std::vector<std::string> labels = scene::species_labels(document);
  std::string text = "id,species";
  for (const std::string& name : scene::tree_field_names()) text += fmt::format(",{}", name);
  text += '\n';
  for (const scene::Tree& tree : *document.trees) {
    text += fmt::format("{},{}", tree.id, field(labels[tree.species]));
    for (const std::string& value : scene::tree_fields(tree)) text += fmt::format(",{}", field(value));
    text += '\n';
  }
  return text;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    text += fmt::format("f {} {} {}\n", mesh.indices[i] + 1, mesh.indices[i + 1] + 1, mesh.indices[i + 2] + 1);
  return text;
}

class RecipeText {
 public:
  RecipeText(const scene::Document& document, const path& target)
      : d_(document),
        target_(target),
        folder_(target.parent_path() / (target.stem().string() + "-files")),
        place_(document.place) {}

  Result<WrittenRecipe> write() {
    std::error_code ec;
    std::filesystem::create_directories(folder_, ec);
    if (ec) return Error{fmt::format("{}: cannot be made ({})", folder_.string(), ec.message())};
    for (const auto step : {&RecipeText::site, &RecipeText::species, &RecipeText::trees, &RecipeText::obstacles,
                            &RecipeText::heroes, &RecipeText::settings})
      if (auto done = (this->*step)(); !done) return done.error();
    if (auto done = put(target_, text_); !done) return done.error();
    return std::move(out_);
  }

 private:
  Result<void> put(const path& file, const std::string& text) {
    auto written = write_file(file, text);
    if (!written) return written.error();
    out_.bytes += *written;
    return {};
  }
  void warn(std::string text) { out_.warnings.push_back(std::move(text)); }
  std::string beside(const std::string& name) const { return toml_text((folder_.filename() / name).generic_string()); }

  Result<void> site() {
    const Vec2 size = d_.terrain->size_m();
    const scene::Georeference& place = d_.place;
    const std::string corner = fmt::format("[{}, {}]", number(place.south_west.x), number(place.south_west.y));
    text_ += fmt::format("[site]\nsize_m = {}\n", point(size));
    text_ += fmt::format("seed = {}\n", natural(d_.seed));
    text_ += fmt::format("latitude_deg = {}\nlongitude_deg = {}\nsouth_west = {}\n", number(place.latitude_deg),
                         number(place.longitude_deg), corner);
    if (!place.crs_wkt.empty()) {
      // The reader takes planes in metres alone, and writes their definition in its own words.
      const auto read = reference_system(place.crs_wkt);
      const SystemFacts facts = system_facts(place.crs_wkt);
      if (read && !facts.geographic && std::abs(facts.metres_per_unit - 1) < 1e-9)
        text_ += fmt::format("crs = {}\n", toml_text(place.crs_wkt));
      else
        place_.crs_wkt.clear(),
            warn("the site's reference system is no plane in metres that is known, and is not in the recipe");
      if (read && *read != place.crs_wkt) warn("the site's reference system is told in other words in the recipe");
    }
    text_ += fmt::format("\n[terrain]\ndem = {}\ndem_south_west = {}\n", beside("ground.tif"), corner);
    const terrain::Terrain& ground = *d_.terrain;
    if (ground.water_level_m) text_ += fmt::format("water_level_m = {}\n", number(*ground.water_level_m));
    if (const auto usual = terrain::make_lattice(size); !usual || *usual != ground.height.lattice())
      warn(fmt::format("the ground's cells of {:g} m are not those of a recipe's site: it is resampled",
                       ground.height.cell_m()));
    if (auto done = raster("ground.tif", write_heights); !done) return done;
    if (!has_map(ground)) return {};
    text_ += fmt::format("\n[terrain.map]\nfile = {}\n", beside("map.tif"));
    for (std::size_t n = 1; n < ground.areas.count(); ++n) {
      const terrain::Area& area = ground.areas.all()[n];
      text_ += fmt::format("\n[[terrain.map.area]]\nname = {}\nkind = \"{}\"\ncover = \"{}\"\n", toml_text(area.name),
                           terrain::kAreaKindNames[static_cast<std::size_t>(area.kind)],
                           terrain::kCoverNames[static_cast<std::size_t>(area.cover)]);
      if (area.water_level_m) text_ += fmt::format("level_m = {}\n", number(*area.water_level_m));
    }
    return raster("map.tif", write_map);
  }

  template <class Write>
  Result<void> raster(const char* name, const Write& write) {
    if (auto done = write(*d_.terrain, place_, folder_ / name); !done) return done;
    std::error_code ec;
    out_.bytes += std::filesystem::file_size(folder_ / name, ec);
    return {};
  }

  Result<void> species() {
    const std::vector<std::string> labels = scene::species_labels(d_);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      scene::Species kind = *d_.species[i];
      kind.name = labels[i];
      const std::string name = fmt::format("species-{}.toml", i + 1);
      text_ += fmt::format("\n[[species]]\nname = {}\nfile = {}\n", toml_text(labels[i]), beside(name));
      if (kind.derived) text_ += "derived = true\n";
      if (labels[i] != d_.species[i]->name)
        warn(fmt::format("a species '{}' is '{}' in the recipe, where names differ", d_.species[i]->name, labels[i]));
      if (auto done = put(folder_ / name, species_text(kind)); !done) return done;
    }
    for (const distribution::Interaction& interaction : d_.interactions) {
      const auto known = [&](const std::string& name) {
        return std::find(labels.begin(), labels.end(), name) != labels.end() ||
               !scene::builtin_species_text(name).empty();
      };
      if (!known(interaction.of) || !known(interaction.on)) {
        warn(fmt::format("what '{}' does to '{}' is not in the recipe, which knows no such species", interaction.of,
                         interaction.on));
        continue;
      }
      TomlText one{"interaction", {}, {}};
      describe(interaction, one);
      text_ += "\n[[interaction]]\n" + one.keys;
    }
    return {};
  }

  Result<void> trees() {
    if (d_.trees->empty()) return {};
    text_ += fmt::format("\n[[planting]]\nname = \"trees\"\nkind = \"trees\"\nfile = {}\n", beside("trees.csv"));
    return put(folder_ / "trees.csv", tree_table_text(d_));
  }

  Result<void> obstacles() {
    for (std::size_t i = 0; i < d_.obstacles.size(); ++i) {
      const scene::Obstacle& o = d_.obstacles[i];
      text_ += fmt::format("\n[[obstacle]]\nid = {}\nname = {}\n", o.id, toml_text(o.name));
      if (o.outline) {
        text_ += fmt::format("polygon = {}\nlow_m = {}\nhigh_m = {}\n", points(o.outline->ring), number(o.low_y),
                             number(o.high_y));
        for (const auto& hole : o.outline->holes)
          text_ += fmt::format("[[obstacle.hole]]\npolygon = {}\n", points(hole));
        continue;
      }
      const std::string name = fmt::format("obstacle-{}.obj", i + 1);
      text_ += fmt::format("file = {}\non_ground = false\n", beside(name));
      if (auto done = put(folder_ / name, obj_text(*o.mesh)); !done) return done;
    }
    return {};
  }

  Result<void> heroes() {
    const std::vector<std::string> labels = scene::species_labels(d_);
    for (std::size_t i = 0; i < d_.heroes.size(); ++i) {
      const scene::HeroTree& h = d_.heroes[i];
      const std::string name = fmt::format("hero-{}.tree.json", i + 1);
      text_ += fmt::format("\n[[hero]]\nid = {}\nname = {}\nfile = {}\nat = {}\n", h.id, toml_text(h.name),
                           beside(name), point(h.at));
      const SavedTree saved{labels[h.species], d_.seed, h.key, 1.0f, 1.0f, *h.skeleton};
      auto written = write_tree(saved, d_.species[h.species]->growth, folder_ / name);
      if (!written) return written.error();
      out_.bytes += *written;
    }
    return {};
  }

  Result<void> settings() {
    text_ += table("space", d_.space) + table("asymmetry", d_.asymmetry) + table("light", d_.light);
    text_ += fmt::format("\n[sun]\nazimuth_deg = {}\nelevation_deg = {}\n", number(d_.sun.azimuth_deg),
                         number(d_.sun.elevation_deg));
    const auto place = [](const Vec3& p) {
      const Vec2 plan = to_plan(p);
      return fmt::format("[{}, {}, {}]", number(plan.x), number(plan.y), number(p.y));
    };
    for (const scene::Camera& camera : d_.cameras)
      text_ +=
          fmt::format("\n[[camera]]\nname = {}\neye = {}\ntarget = {}\non_ground = false\nfov_deg = {}\n",
                      toml_text(camera.name), place(camera.eye), place(camera.target), number(camera.vertical_fov_deg));
    for (const scene::Figure& figure : d_.figures)
      text_ += fmt::format("\n[[figure]]\nat = {}\nheading_deg = {}\n", point(figure.at), number(figure.heading_deg));
    text_ += table("clearance", d_.clearance) + table("plan", d_.plan) + table("ground_cover", d_.ground_cover);
    if (const scene::Underlay& underlay = d_.underlay; !underlay.file.empty()) {
      TomlText keys{"underlay", {}, {}};
      describe(underlay, keys);
      // By its way from the recipe, so that both can be moved together.
      const path file = std::filesystem::absolute(underlay.file).lexically_normal();
      const path way = file.lexically_relative(std::filesystem::absolute(target_).lexically_normal().parent_path());
      text_ += fmt::format("\n[underlay]\nfile = {}\nsouth_west = [{}, {}]\n{}",
                           toml_text((way.empty() ? file : way).generic_string()), number(underlay.south_west.x),
                           number(underlay.south_west.y), keys.keys);
    }
    const std::vector<std::string> labels = scene::species_labels(d_);
    for (const distribution::MixEntry& entry : d_.species_bar) {
      text_ += fmt::format("\n[[species_bar]]\nspecies = {}\nshare = {}\n", toml_text(labels[entry.species]),
                           number(entry.probability));
      if (entry.scale_min > 0.0f || entry.scale_max > 0.0f)
        text_ += fmt::format("scale = {}\n", point({entry.scale_min, entry.scale_max}));
    }
    text_ += fmt::format("\n[counters]\nnext_tree = {}\nnext_standing = {}\nnext_block = {}\n", d_.next_tree_id,
                         d_.next_standing_id, natural(d_.next_block));
    text_ += fmt::format("\n[export]\nmax_triangles = {}\n", d_.max_triangles);
    return {};
  }

  const scene::Document& d_;
  path target_, folder_;
  scene::Georeference place_;  ///< that the rasters have
  std::string text_;
  WrittenRecipe out_;
};

}  // namespace

Result<WrittenRecipe> write_recipe(const scene::Document& document, const path& target) {
  return RecipeText(document, target).write();
}

Result<std::vector<scene::Tree>> read_exact_trees(const path& file,
                                                  const std::vector<std::shared_ptr<const scene::Species>>& species) {
  auto bytes = read_file(file, kMostTableBytes);
  if (!bytes) return bytes.error();
  CsvReader reader(std::string_view(reinterpret_cast<const char*>(bytes->data()), bytes->size()), ',');
  std::vector<std::string> header, fields;
  if (!reader.next(header) || header.size() < 2 || header[0] != "id" || header[1] != "species")
    return Error{fmt::format("{}: is no table of trees; its columns begin with id and species", file.string())};
  const std::vector<std::string> known = scene::tree_field_names();
  for (std::size_t c = 2; c < header.size(); ++c)
    if (std::find(known.begin(), known.end(), header[c]) == known.end())
      return Error{fmt::format("{}: unknown column '{}'; known: id, species, {}", file.string(), header[c],
                               fmt::join(known, ", "))};

  std::vector<scene::Tree> trees;
  while (reader.next(fields)) {
    const auto wrong = [&](const std::string& what) {
      return Error{fmt::format("{}:{}: {}", file.string(), reader.line(), what)};
    };
    if (fields.size() != header.size())
      return wrong(fmt::format("{} columns are wanted, not {}", header.size(), fields.size()));
    scene::Tree tree;
    const auto [end, mistake] = std::from_chars(fields[0].data(), fields[0].data() + fields[0].size(), tree.id);
    if (mistake != std::errc() || end != fields[0].data() + fields[0].size() || tree.id < 1)
      return wrong(fmt::format("'{}' is no id, a whole number from 1 on", fields[0]));
    const auto kind = std::find_if(species.begin(), species.end(), [&](const auto& s) { return s->name == fields[1]; });
    if (kind == species.end()) return wrong(fmt::format("'{}' is no species of this recipe", fields[1]));
    tree.species = static_cast<std::size_t>(kind - species.begin());
    tree.key = hash_text("tree") + static_cast<std::uint64_t>(tree.id);
    for (std::size_t c = 2; c < header.size(); ++c)
      if (!scene::set_tree_field(tree, header[c], fields[c]))
        return wrong(fmt::format("'{}' is no value for {}", fields[c], header[c]));
    if (!(tree.scale_height > 0 && tree.scale_width > 0)) return wrong("a tree's scale must be above 0");
    trees.push_back(std::move(tree));
  }
  std::sort(trees.begin(), trees.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  for (std::size_t i = 1; i < trees.size(); ++i)
    if (trees[i].id == trees[i - 1].id)
      return Error{fmt::format("{}: two trees have the id {}", file.string(), trees[i].id)};
  return trees;
}

}  // namespace bosquet::exchange
