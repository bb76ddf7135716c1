#include "growth/light.h"

#include <algorithm>
#include <array>

#include "core/scalar.h"

namespace bosquet::growth {
namespace {

constexpr int kLightSteps = 512;         ///< L^kappa is read from a table by linear interpolation
constexpr std::size_t kMostTables = 64;  ///< kept, so that trees of one species and phase share theirs

}  // namespace

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

void place_buds(Tree& tree) {
  if (tree.placed_in == tree.shadow.layout()) return;
  tree.placed_in = tree.shadow.layout();
  const ShadowGrid::Reader shadow = tree.shadow.reader();
  for (const std::int32_t bud : tree.living) {
    Bud& b = tree.buds[static_cast<std::size_t>(bud)];
    b.place = shadow.place(b.at);
  }
}

void sense_light(Tree& tree, std::span<const std::int32_t> of) {
  const ShadowGrid::Reader shadow = tree.shadow.reader();
  std::array<const float*, kOrders> response;
  for (std::size_t order = 0; order < kOrders; ++order) {
    response[order] = tree.light_response.data() + tree.light_table[order];
  }
  Bud* const buds = tree.buds.each.data();
  Internode* const internodes = tree.internodes.each.data();
  for (const std::int32_t bud : of) {
    Bud& b = buds[bud];
    const float light = larger(b.sky * shadow.exposure(b.place), kLeastLight);
    const float step = light * kLightSteps;
    const int i = static_cast<int>(step);
    const float* at = response[std::min<std::size_t>(b.order, kOrders - 1)] + i;
    b.signal = b.factor * (at[0] + (at[1] - at[0]) * (step - static_cast<float>(i)));
    if (b.node < 0) continue;  // a stem's first bud: nothing stands below it
    internodes[b.node].gathered[b.state == BudState::terminal ? kMainSignal : kLateralSignal] += b.signal;
  }
}

}  // namespace bosquet::growth
