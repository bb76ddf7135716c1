// What trees keep to among neighbours, on the example plot of 100 trees in 30 x 30 m.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "crowns/asymmetry.h"
#include "crowns/crown_space.h"
#include "exchange/recipe.h"
#include "growth/grow.h"
#include "scene/grown_scene.h"

namespace bosquet::growth {
namespace {

struct Stand {
  scene::Document document;
  std::vector<crowns::CrownRegion> regions;
  std::vector<Skeleton> trees;
};

const Stand& plot_100() {
  static const Stand stand = [] {
    Stand s;
    const auto recipe = exchange::read_recipe(std::string(BOSQUET_SOURCE_DIR) + "/examples/plots/plot_100.toml");
    EXPECT_TRUE(recipe) << (recipe ? "" : recipe.error().message);
    s.document = exchange::build_document(*recipe)->document;
    const crowns::CrownSpace space =
        *crowns::divide_space(scene::claimants(s.document), *s.document.terrain, s.document.space, nullptr);
    const std::vector<Vec3> asymmetry = crowns::neighbourhood_asymmetry(space, s.document.asymmetry);
    const scene::Trees& trees = *s.document.trees;
    for (std::size_t t = 0; t < trees.size(); ++t) {
      s.regions.push_back(crowns::region(space, t));
      GrowthInput input;
      input.parameters = &s.document.species_of(trees[t]).growth;
      input.max_height_m = s.document.mature_height_m(trees[t]);
      input.region = &s.regions.back(), input.asymmetry = asymmetry[t];
      input.seed = s.document.seed, input.key = trees[t].key;
      s.trees.push_back(grow(input));
    }
    return s;
  }();
  return stand;
}

TEST(PlotClaims, ALoneTreeInItsRegionIsTheTreeThatStandsFree) {
  // The region ends half a crown outside the mean crown of its species, so only a tree far wider than that, or a twig
  // that looks far, meets its border. From there on such a tree is another one: all trees are counted together.
  const terrain::Terrain ground = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(Vec2(60.0f))));
  std::size_t shared = 0, all = 0;
  for (const std::string& name : scene::builtin_species_names()) {
    const scene::Species species = *scene::builtin_species(name);
    const crowns::Claimant alone{7, 1, Vec2(30.2f, 29.9f), 0.0f, species.shape, 1.0f, 1.0f};
    const crowns::CrownSpace space = *crowns::divide_space({&alone, 1}, ground, crowns::SpaceOptions{}, nullptr);
    const crowns::CrownRegion region = crowns::region(space, 0);
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      GrowthInput input;
      input.parameters = &species.growth, input.max_height_m = species.shape.mature_height_m;
      input.seed = seed, input.key = 7;
      const Skeleton free = grow(input);
      input.region = &region;
      const Skeleton bounded = grow(input);
      std::set<std::tuple<float, float, float>> ends;
      for (const Vec3& p : free.distal) ends.insert({p.x, p.y, p.z});
      for (const Vec3& p : bounded.distal) shared += ends.count({p.x, p.y, p.z});
      all += std::max(free.size(), bounded.size());
      EXPECT_NEAR(static_cast<double>(bounded.size()) / static_cast<double>(free.size()), 1.0, 0.05)
          << name << ", seed " << seed;
    }
  }
  EXPECT_GT(static_cast<double>(shared), 0.99 * static_cast<double>(all));
}

/// How far p is from the nearest voxel of the region, up to `most_m`.
float distance_outside(const crowns::CrownRegion& r, const Vec3& p, float most_m) {
  if (r.contains(p)) return 0.0f;
  const Vec3 voxel{r.voxel_m, r.layer_m, r.voxel_m};
  const IVec3 from = glm::max(IVec3(0), IVec3(glm::floor((p - most_m - r.low) / voxel)));
  const IVec3 to = glm::min(r.cells - 1, IVec3(glm::floor((p + most_m - r.low) / voxel)));
  float best = most_m;
  for (int y = from.y; y <= to.y; ++y) {
    for (int z = from.z; z <= to.z; ++z) {
      for (int x = from.x; x <= to.x; ++x) {
        if (!r.voxel({x, y, z})) continue;
        const Vec3 low = r.low + Vec3(x, y, z) * voxel;
        best = std::min(best, glm::length(p - glm::clamp(p, low, low + voxel)));
      }
    }
  }
  return best;
}

