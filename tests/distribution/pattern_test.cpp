#include "distribution/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "core/random.h"

namespace bosquet::distribution {
namespace {

constexpr double kPiD = std::numbers::pi;
const Box2 kSquare{{0, 0}, {10, 10}};

std::vector<Vec2> at_random(int n, const Box2& window, std::uint64_t seed) {
  RandomStream stream(seed, 0, Purpose::statistics);
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const float x = stream.uniform(window.low.x, window.high.x);
    points.push_back({x, stream.uniform(window.low.y, window.high.y)});
  }
  return points;
}

TEST(Pattern, KOfThreePointsByHand) {
  const std::vector<Vec2> points{{4, 5}, {5, 5}, {5, 7}};
  const std::vector<double> t{0.5, 1.0, 1.5, 2.1, 2.5};
  // Pairs at distances 1, 2 and sqrt 5; each counts twice, a pair at exactly t not at all.
  const auto plain = ripley_k_plain(points, kSquare, t);
  const double per_pair = 2.0 * 100.0 / 9.0;
  EXPECT_DOUBLE_EQ(plain[0], 0.0);
  EXPECT_DOUBLE_EQ(plain[1], 0.0);
  EXPECT_DOUBLE_EQ(plain[2], per_pair);
  EXPECT_DOUBLE_EQ(plain[3], 2 * per_pair);
  EXPECT_DOUBLE_EQ(plain[4], 3 * per_pair);
  // All circles lie inside: the isotropic estimator differs by n/(n - 1) alone.
  const auto isotropic = ripley_k(points, kSquare, t);
  for (std::size_t n = 0; n < t.size(); ++n) EXPECT_NEAR(isotropic[n], plain[n] * 3.0 / 2.0, 1e-9);
}

TEST(Pattern, TheShareOfACircleInsideTheWindowByHand) {
  EXPECT_DOUBLE_EQ(share_inside({5, 5}, 4.9, kSquare), 1.0);
  EXPECT_NEAR(share_inside({0, 5}, 2.0, kSquare), 0.5, 1e-7);         // on an edge
  EXPECT_NEAR(share_inside({0, 0}, 3.0, kSquare), 0.25, 1e-7);        // in a corner
  EXPECT_NEAR(share_inside({1, 5}, 2.0, kSquare), 2.0 / 3.0, 1e-6);   // a third beyond: acos(1/2) = 60 deg to each side
  EXPECT_NEAR(share_inside({1, 1}, 2.0, kSquare), 5.0 / 12.0, 1e-6);  // 30 deg .. 180 - ..: 150 of 360 deg are left
  EXPECT_NEAR(share_inside({1, 1}, 1.4, kSquare), 1.0 - 4 * std::acos(1 / 1.4) / (2 * kPiD), 1e-6);  // corner inside
}

TEST(Pattern, TheEdgeWeightsAreThoseOfTheCircleThroughTheOtherPoint) {
  // Seen from the edge half the circle lies inside, from the middle all of it.
  const std::vector<Vec2> points{{0, 5}, {2, 5}};
  const double expected = 100.0 / 2.0 * (1.0 / 0.5 + 1.0);
  EXPECT_NEAR(ripley_k(points, kSquare, std::vector<double>{3.0})[0], expected, 1e-4);
  const std::vector<Vec2> a{{0, 5}}, b{{2, 5}, {9, 9}};
  EXPECT_NEAR(cross_k(a, b, kSquare, std::vector<double>{3.0})[0], 100.0 / 2.0 * 2.0, 1e-4);
  EXPECT_NEAR(cross_k(b, a, kSquare, std::vector<double>{3.0})[0], 100.0 / 2.0 * 1.0, 1e-4);
}

TEST(Pattern, PointsAtRandomHaveAnUnbiasedKAndThePlainOneMissesThePairsAcrossTheEdge) {
  const Box2 window{{0, 0}, {30, 30}};
  const std::vector<double> t{5.0};
  double plain = 0, isotropic = 0, squares = 0;
  constexpr int kRuns = 400;
  for (int run = 0; run < kRuns; ++run) {
    const auto points = at_random(80, window, static_cast<std::uint64_t>(run));
    plain += ripley_k_plain(points, window, t)[0] / kRuns;
    const double k = ripley_k(points, window, t)[0];
    isotropic += k / kRuns;
    squares += k * k / kRuns;
  }
  const double error = std::sqrt((squares - isotropic * isotropic) / kRuns);
  EXPECT_NEAR(isotropic, kPiD * 25, 4 * error);
  // Plain: (n - 1)/n of pi t^2 less the lens lost at the edges, 4 t^3/3 (1/a + 1/b) - t^4 / (2 a b) of it.
  const double loss = 4 * 125.0 / 3.0 * (2 / 30.0) - 625.0 / (2 * 900.0);
  EXPECT_NEAR(plain, 79.0 / 80.0 * (kPiD * 25 - loss), 4 * error);
}

TEST(Pattern, LOfKIsTheRadiusOfACircleOfThatArea) {
  EXPECT_DOUBLE_EQ(ripley_l(std::vector<double>{kPiD * 49})[0], 7.0);
}

TEST(Pattern, PairCorrelationIsOneAtRandomAndSeesTheSpacingOfAGrid) {
  const Box2 window{{0, 0}, {100, 100}};
  const std::vector<double> t{5, 7.07, 8.5, 10, 12, 14.14};
  std::vector<double> mean(t.size());
  for (int run = 0; run < 40; ++run) {
    const auto g = pair_correlation(at_random(400, window, static_cast<std::uint64_t>(run)), window, t);
    for (std::size_t n = 0; n < t.size(); ++n) mean[n] += g[n] / 40;
  }
  for (const double g : mean) EXPECT_NEAR(g, 1.0, 0.03);
  std::vector<Vec2> grid;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) grid.push_back(Vec2(i, j) * 10.0f + 5.0f);
  const auto g = pair_correlation(grid, window, t);
  EXPECT_EQ(g[0], 0.0);
  EXPECT_GT(g[3], 3.0);  // 10 m: the grid's step
  EXPECT_EQ(g[4], 0.0);  // 12 m: nobody
  EXPECT_GT(g[5], 2.0);  // 14.1 m: the diagonal
}

