// Shedding: branches that do not pay for themselves fall, and buds without space or light die.
//
// Source    Takenaka 1994; Longay 2014, 4.3.2: a branch is shed when vigor / size < Th
// Decision  size in internodes at detail 1, both as they were when vigor was shared; v at the root is Q at the root, so
//           v / size is about the mean exposure of its internodes
#include <cstddef>
#include <limits>

#include "growth/tree.h"

namespace bosquet::growth {

namespace {

void fall(Tree& tree, std::size_t i) {
  Skeleton& wood = tree.wood;
  wood.light[i] = light_at(tree, wood.distal[i]);
  if (wood.born[i] != tree.season) wood.vigor[i] = tree.vigor_share(i);
  wood.shed[i] = static_cast<std::uint16_t>(tree.season);
  tree.shadow.take_back(wood.distal[i]);
  tree.occupancy.remove(static_cast<std::int32_t>(i));
  ++tree.work.shadow_updates;
}

}  // namespace

void shed(Tree& tree) {
  if (tree.failing.empty()) return;
  Skeleton& wood = tree.wood;
  const auto stands_on_fallen = [&](std::size_t i) {
    return wood.parent[i] >= 0 && !wood.alive(static_cast<std::size_t>(wood.parent[i]));
  };
  // What stands on shed wood falls with it.
  auto failing = tree.failing.begin();
  std::size_t kept = 0;
  for (const std::int32_t node : tree.standing) {
    const auto i = static_cast<std::size_t>(node);
    const bool fails = failing != tree.failing.end() && *failing == node;
    failing += fails;
    if (fails || stands_on_fallen(i)) {
      fall(tree, i);
    } else {
      tree.standing[kept++] = node;
    }
  }
  tree.standing.resize(kept);
  for (std::size_t i = tree.listed; i < wood.size(); ++i) {
    if (stands_on_fallen(i)) fall(tree, i);
  }
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    if (tree.buds.node[b] >= 0 && !wood.alive(static_cast<std::size_t>(tree.buds.node[b]))) {
      tree.buds.state[b] = BudState::dead;
    }
  }
}

void bury_dead_buds(Tree& tree) {
  Buds& buds = tree.buds;
  const bool painted = !tree.input->markers.empty();  // then buds wait for the next stroke
  const int life = painted ? std::numeric_limits<int>::max() : tree.parameters->bud_life_seasons;
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
