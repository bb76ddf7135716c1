#include <gtest/gtest.h>

#include <map>

#include "geometry/foliage.h"
#include "geometry/leaf_atlas.h"
#include "geometry/petiole.h"
#include "tests/geometry/mesh_checks.h"
#include "tests/geometry/mesh_skeletons.h"

namespace bosquet::geometry {
namespace {

/// A tree with all that its foliage needs.
struct Dressed {
  growth::Skeleton skeleton;
  ThickestPaths paths;
  Look look;
  FoliageLook foliage;
  FoliageInput input;

  explicit Dressed(growth::Skeleton s, const FoliageLook& f = {}) : skeleton(std::move(s)), foliage(f) {
    paths = thickest_paths(skeleton, skeleton.radius, standing(skeleton, -1));
    input = {&skeleton, &paths, skeleton.radius, -1, &look, &foliage, Season::summer, 1, 2};
  }
  Dressed(const Dressed&) = delete;

  TriangleMesh mesh(FoliageLevel level, std::size_t count = 1'000'000'000) const {
    return mesh_foliage(input, level, leaf_sites(input, level), count);
  }
};

TEST(Foliage, IsSoundForEveryHabitLevelAndSeason) {
  for (const growth::Skeleton& s : test_skeletons()) {
    Dressed tree(s);
    for (const FoliageLevel level : kLevels)
      for (const Season season : {Season::spring, Season::summer, Season::autumn, Season::bare}) {
        tree.input.season = season;
        const auto sites = leaf_sites(tree.input, level);
        const std::size_t count = std::min<std::size_t>(sites.size(), 2000);
        const TriangleMesh mesh = mesh_foliage(tree.input, level, sites, count);
        EXPECT_EQ(mesh.triangles(), count * triangles_per_site(tree.foliage, level));
        expect_sound(mesh, 1e-9f);
        EXPECT_GT(share_facing_their_normals(mesh), 0.999);
        if (HasFatalFailure()) return;
      }
  }
}

TEST(Foliage, SitsOnThinWoodThatIsYoungForItsBranch) {
  for (const growth::Skeleton& s : test_skeletons()) {
    Dressed tree(s, {.max_twig_mm = 14, .leaf_life_seasons = 4});
    std::vector<int> last(s.size());
    for (std::size_t i = s.size(); i-- > 0;) {
      last[i] = std::max<int>(last[i], s.alive(i) ? s.born[i] : 0);
      if (s.parent[i] >= 0) {
        int& below = last[static_cast<std::size_t>(s.parent[i])];
        below = std::max(below, last[i]);
      }
    }
    for (const LeafSite& site : leaf_sites(tree.input, FoliageLevel::clusters)) {
      EXPECT_TRUE(s.alive(site.internode));
      EXPECT_LE(2000.0f * s.radius[site.internode], 14.0f);
      EXPECT_LE(last[site.internode] - s.born[site.internode], 4);
      EXPECT_GE(site.at, 0.0f);
      EXPECT_LE(site.at, 1.0f);
    }
  }
}

TEST(Foliage, ThereIsAClusterForEachSpacingOfLeafyWood) {
  const Dressed tree(test_skeleton({}, 1), {.max_twig_mm = 200, .leaf_life_seasons = 1000, .cluster_spacing_m = 0.05f});
  std::size_t along = 0;
  for (const LeafSite& site : leaf_sites(tree.input, FoliageLevel::clusters)) along += !site.tip;
  const double wanted = static_cast<double>(tree.skeleton.size()) * 0.25 / 0.05;
  // Feet of branches inside their parents bear none.
  EXPECT_LT(static_cast<double>(along), 1.02 * wanted);
  EXPECT_GT(static_cast<double>(along), 0.85 * wanted);
}

TEST(Foliage, LeafAreaIsKeptWhenCardsAreLeftOut) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Dressed tree(test_skeleton({}, seed));
    for (const FoliageLevel level : kLevels) {
      const auto sites = leaf_sites(tree.input, level);
      const double all = area(mesh_foliage(tree.input, level, sites, sites.size()));
      for (const std::size_t share : {2u, 7u, 40u})
        EXPECT_NEAR(area(mesh_foliage(tree.input, level, sites, sites.size() / share)) / all, 1.0, 0.1)
            << "level " << static_cast<int>(level) << " one in " << share;
    }
  }
}

