#include "distribution/kernels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr KernelKind kKinds[] = {KernelKind::none, KernelKind::clustering, KernelKind::inhibition};

RC_GTEST_PROP(Kernels, AKernelIsZeroOnTheTrunkAndOneBeyondItsActiveRadius, ()) {
  const float r = static_cast<float>(*rc::gen::inRange(1, 100)) / 100.0f;
  const float a = r + static_cast<float>(*rc::gen::inRange(1, 1000)) / 100.0f;
  const float s = static_cast<float>(*rc::gen::inRange(100, 10'000)) / 100.0f;
  for (const KernelKind kind : kKinds) {
    RC_ASSERT(kernel(kind, r, a, s, r) == 0.0f);
    RC_ASSERT(kernel(kind, r, a, s, 0.0f) == 0.0f);
    RC_ASSERT(std::abs(kernel(kind, r, a, s, a) - 1.0f) < 1e-5f);
    RC_ASSERT(kernel(kind, r, a, s, 1.001f * a) == 1.0f);
  }
}

RC_GTEST_PROP(Kernels, ClusteringFallsFromTheEffectToOneAndInhibitionRisesFromItsInverse, ()) {
  const float s = static_cast<float>(*rc::gen::inRange(101, 10'000)) / 100.0f;
  const float r = 0.25f, a = 4.0f;
  RC_ASSERT(std::abs(kernel(KernelKind::clustering, r, a, s, r * 1.00001f) - s) < 1e-4f * s);
  RC_ASSERT(std::abs(kernel(KernelKind::inhibition, r, a, s, r * 1.00001f) - 1.0f / s) < 1e-4f);
  float clustering = 2.0f * s, inhibition = 0.0f;
  for (float d = 0.26f; d < a; d += 0.05f) {
    const float c = kernel(KernelKind::clustering, r, a, s, d), i = kernel(KernelKind::inhibition, r, a, s, d);
    RC_ASSERT(c <= clustering);
    RC_ASSERT(i >= inhibition);
    clustering = c, inhibition = i;
  }
}

TEST(Kernels, AStrongerEffectInhibitsMoreAndAnEffectOfOneDoesNothing) {
  // The printed equation had this backwards: s = 1 was total inhibition.
  float before = 1.1f;
  for (const float s : {1.0f, 1.5f, 2.0f, 5.0f, 10.0f, 100.0f}) {
    const float edge = kernel(KernelKind::inhibition, 0.2f, 5.0f, s, 0.2001f);
    EXPECT_LT(edge, before);
    before = edge;
  }
  for (float d = 0.3f; d < 6; d += 0.3f) EXPECT_EQ(kernel(KernelKind::inhibition, 0.2f, 5.0f, 1.0f, d), 1.0f);
}

TEST(Kernels, AnActiveRadiusInsideTheTrunkActsAsNone) {
  for (const KernelKind kind : kKinds) {
    EXPECT_EQ(kernel(kind, 0.5f, 0.3f, 8.0f, 0.4f), 0.0f);
    EXPECT_EQ(kernel(kind, 0.5f, 0.3f, 8.0f, 0.6f), 1.0f);
  }
}

TEST(Kernels, TheStoredLogarithmsAreTheKernelsToWithinHalfAStep) {
  for (const KernelKind kind : {KernelKind::clustering, KernelKind::inhibition})
    for (const float s : {1.2f, 4.0f, 50.0f}) {
      const KernelTable table = log2_kernel_table(kind, s);
      EXPECT_EQ(table.clustering, kind == KernelKind::clustering);
      EXPECT_EQ(table.steps.back(), 0u);
      for (int n = 0; n < kKernelSteps; ++n) {
        const float d = 1.0f + (static_cast<float>(n) + 0.5f) / kKernelSteps * 3.0f;  // r = 1, a = 4
        const float exact = (1 << kLogBits) * std::log2(kernel(kind, 1.0f, 4.0f, s, d));
        EXPECT_NEAR(static_cast<float>(table.steps[static_cast<std::size_t>(n)]), std::abs(exact), 0.51f);
      }
    }
}

}  // namespace
}  // namespace bosquet::distribution
