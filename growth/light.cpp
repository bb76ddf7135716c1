#include "growth/light.h"

#include <cmath>

#include "core/scalar.h"

namespace bosquet::growth {
namespace {

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

}  // namespace bosquet::growth
