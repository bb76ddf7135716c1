#include "scene/site_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/prism.h"
#include "terrain/exclusion.h"

namespace bosquet::scene {
namespace {

// Walls go down to the lowest ground at the outline, and so much farther.
constexpr float kFoundation_m = 0.3f;

constexpr std::array<std::string_view, terrain::kBrushKindNames.size()> kStrokeNames{
    "Raise ground",   "Lower ground", "Smooth ground", "Flatten ground",
    "Roughen ground", "Keep free",    "Allow trees",   "Thin out planting"};

// Those that stand badly now and did not before, taken away or listed.
void settle(Edited& edited, const Document& before, Displaced what) {
  const std::vector<std::int32_t> were = displaced_trees(before);
  for (std::int32_t id : displaced_trees(edited.document))
    if (!std::binary_search(were.begin(), were.end(), id)) edited.displaced.push_back(id);
  if (what == Displaced::stay || edited.displaced.empty()) return;
  Edited cleared = remove_trees(edited.document, edited.displaced);
  edited.document = std::move(cleared.document);
  edited.trees = std::move(cleared.trees);
  edited.displaced = std::move(cleared.skipped);
  edited.notes.push_back(fmt::format("{} taken away", trees_in_words(edited.trees.size())));
}

// Places along the foot of an obstacle: its outline, or the rectangle that a mesh covers.
constexpr float kFootStep_m = 0.5f;
constexpr std::size_t kMostFootPlaces = 1000;

std::vector<Vec2> foot_of(const Obstacle& o) {
  Box2 box;
  std::vector<Vec2> ring;
  if (o.outline) {
    ring = o.outline->ring;
  } else {
    for (const Vec3& p : o.mesh->positions) box.add(to_plan(p));
    if (!box.empty()) ring = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  }
  float around = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) around += glm::distance(ring[i], ring[(i + 1) % ring.size()]);
  const float step = std::max(kFootStep_m, around / static_cast<float>(kMostFootPlaces));
  std::vector<Vec2> places;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 from = ring[i], to = ring[(i + 1) % ring.size()];
    const int pieces = 1 + static_cast<int>(glm::distance(from, to) / step);
    for (int n = 0; n < pieces; ++n)
      places.push_back(from + static_cast<float>(n) / static_cast<float>(pieces) * (to - from));
  }
  return places;
}

// The obstacle on the ground after an edit; nothing when it stays as it is.
std::optional<Obstacle> following(const Obstacle& o, const terrain::Terrain& before, const terrain::Terrain& now) {
  const std::vector<Vec2> foot = foot_of(o);
  if (foot.empty()) return {};
  std::vector<float> rises;
  float old_lowest = before.ground(foot.front()), lowest = now.ground(foot.front());
  for (Vec2 p : foot) {
    const float was = before.ground(p), is = now.ground(p);
    rises.push_back(is - was);
    old_lowest = std::min(old_lowest, was), lowest = std::min(lowest, is);
  }
  const auto middle = rises.begin() + static_cast<std::ptrdiff_t>(rises.size() / 2);
  std::nth_element(rises.begin(), middle, rises.end());
  const float rise = *middle;
  Obstacle out = o;
  out.low_y += rise, out.high_y += rise;
  if (o.outline && o.low_y <= old_lowest) out.low_y = std::min(out.low_y, lowest - kFoundation_m);
  if (o.outline ? out.low_y == o.low_y && out.high_y == o.high_y : rise == 0.0f) return {};
  TriangleMesh mesh = o.outline ? geometry::prism(*o.outline, out.low_y, out.high_y) : *o.mesh;
  if (!o.outline)
    for (Vec3& p : mesh.positions) p.y += rise;
  out.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return out;
}

