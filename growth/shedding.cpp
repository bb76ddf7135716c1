// Shedding: branches that do not pay for themselves fall, and buds without space or light die.
//
// Source    Takenaka 1994; Longay 2014, 4.3.2: a branch is shed when vigor / size < Th
// Decision  size in internodes at detail 1, both as they were when vigor was shared; v at the root is Q at the root, so
//           v / size is about the mean exposure of its internodes
#include <cstddef>

#include "growth/tree.h"

namespace bosquet::growth {

void shed(Tree& tree) {
  Skeleton& wood = tree.wood;
  Internodes& in = tree.internodes;
  bool any = false;
  for (const Habit& habit : tree.habits) any = any || habit.shedding > 0.0f;
  if (!any) return;

  // Living internodes of every branch, those of this season left out.
  const std::size_t n = wood.size();
  tree.counts.assign(n, 0);
  for (std::size_t i = n; i-- > 0;) {
    if (!wood.alive(i) || wood.born[i] == tree.season) continue;
    ++tree.counts[i];
    if (wood.parent[i] >= 0) tree.counts[static_cast<std::size_t>(wood.parent[i])] += tree.counts[i];
  }
  // A branch begins where the axis changes; what stands on shed wood falls with it.
  any = false;
  const auto now = static_cast<std::uint16_t>(tree.season);
  for (std::size_t i = 0; i < n; ++i) {
    if (!wood.alive(i) || wood.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(wood.parent[i]);
    bool falls = wood.shed[p] == now;
    if (!falls && wood.axis[p] != wood.axis[i] && wood.born[i] != tree.season) {
      const float threshold = tree.habit(wood.order[i]).shedding;
      const float size = static_cast<float>(tree.counts[i]) / wood.detail;
      const float v = in.lateral_rate[p] * (in.main_signal[i] + in.lateral_signal[i]);
      falls = v < threshold * size;
    }
    if (!falls) continue;
    any = true;
    wood.light[i] = light_at(tree, wood.distal[i]);
    if (wood.born[i] != tree.season) wood.vigor[i] = tree.vigor_share(i);
    wood.shed[i] = now;
    tree.shadow.take_back(wood.distal[i]);
    tree.occupancy.remove(static_cast<std::int32_t>(i));
    ++tree.work.shadow_updates;
  }
  if (!any) return;
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    if (tree.buds.node[b] >= 0 && !wood.alive(static_cast<std::size_t>(tree.buds.node[b]))) {
      tree.buds.state[b] = BudState::dead;
    }
  }
}

void bury_dead_buds(Tree& tree) {
  Buds& buds = tree.buds;
  const int life = tree.parameters->bud_life_seasons;
  std::size_t kept = 0;
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    if (buds.state[b] == BudState::dead || buds.idle[b] >= life) {
      buds.state[b] = BudState::dead;
      continue;
    }
    tree.living[kept++] = bud;
  }
  tree.living.resize(kept);
}

}  // namespace bosquet::growth
