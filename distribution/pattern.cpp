#include "distribution/pattern.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr double kPiD = std::numbers::pi;

double area(const Box2& window) { return static_cast<double>(window.size().x) * static_cast<double>(window.size().y); }

double distance(Vec2 a, Vec2 b) {
  const double x = static_cast<double>(a.x) - b.x, y = static_cast<double>(a.y) - b.y;
  return std::sqrt(x * x + y * y);
}

double largest(std::span<const double> t) { return t.empty() ? 0.0 : *std::max_element(t.begin(), t.end()); }

std::vector<std::size_t> by_east(std::span<const Vec2> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : a < b;
  });
  return order;
}

// Calls visit(i, j, distance) for each ordered pair of a point of `a` and one of `b` nearer than `reach`.
template <class Visit>
void visit_pairs(std::span<const Vec2> a, std::span<const Vec2> b, double reach, const Visit& visit) {
  const std::vector<std::size_t> order = by_east(b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    auto it = std::lower_bound(order.begin(), order.end(), a[i].x - reach,
                               [&](std::size_t j, double east) { return b[j].x < east; });
    for (; it != order.end() && b[*it].x <= a[i].x + reach; ++it) {
      const double d = distance(a[i], b[*it]);
      if (d < reach) visit(i, *it, d);
    }
  }
}

// Sums of pair weights below each t, from weights laid into the first t above the pair's distance.
class Cumulative {
 public:
  explicit Cumulative(std::span<const double> t) : t_(t), order_(t.size()), sums_(t.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t x, std::size_t y) { return t[x] < t[y]; });
  }
  void add(double d, double weight) {
    const auto it =
        std::upper_bound(order_.begin(), order_.end(), d, [&](double x, std::size_t n) { return x < t_[n]; });
    if (it != order_.end()) sums_[static_cast<std::size_t>(it - order_.begin())] += weight;
  }
  std::vector<double> times(double factor) const {
    std::vector<double> out(t_.size());
    double sum = 0.0;
    for (std::size_t n = 0; n < order_.size(); ++n) out[order_[n]] = (sum += sums_[n]) * factor;
    return out;
  }

 private:
  std::span<const double> t_;
  std::vector<std::size_t> order_;
  std::vector<double> sums_;
};

}  // namespace

double share_inside(Vec2 centre, double radius, const Box2& window) {
  if (!(radius > 0.0)) return 1.0;
  const double west = centre.x - static_cast<double>(window.low.x),
               east = window.high.x - static_cast<double>(centre.x);
  const double south = centre.y - static_cast<double>(window.low.y);
  const double north = window.high.y - static_cast<double>(centre.y);
  // In each quarter the circle leaves across one side, across both, or (round the corner) wholly.
  const auto angle_beyond = [&](double side) {
    return radius > side ? static_cast<double>(acos(static_cast<float>(side / radius))) : 0.0;
  };
  double outside = 0.0;
  for (const double x : {west, east})
    for (const double y : {south, north}) outside += std::min(angle_beyond(x) + angle_beyond(y), 0.5 * kPiD);
  return 1.0 - outside / (2.0 * kPiD);
}

std::vector<double> ripley_k_plain(std::span<const Vec2> points, const Box2& window, std::span<const double> t) {
  Cumulative pairs(t);
  const auto n = static_cast<double>(points.size());
  if (points.size() < 2) return pairs.times(0.0);
  visit_pairs(points, points, largest(t), [&](std::size_t i, std::size_t j, double d) {
    if (i != j) pairs.add(d, 1.0);
  });
  return pairs.times(area(window) / (n * n));
}

std::vector<double> ripley_k(std::span<const Vec2> points, const Box2& window, std::span<const double> t) {
  Cumulative pairs(t);
  const auto n = static_cast<double>(points.size());
  if (points.size() < 2) return pairs.times(0.0);
  visit_pairs(points, points, largest(t), [&](std::size_t i, std::size_t j, double d) {
    if (i != j) pairs.add(d, 1.0 / share_inside(points[i], d, window));
  });
  return pairs.times(area(window) / (n * (n - 1.0)));
}

std::vector<double> cross_k(std::span<const Vec2> a, std::span<const Vec2> b, const Box2& window,
                            std::span<const double> t) {
  Cumulative pairs(t);
  if (a.empty() || b.empty()) return pairs.times(0.0);
  visit_pairs(a, b, largest(t),
              [&](std::size_t i, std::size_t, double d) { pairs.add(d, 1.0 / share_inside(a[i], d, window)); });
  return pairs.times(area(window) / (static_cast<double>(a.size()) * static_cast<double>(b.size())));
}

std::vector<double> ripley_l(std::span<const double> k) {
  std::vector<double> l(k.size());
  for (std::size_t n = 0; n < k.size(); ++n) l[n] = std::sqrt(k[n] / kPiD);
  return l;
}

std::vector<double> pair_correlation(std::span<const Vec2> points, const Box2& window, std::span<const double> t) {
  std::vector<double> g(t.size(), 0.0);
  if (points.size() < 2) return g;
  constexpr double kStoyan = 0.15;
  const auto n = static_cast<double>(points.size());
  const double half_width = kStoyan / std::sqrt(n / area(window));
  visit_pairs(points, points, largest(t) + half_width, [&](std::size_t i, std::size_t j, double d) {
    if (i == j || !(d > 0.0)) return;
    const double weight = 1.0 / (2.0 * kPiD * d * share_inside(points[i], d, window));
    for (std::size_t m = 0; m < t.size(); ++m) {
      const double x = (t[m] - d) / half_width;
      if (x > -1.0 && x < 1.0) g[m] += 0.75 * (1.0 - x * x) / half_width * weight;
    }
  });
  for (double& value : g) value *= area(window) / (n * (n - 1.0));
  return g;
}

std::vector<double> nearest_distances(std::span<const Vec2> points) {
  if (points.size() < 2) return {};
  std::vector<double> nearest(points.size());
  const std::vector<std::size_t> order = by_east(points);
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Vec2 p = points[order[n]];
    double least = std::numeric_limits<double>::max();
    // Outward to both sides until the eastward distance alone is too large.
    for (std::size_t m = n + 1; m < order.size() && points[order[m]].x - static_cast<double>(p.x) < least; ++m)
      least = std::min(least, distance(p, points[order[m]]));
    for (std::size_t m = n; m-- > 0 && static_cast<double>(p.x) - points[order[m]].x < least;)
      least = std::min(least, distance(p, points[order[m]]));
    nearest[order[n]] = least;
  }
  return nearest;
}

}  // namespace bosquet::distribution
