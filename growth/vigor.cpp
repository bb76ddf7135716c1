// Light at the buds, the signal they send down, and the vigor that they get back.
//
// Source    Longay 2014, 4.2.2 and 4.3.2, eq. 4.1, 4.2, 4.7, after Palubicki et al. 2009 (extended Borchert-Honda)
// Model     Q = b * L^kappa; at a fork whose main way and laterals gathered Q_m and Q_l,
//             v_m = v * lambda*Q_m / (lambda*Q_m + (1 - lambda)*Q_l),     v_l = v - v_m
// Decision  every living bud reports Q; several laterals at a node share v_l in proportion to their Q; v at the root is
//           Q at the root; when nothing reports, both shares are 0
// Decision  shedding compares vigor and size of a branch as they are here, its size in internodes
// Cost      one backward and one forward sweep over the living internodes, no allocation
#include <algorithm>
#include <array>
#include <cmath>

#include "core/scalar.h"
#include "growth/tree.h"

namespace bosquet::growth {
namespace {

constexpr int kLightSteps = 512;  ///< L^kappa is read from a table by linear interpolation

/// Tables of L^kappa for the distinct kappas in force; returns for each order where its table begins.
std::array<int, kOrders> light_tables(Tree& tree) {
  std::array<int, kOrders> begin{};
  std::vector<float>& table = tree.light_response;
  table.clear();
  for (int order = 0; order < kOrders; ++order) {
    const float kappa = tree.habits[static_cast<std::size_t>(order)].kappa;
    if (order > 0 && kappa == tree.habits[static_cast<std::size_t>(order - 1)].kappa) {
      begin[static_cast<std::size_t>(order)] = begin[static_cast<std::size_t>(order - 1)];
      continue;
    }
    begin[static_cast<std::size_t>(order)] = static_cast<int>(table.size());
    for (int i = 0; i <= kLightSteps; ++i) {
      table.push_back(kappa == 0.0f   ? 1.0f
                      : kappa == 1.0f ? static_cast<float>(i) / kLightSteps
                                      : pow(static_cast<float>(i) / kLightSteps, kappa));
    }
    table.push_back(1.0f);
  }
  return begin;
}

}  // namespace

void sense_light(Tree& tree) {
  tree.work.shadow_cells += tree.shadow.settle();
  const std::array<int, kOrders> tables = light_tables(tree);
  Buds& buds = tree.buds;
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    const float light = std::max(kLeastLight, buds.sky[b] * tree.shadow.exposure(buds.at[b]));
    const float step = light * kLightSteps;
    const int i = static_cast<int>(step);
    const float* at = tree.light_response.data() + tables[std::min<std::size_t>(buds.order[b], kOrders - 1)] + i;
    buds.signal[b] = buds.factor[b] * (at[0] + (at[1] - at[0]) * (step - static_cast<float>(i)));
  }
  tree.work.bud_visits += tree.living.size();
}

void share_vigor(Tree& tree) {
  Internodes& in = tree.internodes;
  Buds& buds = tree.buds;
  const Skeleton& wood = tree.wood;
  for (; tree.listed < wood.size(); ++tree.listed) {
    if (wood.alive(tree.listed)) tree.standing.push_back(static_cast<std::int32_t>(tree.listed));
  }
  tree.counts.resize(wood.size());
  for (const std::int32_t node : tree.standing) {
    const auto i = static_cast<std::size_t>(node);
    in.main_signal[i] = in.lateral_signal[i] = 0.0f;
    tree.counts[i] = 1;
  }

  // Down: buds report to their node, every node to the one below.
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    if (buds.node[b] < 0) continue;  // a stem's first bud: nothing stands below it
    const auto node = static_cast<std::size_t>(buds.node[b]);
    (buds.state[b] == BudState::terminal ? in.main_signal : in.lateral_signal)[node] += buds.signal[b];
  }
  for (std::size_t s = tree.standing.size(); s-- > 0;) {
    const auto i = static_cast<std::size_t>(tree.standing[s]);
    if (wood.parent[i] < 0) continue;
    const auto p = static_cast<std::size_t>(wood.parent[i]);
    tree.counts[p] += tree.counts[i];
    const float q = in.main_signal[i] + in.lateral_signal[i];
    if (q > 0.0f) (in.next[p] == static_cast<std::int32_t>(i) ? in.main_signal : in.lateral_signal)[p] += q;
  }

  // Up: v at the root is Q at the root, so stems share it as they reported.
  tree.failing.clear();
  for (const std::int32_t node : tree.standing) {
    const auto i = static_cast<std::size_t>(node);
    const float q_m = in.main_signal[i], q_l = in.lateral_signal[i];
    const Habit& habit = tree.habit(wood.order[i]);
    float v = q_m + q_l;
    if (wood.parent[i] >= 0) {
      const auto p = static_cast<std::size_t>(wood.parent[i]);
      if (in.next[p] == node) {
        v = in.main_vigor[p];
      } else {
        v *= in.lateral_rate[p];
        if (v < habit.shedding * static_cast<float>(tree.counts[i])) tree.failing.push_back(node);
      }
    }
    if (q_m + q_l <= 0.0f) {
      in.main_vigor[i] = in.lateral_rate[i] = 0.0f;
      continue;
    }
    const float main = habit.lambda * q_m, lateral = (1.0f - habit.lambda) * q_l;
    in.main_vigor[i] = v * (main / (main + lateral));
    in.lateral_rate[i] = q_l > 0.0f ? (v - in.main_vigor[i]) / q_l : 0.0f;
  }

  float greatest = 0.0f;
  for (const std::int32_t bud : tree.living) {
    const auto b = static_cast<std::size_t>(bud);
    float v = buds.signal[b];
    if (buds.node[b] >= 0) {
      const auto node = static_cast<std::size_t>(buds.node[b]);
      v = buds.state[b] == BudState::terminal ? in.main_vigor[node] : in.lateral_rate[node] * buds.signal[b];
    }
    buds.flow[b] = v;
    if (buds.claims[b] > 0) greatest = std::max(greatest, v);
  }
  tree.greatest_vigor = greatest;
}

}  // namespace bosquet::growth
