// Full document: one in which every field has a value of its own, for tests of files.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/hash.h"
#include "geometry/prism.h"
#include "scene/document.h"
#include "terrain/brush.h"

namespace bosquet::scene {

/// Visitor that gives every described field another value than it has.
struct ChangeEverything {
  int n = 0;

  void operator()(const Real& r, float& v) { v = static_cast<float>(other(r, static_cast<double>(v))); }
  void operator()(const Real& r, double& v) { v = other(r, v); }
  void operator()(const Whole& w, int& v) { v = v == w.low ? w.low + 1 : w.low; }
  void operator()(const Switch&, bool& v) { v = !v; }
  void operator()(const Text&, std::string& v) { v = "text \"" + std::to_string(++n) + "\" \u00e4"; }
  void operator()(const Colour&, Vec3& v) { v = Vec3{static_cast<float>(++n % 256), 17.0f, 200.0f} / 255.0f; }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& c, Enum& v) {
    v = static_cast<Enum>((static_cast<std::size_t>(v) + 1) % c.names.size());
  }
  template <class Item>
  void operator()(const Tables&, std::vector<Item>& items) {
    items.resize(2);
    for (Item& item : items) describe(item, *this);
  }

 private:
  double other(const Real& r, double v) {
    const double high = std::min(r.high, 1e6), step = (high - r.low) / 997.0;
    const double next = r.low + step * (1 + ++n % 900);
    return next == v ? next + step : next;
  }
};

template <class P>
P changed_everywhere(P p = {}) {
  ChangeEverything change;
  describe(p, change);
  return p;
}

inline std::shared_ptr<const growth::Skeleton> small_skeleton() {
  growth::Skeleton s;
  for (int i = 0; i < 7; ++i) {
    const float f = static_cast<float>(i);
    s.parent.push_back(i - 1), s.axis.push_back(static_cast<std::uint32_t>(i / 3));
    s.order.push_back(static_cast<std::uint8_t>(i % 3)), s.distal.push_back({0.1f * f, 0.3f * f + 0.3f, -0.2f});
    s.radius.push_back(0.1f / (f + 1)), s.born.push_back(static_cast<std::uint16_t>(i));
    s.shed.push_back(i == 6 ? 7 : growth::kNever), s.light.push_back(0.5f), s.vigor.push_back(1.0f / (f + 1));
    s.pipes.push_back(static_cast<std::uint8_t>(i + 1));
  }
  s.seasons = 9, s.internode_length_m = 0.31f, s.detail = 2.0f, s.tip_diameter_m = 0.004f, s.pipe_exponent = 2.3f;
  return std::make_shared<const growth::Skeleton>(std::move(s));
}

inline std::shared_ptr<const terrain::Terrain> full_ground() {
  auto lattice = terrain::make_lattice({150.0f, 90.0f});
  terrain::Terrain ground = terrain::make_terrain(
      terrain::Heightfield(*lattice, [](Vec2 p) { return 0.013f * p.x - 0.0271f * p.y + 0.001f * p.x * p.y; }));
  ground.water_level_m = -0.37f;
  ground.ponds = terrain::TiledGrid<terrain::AreaId>(lattice->cells, 0);
  const terrain::AreaId pond =
      ground.areas.add(*lattice, {"Weiher \"klein\"", terrain::AreaKind::water, terrain::Cover::soil, 1.25f});
  const terrain::AreaId lawn =
      ground.areas.add(*lattice, {"lawn", terrain::AreaKind::lawn, terrain::Cover::grass, std::nullopt});
  terrain::TileEditor<terrain::AreaId> ponds(ground.ponds);
  terrain::TileEditor<terrain::AreaCell> areas(ground.areas.grid());
  terrain::TileEditor<std::uint8_t> exclusion(ground.exclusion.grid()), density(ground.density.grid());
  for (int j = 10; j < 100; ++j)
    for (int i = 20; i < 200; ++i) {
      ponds.set(i, j, pond);
      areas.set(i, j, {lawn, pond, static_cast<std::uint8_t>(i)});
      exclusion.set(i, j, static_cast<std::uint8_t>(j));
      density.set(i + 50, j + 30, static_cast<std::uint8_t>(i ^ j));
    }
  return std::make_shared<const terrain::Terrain>(std::move(ground));
}