void follow_ground(Edited& edited, const Document& before) {
  Document& d = edited.document;
  if (before.terrain->height.grid().shares_all(d.terrain->height.grid())) return;
  std::size_t followed = 0;
  for (std::size_t i = 0; i < d.obstacles.size(); ++i)
    if (auto now = following(d.obstacles[i], *before.terrain, *d.terrain))
      d.obstacles.replace(i, std::move(*now)), ++followed;
  if (followed > 0)
    edited.notes.push_back(fmt::format("{} obstacle{} with the ground", followed, followed == 1 ? " goes" : "s go"));
}

template <class List>
std::size_t place_of(const List& list, std::int32_t id) {
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.id == id; });
  return static_cast<std::size_t>(at - list.begin());
}

}  // namespace

Edited set_ground(const Document& document, terrain::Terrain terrain, std::string name, Displaced displaced) {
  Edited edited;
  edited.document = document;
  edited.document.terrain = std::make_shared<const terrain::Terrain>(std::move(terrain));
  edited.name = std::move(name);
  follow_ground(edited, document);
  settle(edited, document, displaced);
  return edited;
}

Edited shape_ground(const Document& document, const terrain::Stroke& stroke, Displaced displaced) {
  return set_ground(document, terrain::apply(*document.terrain, stroke),
                    std::string(kStrokeNames[static_cast<std::size_t>(stroke.kind)]), displaced);
}

Edited set_water_level(const Document& document, std::optional<float> level_m, Displaced displaced) {
  terrain::Terrain ground = *document.terrain;
  ground.water_level_m = level_m;
  return set_ground(document, std::move(ground),
                    level_m ? fmt::format("Set water level to {:.2f} m", *level_m) : "Remove water", displaced);
}

Edited exclude_area(const Document& document, const Polygon& polygon, const terrain::Area& area, Displaced displaced) {
  return set_ground(document, terrain::exclude(*document.terrain, polygon, area),
                    area.name.empty() ? "Keep area free" : fmt::format("Add area '{}'", area.name), displaced);
}

Edited exclude_path(const Document& document, std::span<const Vec2> path, float width_m, const terrain::Area& area,
                    Displaced displaced) {
  return set_ground(document, terrain::exclude_path(*document.terrain, path, width_m, area),
                    area.name.empty() ? "Add path" : fmt::format("Add path '{}'", area.name), displaced);
}

Edited dig_pond(const Document& document, const std::string& name, const Polygon& outline, std::optional<float> level_m,
                const terrain::PondRules& rules, Displaced displaced) {
  terrain::DugPond pond = terrain::dig_pond(*document.terrain, name, outline, level_m, rules);
  Edited edited = set_ground(document, std::move(pond.edit.terrain),
                             name.empty() ? "Dig pond" : fmt::format("Dig pond '{}'", name), displaced);
  if (pond.lowered)
    edited.notes.push_back(
        fmt::format("the water stands at {:.2f} m: higher it would run out over the lowest bank", pond.level_m));
  return edited;
}

Obstacle extruded_between(std::string name, Polygon outline, float low_y, float high_y) {
  Obstacle out;
  out.name = std::move(name);
  out.low_y = low_y, out.high_y = high_y;
  out.mesh = std::make_shared<const TriangleMesh>(geometry::prism(outline, out.low_y, out.high_y));
  out.outline = std::make_shared<const Polygon>(std::move(outline));
  return out;
}

Obstacle extruded(std::string name, Polygon outline, float height_m, const terrain::Terrain& ground) {
  float lowest = ground.ground(outline.ring.front()), sum = 0;
  for (Vec2 p : outline.ring) lowest = std::min(lowest, ground.ground(p)), sum += ground.ground(p);
  const float high_y = sum / static_cast<float>(outline.ring.size()) + height_m;
  return extruded_between(std::move(name), std::move(outline), lowest - kFoundation_m, high_y);
}

Result<Edited> add_obstacle(const Document& document, Obstacle obstacle, Displaced displaced) {
  if (!obstacle.mesh || obstacle.mesh->empty())
    return Error{fmt::format("obstacle '{}' has no surface", obstacle.name)};
  Edited edited;
  edited.document = document;
  obstacle.id = edited.document.next_standing_id--;
  edited.name = obstacle.name.empty() ? "Add building" : fmt::format("Add '{}'", obstacle.name);
  edited.document.obstacles.push_back(std::move(obstacle));
  settle(edited, document, displaced);
  return edited;
}

