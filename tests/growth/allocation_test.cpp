// Growth works in arrays kept from tree to tree: once they are long enough a season allocates nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "growth/tree.h"
#include "sample_trees.h"

namespace {
thread_local long allocations = 0;
}  // namespace

// g++ 12 takes the inlined halves of a replaced pair for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

// Counts what this program's own code takes from the heap.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace bosquet::growth {
namespace {

/// Allocations in all seasons of a tree.
long grow_counting(Tree& tree, const GrowthInput& input) {
  plant(tree, input);
  const long before = allocations;
  while (!tree.finished) grow_season(tree);
  return allocations - before;
}

TEST(Allocation, NoSeasonAllocatesAfterAWarmUp) {
  Parameters p = sample_parameters();
  p.deflection_angle_deg = 10.0f, p.shedding_threshold = 0.05f;  // every step has work
  Tree tree;
  EXPECT_GT(grow_counting(tree, sample_input(p, 1)), 0) << "the count does not work";
  EXPECT_EQ(grow_counting(tree, sample_input(p, 1)), 0);
  // A smaller tree of another shape in the same arrays.
  p.light_sensitivity = 2.0f, p.phyllotaxis = Phyllotaxis::distichous;
  EXPECT_EQ(grow_counting(tree, sample_input(p, 2, 7.0f)), 0);
  EXPECT_GT(tree.wood.size(), 100u);
}

TEST(Allocation, AFinishedSkeletonHoldsNoMoreThanItNeeds) {
  const Parameters p = sample_parameters();
  const Skeleton s = grow(sample_input(p, 1));
  const std::size_t bytes =
      s.parent.capacity() * sizeof(s.parent[0]) + s.axis.capacity() * sizeof(s.axis[0]) + s.order.capacity() +
      s.distal.capacity() * sizeof(Vec3) + s.radius.capacity() * sizeof(float) + s.born.capacity() * sizeof(s.born[0]) +
      s.shed.capacity() * sizeof(s.shed[0]) + s.light.capacity() * sizeof(float) + s.vigor.capacity() * sizeof(float);
  EXPECT_LE(bytes, 41 * s.size());
}

}  // namespace
}  // namespace bosquet::growth
