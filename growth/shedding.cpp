// Shedding: branches that do not pay for themselves fall.
//
// Source    Takenaka 1994; Longay 2014, 4.3.2: a branch is shed when vigor / size < Th
// Decision  size in internodes at detail 1, both as they were when vigor was shared; v at the root is Q at the root, so
//           v / size is about the mean exposure of its internodes
// Model     the foot of the crown rises to crown_lift * h^2 / h_max at height h, and the first branches of a trunk fall when
//           it has passed them: they are temporary, shaded and far from what they cost (a pine's or a birch's low limbs
//           die in the open too). Each branch has its own share of that height, between 0.6 and 1.2
#include <cstddef>

#include "growth/light.h"
#include "growth/tree.h"

namespace bosquet::growth {

namespace {

void fall(Tree& tree, std::size_t i) {
  Skeleton& wood = tree.wood;
  wood.light[i] = light_at(tree, wood.distal[i]);
  if (wood.born[i] != tree.season) tree.scale_vigor(i);
  wood.shed[i] = static_cast<std::uint16_t>(tree.season);
  tree.shadow.take_back(wood.distal[i]);
  tree.occupancy.remove(wood.distal[i]);
  ++tree.work.shadow_updates;
}

constexpr std::uint64_t kOfBranch = std::uint64_t{1} << 40;  ///< numbers of the tree's stream that growth never reaches

}  // namespace

bool outgrown(const Tree& tree, std::int32_t node) {
  const auto i = static_cast<std::size_t>(node);
  const Internode& base = tree.internodes[i];
  if (base.order != 1 || base.parent < 0) return false;
  const float foot = tree.parameters->crown_lift * tree.height_m * tree.height_m / tree.input->max_height_m;
  const float at = tree.wood.distal[static_cast<std::size_t>(base.parent)].y;
  if (at >= 1.2f * foot) return false;
  const float own = static_cast<float>(tree.random.at(kOfBranch + tree.wood.axis[i]) >> 40) * 0x1p-24f;
  return at < foot * (0.6f + 0.6f * own);
}

void shed(Tree& tree) {
  if (tree.failing.size() == 0) return;
  Skeleton& wood = tree.wood;
  const auto fallen = [&](std::int32_t i) { return i >= 0 && !wood.alive(static_cast<std::size_t>(i)); };
  // What stands on shed wood falls with it, and so do the bare internodes below it.
  auto failing = tree.failing.begin();
  std::size_t kept = 0;
  for (const std::int32_t node : tree.standing) {
    const bool fails = failing != tree.failing.end() && *failing == node;
    failing += fails;
    const std::int32_t below = tree.internodes[static_cast<std::size_t>(node)].parent;
    if (!fails && !fallen(below)) {
      tree.standing[kept++] = node;
      continue;
    }
    if (!fallen(below)) lose_lateral(tree, below);
    const float vigor = wood.vigor[static_cast<std::size_t>(node)];
    for (std::int32_t i = node; i != below; i = wood.parent[static_cast<std::size_t>(i)]) {
      wood.vigor[static_cast<std::size_t>(i)] = vigor;
      fall(tree, static_cast<std::size_t>(i));
    }
  }
  tree.standing.resize(kept);
  for (std::size_t i = tree.listed; i < wood.size(); ++i) {
    if (fallen(wood.parent[i])) fall(tree, i);
  }
}

}  // namespace bosquet::growth
