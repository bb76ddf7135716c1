#include "scene/clearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

#include "scene/document.h"

namespace bosquet::scene {
namespace {

using To = ClearanceBreach::To;

float length(Vec2 v) { return std::sqrt(glm::dot(v, v)); }

float distance_to_piece(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 piece = b - a;
  const float length2 = glm::dot(piece, piece);
  const float along = length2 > 0.0f ? std::clamp(glm::dot(p - a, piece) / length2, 0.0f, 1.0f) : 0.0f;
  return length(p - (a + along * piece));
}

float distance_to_ring(Vec2 p, const std::vector<Vec2>& ring) {
  float least = std::numeric_limits<float>::max();
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    least = std::min(least, distance_to_piece(p, ring[j], ring[i]));
  return least;
}

/// 0 inside.
float distance_to(Vec2 p, const Polygon& outline) {
  if (outline.contains(p)) return 0.0f;
  float least = distance_to_ring(p, outline.ring);
  for (const auto& hole : outline.holes) least = std::min(least, distance_to_ring(p, hole));
  return least;
}

/// In plan, the triangle of three world points.
float distance_to_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
  const auto side = [&](Vec2 from, Vec2 to) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  const float ab = side(a, b), bc = side(b, c), ca = side(c, a);
  if ((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0)) return 0.0f;
  return std::min({distance_to_piece(p, a, b), distance_to_piece(p, b, c), distance_to_piece(p, c, a)});
}

/// The obstacles' plans with their bounds, for many questions.
class Buildings {
 public:
  explicit Buildings(const Document& document) {
    for (const Obstacle& o : document.obstacles) {
      Plan plan{&o, {}};
      if (o.outline)
        plan.bounds = o.outline->bounds();
      else
        for (const Vec3& p : o.mesh->positions) plan.bounds.add({p.x, -p.z});
      plans_.push_back(plan);
    }
  }
  /// The nearest within `reach`, and how far it is.
  std::optional<std::pair<const Obstacle*, float>> nearest(Vec2 p, float reach) const {
    std::optional<std::pair<const Obstacle*, float>> best;
    for (const Plan& plan : plans_) {
      const Vec2 beside = glm::max(glm::max(plan.bounds.low - p, p - plan.bounds.high), Vec2(0.0f));
      if (length(beside) >= reach) continue;
      const float d = distance(p, *plan.obstacle);
      if (d < reach) reach = d, best = {plan.obstacle, d};
    }
    return best;
  }

 private:
  struct Plan {
    const Obstacle* obstacle;
    Box2 bounds;
  };
  static float distance(Vec2 p, const Obstacle& o) {
    if (o.outline) return distance_to(p, *o.outline);
    float least = std::numeric_limits<float>::max();
    const auto plan = [&](std::size_t n) {
      const Vec3& v = o.mesh->positions[o.mesh->indices[n]];
      return Vec2{v.x, -v.z};
    };
    for (std::size_t n = 0; n + 2 < o.mesh->indices.size(); n += 3)
      least = std::min(least, distance_to_triangle(p, plan(n), plan(n + 1), plan(n + 2)));
    return least;
  }
  std::vector<Plan> plans_;
};

/// The nearest place within `reach` that belongs to an area of such a kind, and its area. The cells around are asked at
/// their middles; then the area's edge is sought on the way to the nearest.
template <class Kinds>
std::optional<std::pair<const terrain::Area*, float>> nearest_area(const terrain::Terrain& terrain, Vec2 p, float reach,
                                                                   Kinds such) {
  const auto area_at = [&](Vec2 at) -> const terrain::Area* {
    if (!on_site(terrain, at)) return nullptr;
    const terrain::Area* area = terrain.area_at(at);
    return area && such(*area) ? area : nullptr;
  };
  if (const terrain::Area* here = area_at(p)) return std::pair{here, 0.0f};
  const terrain::Lattice& lattice = terrain.exclusion.lattice();
  const float cell = lattice.cell_m;
  const auto column = [&](float at, int most) {
    return std::clamp(static_cast<int>(std::floor(at / cell)), 0, most - 1);
  };
  const IVec2 low{column(p.x - reach - cell, lattice.cells.x), column(p.y - reach - cell, lattice.cells.y)};
  const IVec2 high{column(p.x + reach + cell, lattice.cells.x), column(p.y + reach + cell, lattice.cells.y)};

  std::optional<std::pair<const terrain::Area*, float>> best;
  float within = reach;
  for (int j = low.y; j <= high.y; ++j)
    for (int i = low.x; i <= high.x; ++i) {
      if (terrain.exclusion.cell(i, j) == 0.0f) continue;
      const Vec2 middle = cell * Vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
      if (length(middle - p) >= within + cell) continue;
      const terrain::Area* area = area_at(middle);
      if (!area) continue;
      // To a millimetre of a 30 m way.
      Vec2 out = p, in = middle;
      for (int halving = 0; halving < 15; ++halving) {
        const Vec2 between = 0.5f * (out + in);
        (area_at(between) ? in : out) = between;
      }
      if (const float d = length(in - p); d < within) within = d, best = {area, d};
    }
  return best;
}

/// Standing trees in squares of the rule's length.
class Neighbours {
 public:
  Neighbours(const Document& document, float square_m) : square_m_(square_m) {
    for (const Tree& tree : *document.trees)
      if (tree.status != TreeStatus::to_remove) squares_[square(tree.at)].push_back(&tree);
  }
  template <class Each>
  void visit_near(Vec2 p, Each each) const {
    const IVec2 at = column(p);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (const auto found = squares_.find(key({at.x + i, at.y + j})); found != squares_.end())
          for (const Tree* tree : found->second) each(*tree);
  }