TEST(Foliage, CardsAreLeftOutEvenly) {
  const Dressed tree(test_skeleton({.seasons = 14}, 4));
  const auto sites = leaf_sites(tree.input, FoliageLevel::clusters);
  const auto middle = [](const TriangleMesh& m) {
    DVec3 sum{0};
    for (const Vec3& p : m.positions) sum += DVec3(p);
    return sum / static_cast<double>(m.positions.size());
  };
  const DVec3 all = middle(mesh_foliage(tree.input, FoliageLevel::clusters, sites, sites.size()));
  const DVec3 few = middle(mesh_foliage(tree.input, FoliageLevel::clusters, sites, sites.size() / 20));
  EXPECT_LT(glm::length(all - few), 0.25) << "the crown's middle moves by less than an internode";
}

TEST(Foliage, ALeafedTwigShowsItsLeavesAtTheSamePlace) {
  const Dressed tree(test_skeleton({.seasons = 6}, 5));
  const auto twigs = leaf_sites(tree.input, FoliageLevel::clusters);
  const auto leaves = leaf_sites(tree.input, FoliageLevel::leaves);
  const auto per_twig = static_cast<std::size_t>(single_leaves(tree.look.leaf)) + 1;
  ASSERT_EQ(leaves.size(), twigs.size() * per_twig);
  for (std::size_t k = 0; k < twigs.size(); ++k)
    for (std::size_t j = 0; j < per_twig; ++j) {
      EXPECT_EQ(leaves[k * per_twig + j].internode, twigs[k].internode);
      EXPECT_EQ(leaves[k * per_twig + j].at, twigs[k].at);
    }
}

TEST(Foliage, LeavesDoNotChangeWhenAnotherBranchFalls) {
  const Dressed before(test_skeleton({}, 6));
  growth::Skeleton s = before.skeleton;
  // The thinnest lateral with something on it falls.
  std::size_t falls = 0;
  for (std::size_t i = 1; i < s.size(); ++i)
    if (s.order[i] == 2 && (falls == 0 || s.radius[i] < s.radius[falls])) falls = i;
  ASSERT_GT(falls, 0u);
  for (std::size_t i = falls; i < s.size(); ++i)
    if (i == falls || (s.parent[i] >= 0 && s.shed[static_cast<std::size_t>(s.parent[i])] != growth::kNever))
      s.shed[i] = static_cast<std::uint16_t>(s.seasons - 1);
  const Dressed after(s);
  std::map<std::pair<std::uint32_t, std::uint16_t>, LeafSite> old;
  for (const LeafSite& site : leaf_sites(before.input, FoliageLevel::clusters))
    old[{site.internode, site.place}] = site;
  std::size_t same = 0, all = 0;
  for (const LeafSite& site : leaf_sites(after.input, FoliageLevel::clusters)) {
    const auto it = old.find({site.internode, site.place});
    ++all;
    same += it != old.end() && it->second.at == site.at && it->second.azimuth == site.azimuth &&
            it->second.size == site.size;
  }
  EXPECT_LT(all, old.size());
  EXPECT_GE(same + 3, all) << "at most the twig that was continued by what fell";
}

TEST(Foliage, ABareTreeHasNoSingleLeavesAndAnEvergreenKeepsThem) {
  Dressed tree(test_skeleton({.seasons = 6}, 1));
  tree.input.season = Season::bare;
  EXPECT_TRUE(leaf_sites(tree.input, FoliageLevel::leaves).empty());
  EXPECT_FALSE(leaf_sites(tree.input, FoliageLevel::clusters).empty()) << "their twigs are seen";
  tree.look.leaf.evergreen = true;
  EXPECT_FALSE(leaf_sites(tree.input, FoliageLevel::leaves).empty());
}