/// Distance between the segments from a to b and from c to d (Ericson 2005, 5.1.9).
float segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const float uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  const float det = uu * vv - uv * uv;
  float s = det > 1e-9f ? std::clamp((uv * vw - uw * vv) / det, 0.0f, 1.0f) : 0.0f;
  const float t = std::clamp((uv * s + vw) / vv, 0.0f, 1.0f);
  s = std::clamp((uv * t - uw) / uu, 0.0f, 1.0f);
  return glm::length(w + s * u - t * v);
}

TEST(PlotClaims, AtMostAHundredthOfTheInternodesEndOutsideTheirRegionAndNoneDeeperThanTwoInternodes) {
  const Stand& stand = plot_100();
  std::size_t ends = 0, outside = 0;
  float deepest = 0.0f;
  for (std::size_t t = 0; t < stand.trees.size(); ++t) {
    const Skeleton& s = stand.trees[t];
    const float l = s.internode_length_m;
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (!s.alive(i)) continue;
      ++ends;
      const float depth = distance_outside(stand.regions[t], s.distal[i], 4.0f * l) / l;
      outside += depth > 0.0f;
      deepest = std::max(deepest, depth);
    }
  }
  RecordProperty("outside_per_mille", static_cast<int>(1000 * outside / ends));
  RecordProperty("deepest_percent_of_l", static_cast<int>(100.0f * deepest));
  EXPECT_LE(outside, ends / 100);
  EXPECT_LE(deepest, 2.0f);
}

TEST(PlotClaims, InternodesOfDifferentTreesSeldomTouch) {
  const Stand& stand = plot_100();
  struct Segment {
    Vec3 from, to;
    float radius;
    std::size_t tree;
  };
  std::vector<Segment> segments;
  for (std::size_t t = 0; t < stand.trees.size(); ++t) {
    const scene::Tree& tree = (*stand.document.trees)[t];
    const Vec3 base{tree.at.x, stand.document.terrain->ground(tree.at), -tree.at.y};
    const Skeleton& s = stand.trees[t];
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s.alive(i)) segments.push_back({base + s.proximal(i), base + s.distal[i], s.radius[i], t});
    }
  }
  // By cells of their middles, a metre wide: longer than an internode and two twigs' radii together; trunks' radii go
  // into how many cells are searched.
  using Cell = std::tuple<int, int, int>;
  const auto cell = [](const Vec3& p) {
    return IVec3{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                 static_cast<int>(std::floor(p.z))};
  };
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const IVec3 c = cell(0.5f * (segments[i].from + segments[i].to));
    cells[{c.x, c.y, c.z}].push_back(i);
  }
  std::size_t touching = 0;
  for (const Segment& a : segments) {
    const IVec3 c = cell(0.5f * (a.from + a.to));
    bool touches = false;
    for (int n = 0; n < 27 && !touches; ++n) {
      const auto found = cells.find({c.x + n % 3 - 1, c.y + n / 3 % 3 - 1, c.z + n / 9 - 1});
      if (found == cells.end()) continue;
      for (const std::size_t k : found->second) {
        const Segment& b = segments[k];
        if (b.tree != a.tree && segment_distance(a.from, a.to, b.from, b.to) < a.radius + b.radius) {
          touches = true;
          break;
        }
      }
    }
    touching += touches;
  }
  RecordProperty("touching_per_million", static_cast<int>(1'000'000 * touching / segments.size()));
  EXPECT_LT(static_cast<double>(touching), 0.001 * static_cast<double>(segments.size()));
}

}  // namespace
}  // namespace bosquet::growth