/// `trees` trees of two species on a site with everything on it.
inline Document full_document(int trees = 300) {
  // When this does not compile, Document has a new field: give it a value here, and its place in project_text.cpp (or
  // project_store.cpp), before the number of names is changed.
  {
    [[maybe_unused]] const auto& [seed, place, terrain, species, interactions, species_bar, tree_list, obstacles,
                                  heroes, space, asymmetry, light, cameras, figures, sun, clearance, plan, underlay,
                                  ground_cover, max_triangles, next_tree_id, next_standing_id, next_block] = Document{};
  }
  Document d;
  d.seed = 0xfedcba9876543210ull;
  d.place = {51.25, -3.5, {512345.125, 5412345.625}, "PROJCS[\"x\",AUTHORITY[\"EPSG\",\"25832\"]]"};
  d.terrain = full_ground();
  std::vector<std::shared_ptr<const Species>> species;
  for (const char* name : {"silver_birch", "english_oak"})
    species.push_back(std::make_shared<const Species>(*builtin_species(name)));
  Species own;
  own.name = "own kind", own.botanical_name = "Arbor \u00fcber", own.common_names = {"a", "b"},
  own.genus_words = {"own"};
  own.derived = true;
  own.shape = changed_everywhere<crowns::RepresentativeShape>();
  own.planting = changed_everywhere<distribution::PlantingRules>();
  own.growth = changed_everywhere<growth::Parameters>();
  own.look = changed_everywhere<geometry::Look>();
  own.foliage = changed_everywhere<geometry::FoliageLook>();
  own.allometry = changed_everywhere<Allometry>();
  own.sizes = {changed_everywhere<OpenGrownSize>(), OpenGrownSize{}};
  species.push_back(std::make_shared<const Species>(std::move(own)));
  d.species = std::move(species);
  distribution::Interaction interaction = changed_everywhere<distribution::Interaction>();
  d.interactions = {interaction, {"english_oak", "own kind", distribution::KernelKind::clustering, 7.5f, 3.25f}};
  d.species_bar = {{2, 0.25f, 0.5f, 0.75f}, {1, 3.0f, 0.0f, 0.0f}};

  std::vector<Tree> all;
  for (int i = 0; i < trees; ++i) {
    [[maybe_unused]] const auto& [id, key, kind, at, scale_height, scale_width, trunk, clear_stem, form, measured,
                                  status, inventory_name, inventory_id, locked, overrides, studio_edits] = Tree{};
    Tree t;
    t.id = 3 * i + 2;
    t.key = mix_bits(static_cast<std::uint64_t>(i));
    t.species = static_cast<std::size_t>(i % 3);
    const float f = static_cast<float>(i);
    t.at = {0.1f + 0.371f * f, 1e-3f * f};
    t.scale_height = 0.2f + 1e-3f * f, t.scale_width = 0.3f + 1.7e-3f * f;
    if (i % 2) t.trunk_diameter_m = 0.01f * f;
    t.clear_stem_m = 0.013f * f;
    if (i % 5 == 0) {
      t.form = changed_everywhere<crowns::ClippedForm>();
      t.form.centre = {0.25f, -0.125f};
    }
    t.measured = i % 3 == 1;
    t.status = static_cast<TreeStatus>(i % 4);
    t.inventory_name = i % 4 ? "Quercus \"robur\", 'x'; \u00c4" : "";
    t.inventory_id = i % 7 ? std::to_string(i) : "";
    t.locked = i % 6 == 0;
    if (i % 9 == 0)
      t.overrides = {
          {"growth.straightness", 0.1 + i}, {"growth.planar", true}, {"growth.phyllotaxis", std::string("decussate")}};
    if (i % 11 == 0) t.studio_edits = {"bend 3 0.5", "prune \"7\""};
    all.push_back(std::move(t));
  }
  d.trees = std::make_shared<const Trees>(std::move(all));

  const Polygon outline{{{3, 4}, {9.5f, 4}, {9, 12.25f}}, {{{4, 5}, {5, 5}, {5, 6}}}};
  Obstacle house;
  house.id = -5, house.name = "house", house.low_y = -1.5f, house.high_y = 7.25f;
  house.mesh = std::make_shared<const TriangleMesh>(geometry::prism(outline, -1.5f, 7.25f));
  house.outline = std::make_shared<const Polygon>(outline);
  Obstacle shed = house;
  shed.id = -2, shed.name = "shed \u00df", shed.outline = nullptr;
  TriangleMesh mesh = *shed.mesh;
  mesh.uvs.assign(mesh.positions.size(), {0.5f, 0.25f});
  mesh.colours.assign(mesh.positions.size(), Rgba8(1, 2, 3, 255));
  shed.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  d.obstacles = {house, shed};
  d.heroes = {{-3, "old oak", 1, 77, {20.5f, 30.25f}, small_skeleton()}, {-4, "", 0, ~0ull, {1, 2}, small_skeleton()}};
  d.space = changed_everywhere<crowns::SpaceOptions>();
  d.space.reach_factor = std::numeric_limits<float>::infinity();
  d.space.keep_ticks = true;
  d.asymmetry = changed_everywhere<crowns::AsymmetryOptions>();
  d.light = changed_everywhere<crowns::LightOptions>();
  d.cameras = {{"north gate", {1, 2.5f, -3}, {4, 5, -6}, 33.0f}, {"", {0.1f, 0, 0}, {7, 8, 9}, 50.0f}};
  d.figures = {{{1.5f, 2.25f}, 300.0f}, {{0.1f, 7}, -12.5f}};
  d.sun = {123.5f, 17.25f};
  d.clearance = changed_everywhere<ClearanceRules>();
  d.plan = changed_everywhere<PlanSettings>();
  d.underlay = changed_everywhere<Underlay>();
  d.underlay.file = "plan.png", d.underlay.south_west = {-3.125, 4.5};
  d.ground_cover = changed_everywhere<GroundCover>();
  d.max_triangles = 1'234'567;
  d.next_tree_id = 100'000;
  d.next_standing_id = -77;
  d.next_block = 0x8000000000000001ull;
  return d;
}

}  // namespace bosquet::scene
