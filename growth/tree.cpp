#include "growth/tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/scalar.h"
#include "growth/directions.h"
#include "growth/light.h"
#include "growth/region_test.h"

namespace bosquet::growth {
namespace {

constexpr float kLeastInternodes = 40.0f;  ///< h_max / l is kept at least this
constexpr float kShadowCell = 2.0f;        ///< in l at detail 1
constexpr float kMostCells = 600.0f;       ///< of the occupancy, from ground to top
constexpr int kIdleSeasons = 3;            ///< seasons without a new internode after which growth ends

/// Where wood may come to stand: in the region r, or where a free-standing tree's does.
Box3 expected_room(const GrowthInput& input, const crowns::CrownRegion* r, float margin_m) {
  Box3 room;
  if (r) {
    room.add(r->low);
    room.add(r->low + Vec3(r->cells) * Vec3(r->voxel_m, r->layer_m, r->voxel_m));
    // A tree alone on its site may be given all of it; the grid grows where wood does go that far.
    const float half = 2.0f * input.max_height_m;
    room.low = glm::max(room.low, Vec3{-half, room.low.y, -half});
    room.high = glm::min(room.high, Vec3{half, room.high.y, half});
  } else {
    const float half = 0.35f * input.max_height_m;
    room.add({-half, 0.0f, -half});
    room.add({half, input.max_height_m, half});
  }
  room.add(Vec3{-margin_m});
  room.add(Vec3{margin_m});
  room.low.y = 0.0f;
  room.high.y = std::min(room.high.y, input.max_height_m + margin_m);
  return room;
}

/// A terminal bud at the base, leaning by `lean` to `azimuth`.
void add_stem(Tree& tree, float lean, float azimuth) {
  const SinCos l = sin_cos(lean), a = sin_cos(azimuth);
  const Vec3 direction{l.sin * a.cos, l.cos, l.sin * a.sin};
  Buds& buds = tree.buds;
  const std::int32_t bud = buds.push_back(Vec3{0.0f}, direction, kNone, 0, BudState::terminal);
  const auto b = static_cast<std::size_t>(bud);
  const SinCos first = sin_cos(2.0f * kPi * tree.random.uniform());
  const Basis around = basis_around(direction);
  buds.origin[b].side =
      tree.parameters->planar ? Vec3{direction.y, -direction.x, 0.0f} : around.x * first.cos + around.y * first.sin;
  buds.origin[b].axis = tree.axes++;
  buds[b].place = tree.shadow.reader().place(Vec3{0.0f});
  buds[b].sky = tree.input->light ? tree.input->light->at(Vec3{0.0f}) : 1.0f;
  tree.tip_of.push_back(bud);
  tree.living.push_back(bud);
}

}  // namespace

void plant(Tree& tree, const GrowthInput& input) {
  const Parameters& p = *input.parameters;
  assert(input.max_height_m > 0.0f && input.detail > 0.0f);
  tree.input = &input, tree.parameters = &p;

  // Sizes: everything that is told in internodes follows the length.
  const float length = std::min(p.internode_length_m, input.max_height_m / kLeastInternodes);
  tree.length_m = length;
  tree.occupied_m = p.occupancy_radius * length;
  tree.reach_m = (p.occupancy_radius + p.perception_depth) * length;
  tree.cos_perception = sin_cos(radians(0.5f * p.perception_angle_deg)).cos;
  tree.leans = input.asymmetry != Vec3{0.0f};
  tree.phyllotactic = sin_cos(radians(p.phyllotactic_angle_deg));
  tree.between_buds.clear();
  for (int n = 0; n <= 2 * std::max(2, p.whorl); ++n) {
    tree.between_buds.push_back(sin_cos(2.0f * kPi / static_cast<float>(std::max(1, n))));
  }
  tree.phase = -2;
  tree.random = RandomStream(input.seed, input.key, Purpose::growth);
  tree.season = 0, tree.idle_seasons = 0, tree.finished = false;
  tree.height_m = 0.0f, tree.pressed_at_m = -1.0f, tree.axes = 0;
  tree.work = {};

  Skeleton& wood = tree.wood;
  wood.parent.clear(), wood.axis.clear(), wood.order.clear(), wood.distal.clear(), wood.radius.clear();
  wood.born.clear(), wood.shed.clear(), wood.light.clear(), wood.vigor.clear();
  wood.seasons = 0;
  wood.internode_length_m = tree.length_m, wood.detail = 1.0f;
  wood.tip_diameter_m = p.tip_diameter_m * (length / p.internode_length_m);
  wood.pipe_exponent = p.pipe_exponent;
  tree.internodes.clear(), tree.buds.clear(), tree.living.clear(), tree.tip_of.clear(), tree.growing.clear();
  tree.standing.clear(), tree.thinned.clear(), tree.failing.keep(0);
  tree.listed = 0, tree.greatest_vigor = 0.0f;

  // Cells of shadow stand where they would without a region, so that a region with room enough changes nothing.
  const Box3 room = expected_room(input, input.region, tree.reach_m);
  const float aside = kShadowCell * length * static_cast<float>(p.shadow_depth + 1);
  const Vec3 anchor = expected_room(input, nullptr, tree.reach_m).low - Vec3{aside, 0.0f, aside};
  tree.shadow.reset(room, anchor, kShadowCell * length, p.shadow_strength, p.shadow_falloff, p.shadow_depth);
  tree.placed_in = tree.shadow.layout();
  tree.occupancy.reset(room, tree.occupied_m, tree.reach_m, input.region,
                       input.region ? input.max_height_m - input.region->layer_m : 0.0f,
                       input.max_height_m / kMostCells);
  tree.samples.reset(p.perception_depth / p.occupancy_radius, tree.cos_perception, p.planar);

  tree.markers.clear(), tree.found_marker = false, tree.highest_marker_m = 0.0f;
  const RegionTest in_its_region(tree);
  for (const Vec3& marker : input.markers) {
    assert(glm::dot(marker, marker) < 1e12f);  // finite, and on any site
    if (marker.y <= 0.0f || !in_its_region(marker)) continue;
    tree.markers.push_back(marker);
    tree.highest_marker_m = std::max(tree.highest_marker_m, marker.y);
  }

  // Several stems lean apart, evenly around; in a plane to both sides.
  const float turn = p.planar ? 0.0f : 2.0f * kPi * tree.random.uniform();
  for (int i = 0; i < p.stems; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(p.stems);
    const float azimuth = p.planar ? (i % 2 ? kPi : 0.0f) : turn + 2.0f * kPi * share;
    const float lean = p.stems == 1 ? 0.0f : radians(p.stem_spread_deg) * (0.6f + 0.4f * tree.random.uniform());
    add_stem(tree, lean, azimuth);
  }
}

void update_habits(Tree& tree) {
  const float share = tree.height_m / tree.input->max_height_m;
  const int phase = phase_at(*tree.parameters, share);
  if (phase == tree.phase) return;
  tree.phase = phase;
  tree.habits = habits_at(*tree.parameters, share);
  tabulate_light_response(tree);
}

void grow_season(Tree& tree) {
  assert(!tree.finished);
  const std::size_t before = tree.wood.size();
  update_habits(tree);
  sense(tree);
  share_vigor(tree);
  bool tall = false;
  if (choose_growing(tree)) {
    deflect(tree);
    tall = extend(tree);
  }
  shed(tree);
  tree.idle_seasons = tree.wood.size() > before ? 0 : tree.idle_seasons + 1;
  ++tree.season;
  tree.finished = tall || tree.idle_seasons >= kIdleSeasons || tree.season >= tree.parameters->max_seasons;
}

}  // namespace bosquet::growth
