#include "distribution/probability_field.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr std::uint64_t kOne = std::uint64_t{1} << 20;
const Region kEverywhere = Box2{Vec2{-1e6f}, Vec2{1e6f}};

std::optional<IVec2> draw(const ProbabilityField& field, const Region& where, std::uint64_t key) {
  const RegionMask mask = field.mask(where);
  std::vector<std::uint64_t> sums;
  field.sums_under(mask, Sums::suited, sums);
  return field.draw(mask, Sums::suited, sums, RandomStream(1, key, Purpose::planting), 0);
}

std::uint64_t sum(const ProbabilityField& field, const Region& where) {
  std::vector<std::uint64_t> sums;
  field.sums_under(field.mask(where), Sums::suited, sums);
  return sums[0];
}

TEST(ProbabilityField, WeightsAreTheKernelsOfTheStandingTreesMultiplied) {
  ProbabilityField field({90, 70}, 0.25f);
  const KernelTable near = log2_kernel_table(KernelKind::clustering, 6.0f);
  const KernelTable away = log2_kernel_table(KernelKind::inhibition, 3.0f);
  const Vec2 a{8.1f, 9.3f}, b{10.2f, 8.7f};
  field.add({a, 0.4f, 5.0f, &near, 0.4f});
  field.add({b, 0.6f, 4.0f, &away, 0.6f});
  int closed = 0;
  for (int j = 0; j < 70; ++j)
    for (int i = 0; i < 90; ++i) {
      const Vec2 centre = (Vec2(i, j) + 0.5f) * 0.25f;
      const float da = glm::distance(a, centre), db = glm::distance(b, centre);
      const float half_diagonal = 0.177f;
      const auto weight = static_cast<double>(field.weight({i, j})) / static_cast<double>(kOne);
      if (da < 0.4f - half_diagonal || db < 0.6f - half_diagonal) {
        EXPECT_EQ(weight, 0.0);
        ++closed;
      } else if (da > 0.4f && db > 0.6f) {
        const double exact = static_cast<double>(kernel(KernelKind::clustering, 0.4f, 5.0f, 6.0f, da)) *
                             kernel(KernelKind::inhibition, 0.6f, 4.0f, 3.0f, db);
        EXPECT_NEAR(weight, exact, 0.02 * exact);  // the table's steps are 1/512 of the active radius
      }
    }
  EXPECT_GT(closed, 4);
}

TEST(ProbabilityField, SumsEqualTheWeightsAddedUpUnderAnyMask) {
  ProbabilityField field({37, 53}, 0.5f);  // no powers of two
  const KernelTable near = log2_kernel_table(KernelKind::clustering, 30.0f);
  for (int n = 0; n < 12; ++n)
    field.add({{static_cast<float>(n) * 1.7f, static_cast<float>(n * n % 25)}, 0.3f, 4.0f, &near, 0.8f});
  Polygon polygon{{{1, 2}, {17, 4}, {13, 24}, {3, 20}}, {{{7, 8}, {11, 8}, {10, 14}}}};
  for (const Region& where : {kEverywhere, Region{Box2{{3.1f, 4.2f}, {9.9f, 22.2f}}}, Region{Disc{{9, 12}, 6.3f}},
                              Region{Disc{{0, 0}, 3.0f}}, Region{polygon}, Region{Disc{{500, 5}, 6.0f}}}) {
    std::uint64_t expected = 0;
    for (int j = 0; j < 53; ++j)
      for (int i = 0; i < 37; ++i)
        if (contains(where, (Vec2(i, j) + 0.5f) * 0.5f)) expected += field.weight({i, j});
    EXPECT_EQ(sum(field, where), expected);
  }
}

RC_GTEST_PROP(ProbabilityField, AddingAndRemovingInAnyOrderEqualsARebuildBitForBit, ()) {
  const KernelTable tables[] = {log2_kernel_table(KernelKind::clustering, 7.0f),
                                log2_kernel_table(KernelKind::inhibition, 9.0f)};
  ProbabilityField field({61, 45}, 0.2f);
  std::vector<Stamp> standing;
  for (int n = 0; n < 60; ++n) {
    if (!standing.empty() && *rc::gen::inRange(0, 3) == 0) {
      const auto which = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(standing.size())));
      field.remove(standing[which]);
      standing.erase(standing.begin() + static_cast<std::ptrdiff_t>(which));
    } else {
      const auto real = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) / 97.0f; };
      standing.push_back({{real(-200, 1500), real(-200, 1200)},
                          real(5, 60),
                          real(1, 400),
                          &tables[*rc::gen::inRange(0, 2)],
                          real(0, 100)});
      field.add(standing.back());
    }
  }
  std::reverse(standing.begin(), standing.end());
  ProbabilityField again({61, 45}, 0.2f);
  for (const Stamp& stamp : standing) again.add(stamp);
  RC_ASSERT(field == again);
}