Result<Edited> add_building(const Document& document, std::string name, Polygon outline, float height_m,
                            Displaced displaced) {
  if (outline.ring.size() < 3) return Error{fmt::format("the outline of '{}' needs three points at least", name)};
  if (!(height_m > 0.0f && height_m <= 1000.0f))
    return Error{fmt::format("'{}' cannot be {} m high, allowed is above 0 to 1000 m", name, height_m)};
  return add_obstacle(document, extruded(std::move(name), std::move(outline), height_m, *document.terrain), displaced);
}

Result<Edited> remove_obstacle(const Document& document, std::int32_t id) {
  const std::size_t at = place_of(document.obstacles, id);
  if (at == document.obstacles.size()) return Error{fmt::format("there is no obstacle {}", id)};
  Edited edited;
  edited.document = document;
  edited.name =
      document.obstacles[at].name.empty() ? "Remove building" : fmt::format("Remove '{}'", document.obstacles[at].name);
  edited.document.obstacles.erase(at);
  return edited;
}

Result<Edited> add_hero(const Document& document, HeroTree hero) {
  if (!terrain::on_site(*document.terrain, hero.at))
    return Error{fmt::format("({:.1f}, {:.1f}) lies off the site", hero.at.x, hero.at.y)};
  if (!hero.skeleton || hero.skeleton->size() == 0) return Error{fmt::format("'{}' has no wood", hero.name)};
  Edited edited;
  edited.document = document;
  edited.name = fmt::format("Place '{}'", hero.name);
  hero.id = edited.document.next_standing_id--;
  edited.document.heroes.push_back(std::move(hero));
  return edited;
}

Result<Edited> turn_hero(const Document& document, std::int32_t id, float scale, float rotation_deg) {
  const std::size_t at = place_of(document.heroes, id);
  if (at == document.heroes.size()) return Error{fmt::format("there is no hero tree {}", id)};
  constexpr float kLeast = 0.02f, kMost = 10.0f;  // as recipes allow
  if (!(scale >= kLeast && scale <= kMost))
    return Error{fmt::format("a scale of {:g} is not between {:g} and {:g}", scale, kLeast, kMost)};
  Edited edited;
  edited.document = document;
  HeroTree hero = document.heroes[at];
  hero.skeleton = std::make_shared<const growth::Skeleton>(placed(*hero.skeleton, scale, rotation_deg));
  edited.name = fmt::format("{} '{}'", scale == 1.0f ? "Turn" : "Scale", hero.name);
  edited.document.heroes.replace(at, std::move(hero));
  return edited;
}

Result<Edited> move_hero(const Document& document, std::int32_t id, Vec2 to) {
  const std::size_t at = place_of(document.heroes, id);
  if (at == document.heroes.size()) return Error{fmt::format("there is no hero tree {}", id)};
  if (!terrain::on_site(*document.terrain, to))
    return Error{fmt::format("({:.1f}, {:.1f}) lies off the site", to.x, to.y)};
  Edited edited;
  edited.document = document;
  HeroTree hero = document.heroes[at];
  hero.at = to;
  edited.name = fmt::format("Move '{}'", hero.name);
  edited.document.heroes.replace(at, std::move(hero));
  return edited;
}

Result<Edited> remove_hero(const Document& document, std::int32_t id) {
  const std::size_t at = place_of(document.heroes, id);
  if (at == document.heroes.size()) return Error{fmt::format("there is no hero tree {}", id)};
  Edited edited;
  edited.document = document;
  edited.name = fmt::format("Remove '{}'", document.heroes[at].name);
  edited.document.heroes.erase(at);
  return edited;
}

}  // namespace bosquet::scene