TEST(Foliage, AutumnTakesItsShareOfTheLeaves) {
  Dressed tree(test_skeleton({}, 1), {.autumn_fall = 0.4f});
  const auto summer = static_cast<double>(leaf_sites(tree.input, FoliageLevel::clusters).size());
  tree.input.season = Season::autumn;
  const auto autumn = static_cast<double>(leaf_sites(tree.input, FoliageLevel::clusters).size());
  EXPECT_NEAR(autumn / summer, 0.6, 4.0 * std::sqrt(0.24 / summer));  // four standard errors
}

TEST(Foliage, APetioleBendsAsTheClosedFormSays) {
  // Bend alone turns the heading in the vertical plane: its elevation x follows dx/ds = -e sin x, so
  // tan(x/2) = tan(x0/2) exp(-e). The scheme is of first order with steps of at most 1/4 of e.
  for (const float degrees_up : {20.0f, 50.0f, 80.0f})
    for (const float bend : {0.3f, 1.0f, 2.0f}) {
      const SinCos x0 = sin_cos(radians(degrees_up));
      const LeafFrame start{{x0.cos, x0.sin, 0}, {0, 0, -1}, {-x0.sin, x0.cos, 0}};
      ASSERT_NEAR(glm::dot(glm::cross(start.heading, start.left), start.up), 1.0f, 1e-6f);
      const LeafFrame end = turn_petiole(start, kUp, 0, bend, 0);
      const float wanted = 2.0f * std::atan(std::tan(0.5f * radians(degrees_up)) * std::exp(-bend));
      EXPECT_NEAR(std::asin(end.heading.y), wanted, radians(4.0f));
      EXPECT_NEAR(end.heading.z, 0.0f, 1e-6f);
    }
}

TEST(Foliage, TwistKeepsTheHeadingAndLaysTheBladeLevel) {
  const LeafFrame start{{1, 0, 0}, {0, 0.8f, 0.6f}, {0, -0.6f, 0.8f}};
  const LeafFrame end = turn_petiole(start, kUp, 5, 0, 0);
  EXPECT_NEAR(end.heading.x, 1.0f, 1e-5f);
  EXPECT_GT(end.up.y, 0.95f);
}

TEST(Foliage, FramesStayRightAngled) {
  RandomStream random(1, 2, Purpose::foliage);
  for (int n = 0; n < 200; ++n) {
    const Vec3 h =
        across(glm::normalize(Vec3{random.uniform(-1, 1), random.uniform(-1, 1), 0.3f}), random.uniform(0, 6));
    const Vec3 u = across(h, random.uniform(0, 6));
    const LeafFrame f = turn_petiole({h, glm::cross(u, h), u}, across(u, random.uniform(0, 6)), random.uniform(0, 10),
                                     random.uniform(0, 10), random.uniform(0, 10));
    EXPECT_NEAR(glm::length(f.heading), 1.0f, 1e-4f);
    EXPECT_NEAR(glm::dot(f.heading, f.up), 0.0f, 1e-4f);
    EXPECT_NEAR(glm::length(glm::cross(f.up, f.heading) - f.left), 0.0f, 1e-4f);
  }
}

TEST(Foliage, HangingTwigsHang) {
  const auto mean_rise = [](float droop_deg) {
    const Dressed tree(test_skeleton({.seasons = 8}, 2), {.cluster_droop_deg = droop_deg, .bend = 3.0f, .fold_deg = 0});
    const TriangleMesh m = tree.mesh(FoliageLevel::clusters);
    double rise = 0;  // from foot to top of each card: vertices 0-2 are its foot, 3-5 its top
    for (std::size_t v = 0; v + 5 < m.positions.size(); v += 6) {
      const Vec3 d = m.positions[v + 4] - m.positions[v + 1];
      rise += static_cast<double>(d.y / glm::length(d));
    }
    return rise / (static_cast<double>(m.positions.size()) / 6.0);
  };
  const double level = mean_rise(0), some = mean_rise(45), hanging = mean_rise(85);
  EXPECT_GT(level, some + 0.15);
  EXPECT_GT(some, hanging + 0.15);
}