TEST(ProbabilityField, OverlappingKernelsInAnyNumberNeverOverflow) {
  // A float product would be infinite after 13 of these; an int32 of logarithms in steps of 2^-16 would wrap after
  // 3,288.
  const KernelTable near = log2_kernel_table(KernelKind::clustering, 1000.0f);
  const KernelTable away = log2_kernel_table(KernelKind::inhibition, 1000.0f);
  ProbabilityField field({40, 40}, 0.5f);
  const Stamp stamp{{10, 10}, 0.2f, 6.0f, &near, 0.2f}, against{{10, 10}, 0.2f, 6.0f, &away, 0.2f};
  for (int n = 0; n < 100'000; ++n) field.add(stamp);
  EXPECT_NEAR(static_cast<double>(field.weight({20, 20})), 0x1p40, 0x1p30);
  EXPECT_EQ(field.weight({39, 39}), kOne);
  EXPECT_TRUE(draw(field, kEverywhere, 1));
  for (int n = 0; n < 100'000; ++n) field.add(against);
  EXPECT_NEAR(static_cast<double>(field.weight({20, 20})), 0x1p20, 0x1p10);  // both at their ends
  for (int n = 0; n < 100'000; ++n) field.remove(stamp);
  EXPECT_EQ(field.weight({20, 20}), 1u);  // 2^-20: hardly ever, but possible when nothing else is left
  for (int n = 0; n < 100'000; ++n) field.remove(against);
  EXPECT_EQ(field, ProbabilityField({40, 40}, 0.5f));
}

TEST(ProbabilityField, ClustersMultiplyUpToTheLargestFactorAndInhibitionIsNotLostInThem) {
  const KernelTable near = log2_kernel_table(KernelKind::clustering, 8.0f);
  const KernelTable away = log2_kernel_table(KernelKind::inhibition, 4.0f);
  ProbabilityField field({40, 40}, 0.5f, {}, 20.0f);
  const auto factor = [&] { return static_cast<double>(field.weight({20, 20})) / static_cast<double>(kOne); };
  const Stamp stamp{{10.25f, 10.25f}, 0.0f, 600.0f, &near, 0.0f}, against{{10.25f, 10.25f}, 0.0f, 600.0f, &away, 0.0f};
  field.add(stamp);
  EXPECT_NEAR(factor(), 8.0, 0.02);
  for (int n = 0; n < 50; ++n) field.add(stamp);
  EXPECT_NEAR(factor(), 20.0, 0.02);
  field.add(against);
  EXPECT_NEAR(factor(), 5.0, 0.01);
}

TEST(ProbabilityField, CellsAreDrawnInProportionToTheirWeights) {
  std::vector<std::uint8_t> suitability(7 * 5);
  for (std::size_t n = 0; n < suitability.size(); ++n) suitability[n] = static_cast<std::uint8_t>((n * 37 + 11) % 256);
  suitability[9] = 0;
  const ProbabilityField field({7, 5}, 1.0f, suitability);
  const RegionMask mask = field.mask(kEverywhere);
  std::vector<std::uint64_t> sums;
  field.sums_under(mask, Sums::suited, sums);
  std::vector<int> drawn(35);
  constexpr int kDraws = 200'000;
  for (int n = 0; n < kDraws; ++n) {
    const auto cell =
        field.draw(mask, Sums::suited, sums, RandomStream(1, static_cast<std::uint64_t>(n), Purpose::planting), 0);
    ++drawn[static_cast<std::size_t>(cell->y * 7 + cell->x)];
  }
  double chi2 = 0.0;
  for (std::size_t n = 0; n < 35; ++n) {
    const IVec2 cell{static_cast<int>(n % 7), static_cast<int>(n / 7)};
    const double expected = kDraws * static_cast<double>(field.weight(cell)) / static_cast<double>(sums[0]);
    if (expected == 0.0) {
      EXPECT_EQ(drawn[n], 0);
    } else {
      chi2 += (drawn[n] - expected) * (drawn[n] - expected) / expected;
    }
  }
  EXPECT_LT(chi2, 65.2);  // 33 degrees of freedom, p = 0.0007
}

TEST(ProbabilityField, ADrawStaysInsideTheMaskAndOffClosedCells) {
  ProbabilityField field({64, 64}, 0.5f);
  const Region where = Disc{{12, 17}, 3.0f};
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i)
      if (contains(where, (Vec2(i, j) + 0.5f) * 0.5f) && (i + j) % 9 != 0) field.close({i, j});
  for (std::uint64_t key = 0; key < 300; ++key) {
    const auto cell = draw(field, where, key);
    ASSERT_TRUE(cell);
    EXPECT_TRUE(contains(where, (Vec2(*cell) + 0.5f) * 0.5f));
    EXPECT_EQ((cell->x + cell->y) % 9, 0);
  }
}

TEST(ProbabilityField, NothingIsDrawnWhereNoWeightIsLeft) {
  ProbabilityField field({16, 16}, 1.0f);
  field.add({{8, 8}, 0.3f, 0.0f, nullptr, 5.0f});
  EXPECT_FALSE(draw(field, Disc{{8, 8}, 2.0f}, 1));
  EXPECT_TRUE(draw(field, Disc{{8, 8}, 7.0f}, 1));
  EXPECT_FALSE(draw(field, Disc{{80, 80}, 7.0f}, 1));
}

TEST(ProbabilityField, OnlyDrawsThatFellWhereWeightWasTakenChange) {
  // Of the draws outside a closed corner (6.25 %), few may fall elsewhere: those whose way led through its quadrant.
  const IVec2 cells{128, 128};
  const ProbabilityField before(cells, 1.0f);
  std::vector<std::uint8_t> suitability(128 * 128, 255);
  const auto closed = [](IVec2 c) { return c.x < 32 && c.y < 32; };
  for (int j = 0; j < 128; ++j)
    for (int i = 0; i < 128; ++i)
      if (closed({i, j})) suitability[static_cast<std::size_t>(j * 128 + i)] = 0;
  const ProbabilityField after(cells, 1.0f, suitability);
  int outside = 0, moved = 0;
  for (std::uint64_t key = 0; key < 4000; ++key) {
    const auto a = draw(before, kEverywhere, key), b = draw(after, kEverywhere, key);
    ASSERT_FALSE(closed(*b));
    if (closed(*a)) continue;
    ++outside;
    moved += *a != *b;
  }
  EXPECT_LT(moved, outside * 6 / 100);
}

}  // namespace
}  // namespace bosquet::distribution
