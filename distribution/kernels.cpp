#include "distribution/kernels.h"

#include <cassert>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

float smoother_step(float x) { return x * x * x * (x * (x * 6.0f - 15.0f) + 10.0f); }

// K at x = (d - r)/(a - r) in [0, 1].
float kernel_at(KernelKind kind, float effect, float x) {
  switch (kind) {
    case KernelKind::clustering:
      return 1.0f + (effect - 1.0f) * smoother_step(1.0f - x);
    case KernelKind::inhibition:
      return 1.0f / effect + (1.0f - 1.0f / effect) * smoother_step(x);
    case KernelKind::none:
      break;
  }
  return 1.0f;
}

}  // namespace

float kernel(KernelKind kind, float trunk_radius_m, float active_radius_m, float effect, float distance_m) {
  if (distance_m <= trunk_radius_m) return 0.0f;
  if (distance_m > active_radius_m) return 1.0f;
  return kernel_at(kind, effect, (distance_m - trunk_radius_m) / (active_radius_m - trunk_radius_m));
}

KernelTable log2_kernel_table(KernelKind kind, float effect) {
  assert(effect >= 1.0f);
  KernelTable table{kind == KernelKind::clustering, {}};
  for (int n = 0; n < kKernelSteps; ++n) {
    const float value = log2(kernel_at(kind, effect, (static_cast<float>(n) + 0.5f) / kKernelSteps));
    table.steps[static_cast<std::size_t>(n)] =
        static_cast<std::uint32_t>((value < 0.0f ? -value : value) * (1 << kLogBits) + 0.5f);
  }
  return table;
}

}  // namespace bosquet::distribution