 private:
  IVec2 column(Vec2 p) const {
    return {static_cast<int>(std::floor(p.x / square_m_)), static_cast<int>(std::floor(p.y / square_m_))};
  }
  static std::uint64_t key(IVec2 c) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(c.x)) << 32 | static_cast<std::uint32_t>(c.y);
  }
  std::uint64_t square(Vec2 p) const { return key(column(p)); }

  float square_m_;
  std::unordered_map<std::uint64_t, std::vector<const Tree*>> squares_;
};

bool is_path(const terrain::Area& area) {
  return area.kind == terrain::AreaKind::path || area.kind == terrain::AreaKind::other;
}
bool is_building(const terrain::Area& area) { return area.kind == terrain::AreaKind::building; }

}  // namespace

std::vector<ClearanceBreach> clearance_breaches(const Document& document, const ClearanceRules& rules) {
  std::vector<ClearanceBreach> breaches;
  if (rules == ClearanceRules{}) return breaches;
  const terrain::Terrain& terrain = *document.terrain;
  const Buildings buildings(document);
  std::optional<Neighbours> neighbours;
  if (rules.tree_m > 0.0f) neighbours.emplace(document, rules.tree_m);

  for (const Tree& tree : *document.trees) {
    if (tree.status != TreeStatus::proposed) continue;
    const auto breach = [&](To to, std::string name, std::int32_t other, float distance, float wanted) {
      breaches.push_back({tree.id, tree.at, to, std::move(name), other, distance, wanted});
    };
    if (rules.building_m > 0.0f) {
      const auto built = buildings.nearest(tree.at, rules.building_m);
      const auto drawn = nearest_area(terrain, tree.at, built ? built->second : rules.building_m, is_building);
      if (drawn)
        breach(To::building, drawn->first->name, 0, drawn->second, rules.building_m);
      else if (built)
        breach(To::building, built->first->name, 0, built->second, rules.building_m);
    }
    if (rules.path_m > 0.0f)
      if (const auto path = nearest_area(terrain, tree.at, rules.path_m, is_path))
        breach(To::path, path->first->name, 0, path->second, rules.path_m);
    if (neighbours) {
      const Tree* nearest = nullptr;
      float least = rules.tree_m;
      neighbours->visit_near(tree.at, [&](const Tree& other) {
        const bool told_there = other.status == TreeStatus::proposed && other.id > tree.id;
        if (other.id == tree.id || told_there || (tree.form.clipped() && other.form.clipped())) return;
        const float d = length(other.at - tree.at);
        if (d < least) least = d, nearest = &other;
      });
      if (nearest) breach(To::tree, {}, nearest->id, least, rules.tree_m);
    }
    if (rules.edge_m > 0.0f) {
      const Vec2 size = terrain.size_m();
      const float d = std::min({tree.at.x, tree.at.y, size.x - tree.at.x, size.y - tree.at.y});
      if (d < rules.edge_m) breach(To::edge, {}, 0, std::max(0.0f, d), rules.edge_m);
    }
  }
  return breaches;
}

std::string words(const ClearanceBreach& breach, const Document& document) {
  const auto named = [&](const char* kind) {
    return breach.name.empty() ? fmt::format("a {}", kind) : fmt::format("{} '{}'", kind, breach.name);
  };
  std::string what;
  switch (breach.to) {
    case To::building:
      what = named("building");
      break;
    case To::path:
      what = named("path");
      break;
    case To::tree:
      what = fmt::format("tree {}", breach.other);
      break;
    case To::edge:
      what = "the edge of the site";
      break;
  }
  const Tree* tree = document.trees->find(breach.tree);
  return fmt::format("tree {} ({}) at ({:.1f}, {:.1f}): {:.2f} m from {}; the rule is {:g} m", breach.tree,
                     tree ? document.species_of(*tree).name : "", breach.at.x, breach.at.y, breach.distance_m, what,
                     breach.wanted_m);
}

}  // namespace bosquet::scene