TEST(Foliage, CardsShowOneCellOfTheAtlas) {
  const Dressed tree(test_skeleton({.seasons = 6}, 3));
  const TriangleMesh m = tree.mesh(FoliageLevel::clusters);
  for (std::size_t t = 0; t < m.triangles(); ++t) {
    bool left = true, right = true;
    for (int k = 0; k < 3; ++k) {
      const Vec2 uv = m.uvs[m.indices[3 * t + static_cast<std::size_t>(k)]];
      EXPECT_GT(uv.y, 0.0f);
      EXPECT_LT(uv.y, 0.5f) << "twig clusters are in the upper row";
      left = left && uv.x > 0.0f && uv.x < 0.5f;
      right = right && uv.x > 0.5f && uv.x < 1.0f;
    }
    EXPECT_TRUE(left || right);
  }
}

/// Share of the cards that show the first column of the atlas.
double in_bloom(const TriangleMesh& m) {
  std::size_t first = 0;
  for (std::size_t t = 0; t < m.triangles(); ++t) first += m.uvs[m.indices[3 * t]].x < 0.5f;
  return m.empty() ? 0.0 : static_cast<double>(first) / static_cast<double>(m.triangles());
}

TEST(Foliage, TwigsBloomInTheirSeasonByShareAndLight) {
  Dressed tree(test_skeleton({}, 8));
  Bloom& flower = tree.look.leaf.flower;
  flower.form = BloomForm::corymb;
  std::fill(tree.skeleton.light.begin(), tree.skeleton.light.end(), 0.3f);  // evenly lit: the crown's brightest is all
  for (const float share : {0.0f, 0.3f, 0.8f}) {
    flower.share = share;
    tree.input.season = Season::spring;
    const TriangleMesh m = tree.mesh(FoliageLevel::clusters);
    const double n = static_cast<double>(m.triangles()) / 4.0;
    EXPECT_NEAR(in_bloom(m), static_cast<double>(share), 4.0 * std::sqrt(0.25 / n)) << "four standard errors";
  }
  // Three quarters are darker: their L is at most 0.75, and where L^2 is below 1 - share nothing blooms.
  flower.share = 0.35f;
  std::vector<float>& light = tree.skeleton.light;
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = i % 4 == 0 ? 1.0f : 0.6f;
  std::size_t bright = 0;
  const auto sites = leaf_sites(tree.input, FoliageLevel::leaves);
  for (const LeafSite& site : sites) {
    if (!site.is_bunch()) continue;
    EXPECT_EQ(light[site.internode], 1.0f);
    ++bright;
  }
  EXPECT_GT(bright, 20u);
  EXPECT_EQ(bright % static_cast<std::size_t>(flower.bunches), 0u) << "twigs bloom as a whole";
}

TEST(Foliage, ABloomIsSeenFromItsFirstToItsLastSeasonRoundTheYear) {
  Bloom bloom;
  EXPECT_FALSE(bloom.shows(Season::spring)) << "none";
  bloom.form = BloomForm::cones, bloom.from = Season::autumn, bloom.to = Season::spring;
  EXPECT_TRUE(bloom.shows(Season::autumn) && bloom.shows(Season::bare) && bloom.shows(Season::spring));
  EXPECT_FALSE(bloom.shows(Season::summer));
  bloom.from = Season::summer, bloom.to = Season::autumn;
  EXPECT_TRUE(bloom.shows(Season::summer) && bloom.shows(Season::autumn));
  EXPECT_FALSE(bloom.shows(Season::spring) || bloom.shows(Season::bare));
}

TEST(Foliage, WeakBranchesAreYellower) {
  Dressed strong(test_skeleton({.seasons = 8}, 7), {.vigor_hue = 0.5f});
  std::fill(strong.skeleton.vigor.begin(), strong.skeleton.vigor.end(), 1.0f);
  Dressed weak(strong.skeleton, strong.foliage);
  std::fill(weak.skeleton.vigor.begin(), weak.skeleton.vigor.end(), 0.0f);
  const auto blue_in_red = [](const TriangleMesh& m) {
    double red = 0, blue = 0;
    for (const Rgba8& c : m.colours) red += c.r, blue += c.b;
    return blue / red;
  };
  EXPECT_LT(blue_in_red(weak.mesh(FoliageLevel::clusters)), 0.9 * blue_in_red(strong.mesh(FoliageLevel::clusters)));
}

}  // namespace
}  // namespace bosquet::geometry
