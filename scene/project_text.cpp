#include "scene/project_text.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scene/project_json.h"

namespace bosquet::scene {
namespace {

Json optional_json(const std::optional<float>& v) { return v ? json_number(*v) : Json(nullptr); }

Json settings_json(const Document& d) {
  Json json;
  json["seed"] = std::to_string(d.seed);
  json["place"] = {{"latitude_deg", json_number(d.place.latitude_deg)},
                   {"longitude_deg", json_number(d.place.longitude_deg)},
                   {"south_west", json_of(d.place.south_west)},
                   {"crs_wkt", d.place.crs_wkt}};
  json["space"] = described_json(d.space);
  json["space"]["keep_ticks"] = d.space.keep_ticks;
  json["asymmetry"] = described_json(d.asymmetry);
  json["light"] = described_json(d.light);
  json["sun"] = {{"azimuth_deg", json_number(d.sun.azimuth_deg)}, {"elevation_deg", json_number(d.sun.elevation_deg)}};
  json["clearance"] = described_json(d.clearance);
  json["plan"] = described_json(d.plan);
  json["underlay"] = described_json(d.underlay);
  json["underlay"]["file"] = d.underlay.file;
  json["underlay"]["south_west"] = json_of(d.underlay.south_west);
  json["ground_cover"] = described_json(d.ground_cover);
  json["max_triangles"] = d.max_triangles;
  json["next_tree_id"] = d.next_tree_id;
  json["next_standing_id"] = d.next_standing_id;
  json["next_block"] = std::to_string(d.next_block);
  return json;
}

void read_settings(JsonReader& in, Document& d) {
  in.word("seed", d.seed);
  if (const Json* json = in.find("place")) {
    JsonReader place(*json, in.where() + ".place", in.problems());
    place.number("latitude_deg", d.place.latitude_deg);
    place.number("longitude_deg", d.place.longitude_deg);
    place.vector("south_west", d.place.south_west);
    place.text("crs_wkt", d.place.crs_wkt);
  }
  read_described(in, "space", d.space);
  if (const Json* json = in.find("space")) {
    JsonReader space(*json, in.where() + ".space", in.problems());
    space.flag("keep_ticks", d.space.keep_ticks);
  }
  read_described(in, "asymmetry", d.asymmetry);
  read_described(in, "light", d.light);
  if (const Json* json = in.find("sun")) {
    JsonReader sun(*json, in.where() + ".sun", in.problems());
    sun.number("azimuth_deg", d.sun.azimuth_deg);
    sun.number("elevation_deg", d.sun.elevation_deg);
  }
  read_described(in, "clearance", d.clearance);
  read_described(in, "plan", d.plan);
  if (const Json* json = in.find("underlay")) {
    JsonReader underlay(*json, in.where() + ".underlay", in.problems());
    // No picture has no width.
    if (const Json* width = json->find("width_m") == json->end() ? nullptr : &(*json)["width_m"];
        width && *width != 0.0)
      describe(d.underlay, underlay);
    else
      underlay.number("opacity", d.underlay.opacity);
    underlay.text("file", d.underlay.file);
    underlay.vector("south_west", d.underlay.south_west);
  }
  // Files from before there was grass say nothing of it.
  read_described(in, "ground_cover", d.ground_cover);
  in.count("max_triangles", d.max_triangles);
  in.whole("next_tree_id", d.next_tree_id);
  in.whole("next_standing_id", d.next_standing_id);
  in.word("next_block", d.next_block);
}

Json ground_json(const terrain::Terrain& t) {
  const terrain::Lattice& lattice = t.height.lattice();
  Json json;
  json["size_m"] = json_of(lattice.size_m);
  json["cell_m"] = json_number(lattice.cell_m);
  json["cells"] = {lattice.cells.x, lattice.cells.y};
  json["water_level_m"] = optional_json(t.water_level_m);
  json["area_cells"] = {t.areas.grid().size().x, t.areas.grid().size().y};
  json["pond_cells"] = {t.ponds.size().x, t.ponds.size().y};
  return json;
}

// Whole numbers from 1 to what a grid may have.
bool read_cells(JsonReader& in, const char* name, IVec2& cells) {
  Vec2 read{1.0f};
  in.vector(name, read);
  for (int i = 0; i < 2; ++i)
    if (!(read[i] >= 1.0f && read[i] <= static_cast<float>(terrain::kMostCells)) || read[i] != std::floor(read[i]))
      return in.wrong(name), false;
  cells = IVec2(read);
  return true;
}

std::optional<GroundFrame> read_ground(JsonReader& in) {
  GroundFrame ground;
  terrain::Lattice& lattice = ground.lattice;
  Vec2 size{0.0f};
  float cell = 0;
  in.vector("size_m", size);
  in.number("cell_m", cell);
  for (float side : {size.x, size.y})
    if (!(side >= terrain::kLeastSite_m && side <= terrain::kLargestSite_m)) return in.wrong("size_m"), std::nullopt;
  if (!(cell > 0.0f && cell <= terrain::kLargestSite_m)) return in.wrong("cell_m"), std::nullopt;
  lattice.size_m = size, lattice.cell_m = cell;
  if (!read_cells(in, "cells", lattice.cells)) return {};
  in.number("water_level_m", ground.water_level_m);
  if (!read_cells(in, "area_cells", ground.areas)) ground.areas = IVec2{1};
  if (!read_cells(in, "pond_cells", ground.ponds)) ground.ponds = IVec2{1};
  return ground;
}

Json area_json(const terrain::Area& a) {
  Json json;
  json["name"] = a.name;
  json["kind"] = std::string(terrain::kAreaKindNames[static_cast<std::size_t>(a.kind)]);
  json["cover"] = std::string(terrain::kCoverNames[static_cast<std::size_t>(a.cover)]);
  json["water_level_m"] = optional_json(a.water_level_m);
  return json;
}

void read_area(JsonReader& in, terrain::Area& a) {
  in.text("name", a.name);
  in(Choice{"kind", terrain::kAreaKindNames, ""}, a.kind);
  in(Choice{"cover", terrain::kCoverNames, ""}, a.cover);
  in.number("water_level_m", a.water_level_m);
}

Json species_json(const Species& s) {
  Json json;
  json["name"] = s.name;
  json["botanical_name"] = s.botanical_name;
  json["common_names"] = s.common_names;
  json["genus_words"] = s.genus_words;
  json["derived"] = s.derived;
  json["shape"] = described_json(s.shape);
  json["planting"] = described_json(s.planting);
  json["growth"] = described_json(s.growth);
  json["look"] = described_json(s.look);
  json["foliage"] = described_json(s.foliage);
  json["allometry"] = described_json(s.allometry);
  json["size"] = Json::array();
  for (const OpenGrownSize& size : s.sizes) json["size"].push_back(described_json(size));
  return json;
}

void read_species(JsonReader& in, Species& s) {
  in.text("name", s.name);
  in.text("botanical_name", s.botanical_name);
  in.texts("common_names", s.common_names);
  in.texts("genus_words", s.genus_words);
  in.flag("derived", s.derived);
  read_described(in, "shape", s.shape);
  read_described(in, "planting", s.planting);
  read_described(in, "growth", s.growth);
  read_described(in, "look", s.look);
  read_described(in, "foliage", s.foliage);
  read_described(in, "allometry", s.allometry);
  in(Tables{"size", ""}, s.sizes);
}

Json mix_json(const distribution::MixEntry& m) {
  Json json;
  json["species"] = m.species;
  json["probability"] = json_number(m.probability);
  json["scale"] = {json_number(m.scale_min), json_number(m.scale_max)};
  return json;
}

void read_mix(JsonReader& in, distribution::MixEntry& m, std::size_t species) {
  std::size_t index = 0;
  in.count("species", index);
  if (index >= species) return in.wrong("species");
  m.species = static_cast<std::uint32_t>(index);
  in.number("probability", m.probability);
  Vec2 scale{0.0f};
  in.vector("scale", scale);
  m.scale_min = scale.x, m.scale_max = scale.y;
}

Json obstacle_json(const Obstacle& o) {
  Json json;
  json["id"] = o.id;
  json["name"] = o.name;
  if (o.outline) {
    json["ring"] = json_of(o.outline->ring);
    json["holes"] = Json::array();
    for (const auto& hole : o.outline->holes) json["holes"].push_back(json_of(hole));
  }
  json["low_y"] = json_number(o.low_y);
  json["high_y"] = json_number(o.high_y);
  return json;
}

void read_obstacle(JsonReader& in, Obstacle& o) {
  in.whole("id", o.id);
  in.text("name", o.name);
  in.number("low_y", o.low_y);
  in.number("high_y", o.high_y);
  if (!in.find("ring")) return;
  Polygon outline;
  in.points("ring", outline.ring);
  if (const Json* holes = in.find("holes"); holes && holes->is_array())
    for (const Json& hole : *holes) {
      const Json one{{"hole", hole}};
      JsonReader reader(one, in.where(), in.problems());
      reader.points("hole", outline.holes.emplace_back());
    }
  if (outline.ring.size() < 3) return in.wrong("ring");
  o.outline = std::make_shared<const Polygon>(std::move(outline));
}

Json hero_json(const HeroTree& h) {
  Json json;
  json["id"] = h.id;
  json["name"] = h.name;
  json["species"] = h.species;
  json["key"] = std::to_string(h.key);
  json["at"] = json_of(h.at);
  return json;
}

void read_hero(JsonReader& in, HeroTree& h, std::size_t species) {
  in.whole("id", h.id);
  in.text("name", h.name);
  in.count("species", h.species);
  if (h.species >= species) h.species = 0, in.wrong("species");
  in.word("key", h.key);
  in.vector("at", h.at);
}

Json camera_json(const Camera& c) {
  Json json;
  json["name"] = c.name;
  json["eye"] = json_of(c.eye);
  json["target"] = json_of(c.target);
  json["vertical_fov_deg"] = json_number(c.vertical_fov_deg);
  return json;
}

void read_camera(JsonReader& in, Camera& c) {
  in.text("name", c.name);
  in.vector("eye", c.eye);
  in.vector("target", c.target);
  in.number("vertical_fov_deg", c.vertical_fov_deg);
}

Json figure_json(const Figure& f) {
  Json json;
  json["at"] = json_of(f.at);
  json["heading_deg"] = json_number(f.heading_deg);
  return json;
}

void read_figure(JsonReader& in, Figure& f) {
  in.vector("at", f.at);
  in.number("heading_deg", f.heading_deg);
}

// Rows of a list, each with the name of its item.
template <class Item, class ToJson>
std::vector<TextRow> list_rows(const SharedList<Item>& list, const SharedList<Item>* before, const ToJson& to_json) {
  std::vector<TextRow> rows(list.size());
  if (before && list.shares(*before)) return rows;
  for (std::size_t i = 0; i < list.size(); ++i) {
    rows[i].json = text_of(to_json(list[i]));
    if constexpr (requires { list[i].name; }) rows[i].name = list[i].name;
  }
  return rows;
}

}  // namespace

std::vector<TextRow> text_rows(const std::string& section, const Document& d, const Document* before) {
  if (section == "settings") return {{"", text_of(settings_json(d))}};
  if (section == "ground") return {{"", text_of(ground_json(*d.terrain))}};
  if (section == "areas") {
    std::vector<TextRow> rows(d.terrain->areas.count() - 1);
    if (before && before->terrain == d.terrain) return rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const terrain::Area& area = d.terrain->areas.all()[i + 1];
      rows[i] = {area.name, text_of(area_json(area))};
    }
    return rows;
  }
  if (section == "species") {
    std::vector<TextRow> rows(d.species.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!before || i >= before->species.size() || before->species[i] != d.species[i])
        rows[i] = {d.species[i]->name, text_of(species_json(*d.species[i]))};
    return rows;
  }
  if (section == "interactions")
    return list_rows(d.interactions, before ? &before->interactions : nullptr,
                     [](const distribution::Interaction& i) { return described_json(i); });
  if (section == "species_bar") return list_rows(d.species_bar, before ? &before->species_bar : nullptr, mix_json);
  if (section == "obstacles") return list_rows(d.obstacles, before ? &before->obstacles : nullptr, obstacle_json);
  if (section == "heroes") return list_rows(d.heroes, before ? &before->heroes : nullptr, hero_json);
  if (section == "cameras") return list_rows(d.cameras, before ? &before->cameras : nullptr, camera_json);
  assert(section == "figures");
  return list_rows(d.figures, before ? &before->figures : nullptr, figure_json);
}