TEST(Pattern, NearestDistancesAreThoseOfTheSlowSearch) {
  const auto points = at_random(300, {{0, 0}, {50, 20}}, 3);
  const auto nearest = nearest_distances(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    double least = 1e9;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (i != j)
        least = std::min(least, static_cast<double>(glm::distance(glm::dvec2(points[i]), glm::dvec2(points[j]))));
    EXPECT_NEAR(nearest[i], least, 1e-9);
  }
}

// One kind of Lansing Woods (Gerrard 1969), from the example's inventory.
std::vector<Vec2> lansing(const std::string& kind) {
  std::ifstream file(BOSQUET_SOURCE_DIR "/examples/data/lansing_woods.csv");
  std::vector<Vec2> points;
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    if (second == std::string::npos || line.substr(second + 1) != kind) continue;
    points.push_back({std::stof(line), std::stof(line.substr(first + 1))});
  }
  return points;
}

// Computed by spatstat.explore 3.0-6 for R 4.2.2: Kest and Kcross (correction = "isotropic"), mean of nndist, and pcf
// (stoyan = 0.15, divisor "d", isotropic), which smooths by a fast Fourier transform.
TEST(Pattern, AgreesWithSpatstatOnLansingWoods) {
  const Box2 window{{0, 0}, {281.7f, 281.7f}};
  const std::vector<double> t{2.005, 5.005, 10.005, 20.005};
  const auto compare = [](const std::vector<double>& ours, const std::vector<double>& theirs, double tolerance) {
    for (std::size_t n = 0; n < theirs.size(); ++n)
      EXPECT_NEAR(ours[n] / theirs[n], 1.0, tolerance) << "at t number " << n;
  };
  const auto black_oak = lansing("blackoak"), maple = lansing("maple"), hickory = lansing("hickory");
  ASSERT_EQ(black_oak.size(), 135u);
  ASSERT_EQ(maple.size(), 514u);
  // Positions are floats here: a pair may fall on the other side of t, a ten-thousandth of the pairs.
  compare(ripley_k(black_oak, window, t), {35.09337313, 263.20029851, 1015.71603575, 3041.91924011}, 1e-4);
  compare(ripley_k(maple, window, t), {34.30821012, 173.81848470, 585.24032729, 2148.04779559}, 1e-4);
  compare(cross_k(hickory, maple, window, t), {3.733396976, 37.235372477, 178.474549204, 793.208467400}, 1e-4);
  compare(cross_k(maple, hickory, window, t), {3.84963360, 37.17711658, 177.79728996, 784.61617451}, 1e-4);
  compare(pair_correlation(black_oak, window, t), {2.559142041, 2.829234861, 2.958262658, 1.700043080}, 0.01);
  double sum = 0;
  for (const double d : nearest_distances(maple)) sum += d;
  EXPECT_NEAR(sum / 514, 5.054075579, 1e-5);
}

TEST(Pattern, FewerThanTwoPointsHaveNoPattern) {
  const std::vector<Vec2> one{{5, 5}};
  const std::vector<double> t{1, 2};
  for (const auto& values : {ripley_k({}, kSquare, t), ripley_k(one, kSquare, t), ripley_k_plain(one, kSquare, t),
                             cross_k(one, {}, kSquare, t), pair_correlation(one, kSquare, t)})
    EXPECT_EQ(values, std::vector<double>(2, 0.0));
  EXPECT_TRUE(nearest_distances(one).empty());
  EXPECT_TRUE(ripley_k(one, kSquare, {}).empty());
}

TEST(Pattern, CoincidentPointsCountAtEveryDistance) {
  const std::vector<Vec2> twins{{5, 5}, {5, 5}};
  EXPECT_DOUBLE_EQ(ripley_k(twins, kSquare, std::vector<double>{0.1})[0], 100.0);
  EXPECT_EQ(nearest_distances(twins)[0], 0.0);
}

}  // namespace
}  // namespace bosquet::distribution
