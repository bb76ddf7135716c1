// Light at the buds, the signal they send down, and the vigor that they get back.
//
// Source    Longay 2014, 4.2.2 and 4.3.2, eq. 4.1, 4.2, 4.7, after Palubicki et al. 2009 (extended Borchert-Honda)
// Model     Q = b * L^kappa; at a fork whose main way and laterals gathered Q_m and Q_l,
//             v_m = v * lambda*Q_m / (lambda*Q_m + (1 - lambda)*Q_l),     v_l = v - v_m
// Decision  every living bud reports Q; several laterals at a node share v_l in proportion to their Q; v at the root is
//           Q at the root; when nothing reports, both shares are 0
// Decision  shedding compares vigor and size of a branch as they are here, its size in internodes
// Decision  internodes that bear nothing to a side are left out: what passes them is not changed (tree.h)
// Cost      one backward and one forward sweep over the other living internodes, no allocation
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/scalar.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

constexpr int kLightSteps = 512;         ///< L^kappa is read from a table by linear interpolation
constexpr std::size_t kMostTables = 64;  ///< kept, so that trees of one species and phase share theirs

/// Lists the internodes born last season.
void list_standing(Tree& tree) {
  const Internodes& in = tree.internodes;
  for (; tree.listed < tree.wood.size(); ++tree.listed) {
    if (!tree.wood.alive(tree.listed)) continue;
    tree.standing.push_back(static_cast<std::int32_t>(tree.listed));
    const Internode& i = in[tree.listed];
    if (i.parent >= 0 && i.way == kMain && in.laterals[static_cast<std::size_t>(i.parent)] == 0)
      tree.thinned.push_back(i.parent);
  }
}

/// Those that are bare now leave their place to the next one above. They stay listed until the next sweep up.
void pass_over_bare(Tree& tree) {
  Internodes& in = tree.internodes;
  for (const std::int32_t node : tree.thinned) {
    const auto n = static_cast<std::size_t>(node);
    const std::int32_t above = in.above[n];
    if (!tree.wood.alive(n) || above < 0 || static_cast<std::size_t>(above) >= tree.listed) continue;
    Internode &i = in[n], &heir = in[static_cast<std::size_t>(above)];
    if (i.span == 0 || i.span + heir.span > std::numeric_limits<std::uint16_t>::max()) continue;
    heir.span = static_cast<std::uint16_t>(heir.span + i.span), i.span = 0;
    heir.gathered[kStanding] = heir.span, i.gathered[kStanding] = 0.0f;
    heir.parent = i.parent, heir.way = i.way;
    if (i.parent >= 0 && i.way == kMain) in.above[static_cast<std::size_t>(i.parent)] = above;
  }
  tree.thinned.clear();
}

}  // namespace

void fill_in_vigor(Tree& tree) {
  std::vector<float>& vigor = tree.wood.vigor;
  for (std::size_t i = tree.listed; i-- > 0;) {
    if (tree.internodes[i].span > 0 || !tree.wood.alive(i)) continue;
    vigor[i] = vigor[static_cast<std::size_t>(tree.internodes.next[i])];
  }
}

void tabulate_light_response(Tree& tree) {
  std::vector<float>& table = tree.light_response;
  table.reserve(kMostTables * (kLightSteps + 2)), tree.light_kappas.reserve(kMostTables);
  if (tree.light_kappas.size() + kOrders > kMostTables) table.clear(), tree.light_kappas.clear();
  for (std::size_t order = 0; order < kOrders; ++order) {
    const float kappa = tree.habits[order].kappa;
    const auto known = std::find(tree.light_kappas.begin(), tree.light_kappas.end(), kappa);
    tree.light_table[order] = static_cast<int>(known - tree.light_kappas.begin()) * (kLightSteps + 2);
    if (known != tree.light_kappas.end()) continue;
    tree.light_kappas.push_back(kappa);
    for (int i = 0; i <= kLightSteps; ++i) {
      table.push_back(kappa == 0.0f   ? 1.0f
                      : kappa == 1.0f ? static_cast<float>(i) / kLightSteps
                                      : pow(static_cast<float>(i) / kLightSteps, kappa));
    }
    table.push_back(1.0f);
  }
}

