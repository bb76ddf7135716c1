// Vigor: the signal that buds send down, and what they get back for it.
//
// Source    Longay 2014, 4.2.2 and 4.3.2, eq. 4.1, 4.2, after Palubicki et al. 2009 (extended Borchert-Honda)
// Model     at a fork whose main way and laterals gathered Q_m and Q_l,
//             v_m = v * lambda*Q_m / (lambda*Q_m + (1 - lambda)*Q_l),     v_l = v - v_m
// Decision  every living bud reports Q; several laterals at a node share v_l in proportion to their Q; v at the root is
//           Q at the root; when nothing reports, both shares are 0
// Decision  shedding compares vigor and size of a branch as they are here, its size in internodes; a tree whose own tip
//           stands in deep shade asks less of its branches, or it would drop them all
// Decision  internodes that bear nothing to a side are left out: what passes them is not changed (tree.h)
// Cost      one backward and one forward sweep over the other living internodes, no allocation
#include <algorithm>
#include <array>
#include <limits>

#include "growth/tree.h"

namespace bosquet::growth {
namespace {

/// Lists the internodes born last season.
void list_standing(Tree& tree) {
  const Internodes& in = tree.internodes;
  for (; tree.listed < tree.wood.size(); ++tree.listed) {
    if (!tree.wood.alive(tree.listed)) continue;
    tree.standing.push_back(static_cast<std::int32_t>(tree.listed));
    const Internode& i = in[tree.listed];
    if (i.parent >= 0 && i.way == kMain && in.parts[static_cast<std::size_t>(i.parent)].laterals == 0)
      tree.thinned.push_back(i.parent);
  }
}

/// Those that are bare now leave their place to the next one above. They stay listed until the next sweep up.
void pass_over_bare(Tree& tree) {
  Internodes& in = tree.internodes;
  for (const std::int32_t node : tree.thinned) {
    const auto n = static_cast<std::size_t>(node);
    const std::int32_t above = in.parts[n].above;
    if (!tree.wood.alive(n) || above < 0 || static_cast<std::size_t>(above) >= tree.listed) continue;
    Internode &i = in[n], &heir = in[static_cast<std::size_t>(above)];
    if (i.span == 0 || i.span + heir.span > std::numeric_limits<std::uint16_t>::max()) continue;
    heir.span = static_cast<std::uint16_t>(heir.span + i.span), i.span = 0;
    heir.gathered[kStanding] = heir.span, i.gathered[kStanding] = 0.0f;
    heir.parent = i.parent, heir.way = i.way;
    if (i.parent >= 0 && i.way == kMain) in.parts[static_cast<std::size_t>(i.parent)].above = above;
  }
  tree.thinned.clear();
}

constexpr float kShaded = 0.5f;  ///< signal of a trunk's tip below which its tree counts as shaded

/// The part of its threshold that a branch must earn to stay.
float asked(const Tree& tree) {
  float best = 0.0f;
  for (int stem = 0; stem < tree.parameters->stems; ++stem) {
    best = std::max(best, tree.buds[static_cast<std::size_t>(tree.tip_of[static_cast<std::size_t>(stem)])].signal);
  }
  const float share = best / kShaded;
  return share < 1.0f ? share * share : 1.0f;
}

struct OrderNumbers {
  float lambda, rest, shedding;  ///< rest is 1 - lambda
};

}  // namespace

void fill_in_vigor(Tree& tree) {
  std::vector<float>& vigor = tree.wood.vigor;
  for (std::size_t i = tree.listed; i-- > 0;) {
    const bool bare = (tree.internodes[i].span == 0) & tree.wood.alive(i);
    vigor[i] = vigor[bare ? static_cast<std::size_t>(tree.internodes.parts[i].next) : i];
  }
}

void share_vigor(Tree& tree) {
  list_standing(tree);
  pass_over_bare(tree);
  Internode* const in = tree.internodes.each.data();
  std::int32_t* const standing = tree.standing.data();
  const std::size_t listed = tree.standing.size();

  // Down: what buds told their node, every node tells the one below. No branch depends on which way it stands there.
  constexpr Float4 kTold[2] = {{1.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f}};
  for (std::size_t s = listed; s-- > 0;) {
    const Internode& i = in[standing[s]];
    if (i.parent < 0) continue;
    const Float4 number{0.0f, 0.0f, i.gathered[kStanding], 0.0f};
    const float signal = i.gathered[kMainSignal] + i.gathered[kLateralSignal];
    in[i.parent].gathered += number + kTold[i.way] * all4(signal);
  }

  // Up: v at the root is Q at the root, so stems share it as they reported. Nothing waits for the next season's signal.
  std::array<OrderNumbers, kOrders> numbers{};
  const float due = asked(tree);
  for (std::size_t order = 0; order < kOrders; ++order) {
    const Habit& habit = tree.habits[order];
    numbers[order] = {habit.lambda, 1.0f - habit.lambda, due * habit.shedding};
  }
  std::int32_t* const failing = tree.failing.make_room(listed);
  float* const vigor = tree.wood.vigor.data();
  const bool lifts = tree.parameters->crown_lift > 0.0f;
  std::size_t fail = 0, kept = 0;
  for (std::size_t s = 0; s < listed; ++s) {
    const std::int32_t node = standing[s];
    Internode& i = in[node];
    if (i.span == 0) continue;
    standing[kept++] = node;
    const OrderNumbers& order = numbers[std::min<std::size_t>(i.order, kOrders - 1)];
    const float main = order.lambda * i.gathered[kMainSignal];
    const float q = i.gathered[kMainSignal] + i.gathered[kLateralSignal];
    const float sum = main + order.rest * i.gathered[kLateralSignal];
    const float part = where(sum > 0.0f, 1.0f / sum);
    float v = q;
    if (i.parent >= 0) {
      const std::array<float, 2> share{1.0f, q};
      v = in[i.parent].rate[i.way] * share[i.way];
      const bool falls = v < order.shedding * i.gathered[kStanding] || (lifts && outgrown(tree, node));
      failing[fail] = node, fail += (i.way == kLateral) & falls;
    }
    vigor[node] = v;
    i.rate[kMain] = v * (main * part);
    i.rate[kLateral] = v * (order.rest * part);
    i.gathered = Float4{0.0f, 0.0f, static_cast<float>(i.span), 0.0f};
  }
  tree.failing.keep(fail), tree.standing.resize(kept);
}

}  // namespace bosquet::growth