void TextReader::read(const std::string& section, const std::vector<TextRow>& rows) {
  Document& d = document;
  // Each row as a value of its kind; a missing row is its default.
  const auto items = [&]<class Item>(std::vector<Item> all, const auto& fill) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string where = rows.size() == 1 ? section : fmt::format("{} {} ({})", section, i + 1, rows[i].name);
      const auto json = parse_json(rows[i].json);
      Item& item = all.emplace_back();
      if (!json || !json->is_object()) {
        problems.push_back(where);
        if constexpr (requires { item.name; }) item.name = rows[i].name;
        continue;
      }
      JsonReader in(*json, where, problems);
      fill(in, item);
    }
    return all;
  };

  if (section == "settings") {
    items(std::vector<int>{}, [&](JsonReader& in, int) { read_settings(in, d); });
  } else if (section == "ground") {
    items(std::vector<int>{}, [&](JsonReader& in, int) { ground = read_ground(in); });
  } else if (section == "areas") {
    areas = items(std::vector<terrain::Area>{}, read_area);
  } else if (section == "species") {
    std::vector<std::shared_ptr<const Species>> all;
    for (Species& s : items(std::vector<Species>{}, read_species)) {
      // A species that is lost may still be known by name.
      if (s.shape == crowns::RepresentativeShape{} && s.sizes.empty())
        if (auto builtin = builtin_species(s.name)) s = std::move(*builtin);
      all.push_back(std::make_shared<const Species>(std::move(s)));
    }
    d.species = std::move(all);
  } else if (section == "interactions") {
    d.interactions = items(std::vector<distribution::Interaction>{},
                           [](JsonReader& in, distribution::Interaction& i) { describe(i, in); });
  } else if (section == "species_bar") {
    d.species_bar = items(std::vector<distribution::MixEntry>{},
                          [&](JsonReader& in, distribution::MixEntry& m) { read_mix(in, m, d.species.size()); });
  } else if (section == "obstacles") {
    d.obstacles = items(std::vector<Obstacle>{}, read_obstacle);
  } else if (section == "heroes") {
    d.heroes = items(std::vector<HeroTree>{}, [&](JsonReader& in, HeroTree& h) { read_hero(in, h, d.species.size()); });
  } else if (section == "cameras") {
    d.cameras = items(std::vector<Camera>{}, read_camera);
  } else if (section == "figures") {
    d.figures = items(std::vector<Figure>{}, read_figure);
  }
}

}  // namespace bosquet::scene