void sense_light(Tree& tree) {
  tree.work.shadow_cells += tree.shadow.settle();
  Buds& buds = tree.buds;
  Internodes& in = tree.internodes;
  for (const std::int32_t bud : tree.living) {
    Bud& b = buds[static_cast<std::size_t>(bud)];
    const float light = std::max(kLeastLight, b.sky * tree.shadow.exposure(b.at));
    const float step = light * kLightSteps;
    const int i = static_cast<int>(step);
    const float* at = tree.light_response.data() + tree.light_table[std::min<std::size_t>(b.order, kOrders - 1)] + i;
    b.signal = b.factor * (at[0] + (at[1] - at[0]) * (step - static_cast<float>(i)));
    if (b.node < 0) continue;  // a stem's first bud: nothing stands below it
    Internode& node = in[static_cast<std::size_t>(b.node)];
    node.gathered[b.state == BudState::terminal ? kMainSignal : kLateralSignal] += b.signal;
  }
  tree.work.bud_visits += tree.living.size();
}

void share_vigor(Tree& tree) {
  Internodes& in = tree.internodes;
  Buds& buds = tree.buds;
  Skeleton& wood = tree.wood;
  list_standing(tree);
  pass_over_bare(tree);

  // Down: what buds told their node, every node tells the one below. No branch depends on which way it stands there.
  constexpr Float4 kTold[2] = {{1.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f}};
  for (std::size_t s = tree.standing.size(); s-- > 0;) {
    const Internode& i = in[static_cast<std::size_t>(tree.standing[s])];
    if (i.parent < 0) continue;
    const Float4 number{0.0f, 0.0f, i.gathered[kStanding], 0.0f};
    const float signal = i.gathered[kMainSignal] + i.gathered[kLateralSignal];
    in[static_cast<std::size_t>(i.parent)].gathered += number + kTold[i.way] * all4(signal);
  }

  // Up: v at the root is Q at the root, so stems share it as they reported. Nothing waits for the next season's signal.
  tree.failing.resize(tree.standing.size());
  const bool lifts = tree.parameters->crown_lift > 0.0f;
  std::size_t failing = 0, kept = 0;
  for (const std::int32_t node : tree.standing) {
    Internode& i = in[static_cast<std::size_t>(node)];
    if (i.span == 0) continue;
    tree.standing[kept++] = node;
    const Habit& habit = tree.habit(i.order);
    const float main = habit.lambda * i.gathered[kMainSignal];
    const float lateral = (1.0f - habit.lambda) * i.gathered[kLateralSignal];
    const float q = i.gathered[kMainSignal] + i.gathered[kLateralSignal], sum = main + lateral;
    const float part = sum > 0.0f ? 1.0f / sum : 0.0f;
    float v = q;
    if (i.parent >= 0) {
      const std::array<float, 2> share{1.0f, q};
      v = in[static_cast<std::size_t>(i.parent)].rate[i.way] * share[i.way];
      tree.failing[failing] = node;
      const bool falls = v < habit.shedding * i.gathered[kStanding] || (lifts && outgrown(tree, node));
      failing += (i.way == kLateral) & falls;
    }
    wood.vigor[static_cast<std::size_t>(node)] = v;
    i.rate[kMain] = v * (main * part);
    i.rate[kLateral] = v * ((1.0f - habit.lambda) * part);
    i.gathered = Float4{0.0f, 0.0f, static_cast<float>(i.span), 0.0f};
  }
  tree.failing.resize(failing), tree.standing.resize(kept);

  float greatest = 0.0f;
  for (const std::int32_t bud : tree.living) {
    Bud& b = buds[static_cast<std::size_t>(bud)];
    float v = b.signal;
    if (b.node >= 0) {
      const Internode& node = in[static_cast<std::size_t>(b.node)];
      v = b.state == BudState::terminal ? node.rate[kMain] : node.rate[kLateral] * b.signal;
    }
    b.flow = v;
    if (b.claims > 0) greatest = std::max(greatest, v);
  }
  tree.greatest_vigor = greatest;
}

}  // namespace bosquet::growth
