// Parts of a season, on trees in the middle of their growth.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "growth/dropping.h"
#include "growth/tree.h"
#include "sample_trees.h"

namespace bosquet::growth {
namespace {

/// A tree after some seasons.
void grow_seasons(Tree& tree, const GrowthInput& input, int seasons) {
  plant(tree, input);
  for (int s = 0; s < seasons && !tree.finished; ++s) grow_season(tree);
}

struct Markers {
  std::vector<float> x, y, z;
  std::vector<std::int32_t> cell, bud;
  std::uint64_t next_random;
  bool operator==(const Markers&) const = default;
};

template <class Drop>
Markers dropped(const Tree& grown, Drop drop) {
  Tree tree = grown;
  Dropping dropping(tree);
  std::vector<std::int32_t> buds = tree.living;
  buds.resize(std::min(buds.size(), Dropping::kAtOnce));
  drop(dropping, buds);
  const auto first = [&](auto list) {
    list.resize(dropping.count());
    return list;
  };
  const DroppedMarkers& d = tree.dropped;
  return {first(d.x), first(d.y), first(d.z), first(d.cell), first(d.bud), tree.random.bits()};
}

RC_GTEST_PROP(Dropping, TwoBudsAtOnceDropTheMarkersOfOneAfterAnother, ()) {
  Parameters p = sample_parameters();
  p.marker_rate = static_cast<float>(*rc::gen::inRange(0, 17));
  p.planar = *rc::gen::inRange(0, 4) == 0;
  const GrowthInput input = sample_input(p, *rc::gen::inRange(1, 1000));
  Tree tree;
  grow_seasons(tree, input, *rc::gen::inRange(0, 25));
  const Markers plain = dropped(tree, [](Dropping& d, const auto& buds) { d.drop_plainly(buds); });
  RC_ASSERT(plain.x.size() >= std::min(tree.living.size(), Dropping::kAtOnce));
  RC_ASSERT(dropped(tree, [](Dropping& d, const auto& buds) { d.drop(buds); }) == plain);
}

TEST(Season, ABudKnowsTheCellOfTheShadowThatItStandsIn) {
  Parameters p = sample_parameters();
  p.deflection_angle_deg = 10.0f;  // turned wood takes its buds along
  p.set_point_angle_deg = 85.0f;   // and limbs leave the room that was expected
  const GrowthInput input = sample_input(p, 7, 20.0f);
  Tree tree;
  plant(tree, input);
  const int first_layout = tree.shadow.layout();
  std::size_t checked = 0;
  while (!tree.finished) {
    grow_season(tree);
    if (tree.placed_in != tree.shadow.layout()) continue;  // told anew when the next season begins
    for (const std::int32_t bud : tree.living) {
      const Bud& b = tree.buds[static_cast<std::size_t>(bud)];
      ASSERT_EQ(b.place, tree.shadow.reader().place(b.at)) << "season " << tree.season;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000u);
  EXPECT_GT(tree.shadow.layout(), first_layout) << "the grid never grew";
}

}  // namespace
}  // namespace bosquet::growth
