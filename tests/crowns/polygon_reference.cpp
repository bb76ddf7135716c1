#include "polygon_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace bosquet::crowns {
namespace {

constexpr double kFrontStep = 0.5, kSplit = 0.75, kPatience = 20.0;  // cells

struct Point {
  DVec2 at{0.0};
  bool halted = false;
};

class Division {
 public:
  Division(const std::vector<PolygonTree>& trees, std::int32_t side)
      : trees_(trees), side_(side), owner_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), -1) {
    for (const PolygonTree& t : trees_) fastest_ = std::max(fastest_, t.speed);
    for (std::size_t t = 0; t < trees_.size(); ++t) outlines_.push_back(trunk(t));
  }

  std::vector<std::int32_t> run() {
    std::size_t left = owner_.size() - claimed_;
    for (int idle = 0; left > 0 && idle * kFrontStep < kPatience; ++idle) {
      for (std::size_t t = 0; t < trees_.size(); ++t) advance(t);
      if (owner_.size() - claimed_ < left) idle = 0;
      left = owner_.size() - claimed_;
    }
    return owner_;
  }

 private:
  // The discretized circle under the tree, and the points around it.
  std::vector<Point> trunk(std::size_t t) {
    const PolygonTree& tree = trees_[t];
    for (std::int32_t j = 0; j < side_; ++j)
      for (std::int32_t i = 0; i < side_; ++i) {
        const DVec2 d = DVec2(i + 0.5, j + 0.5) - tree.base;
        if (d.x * d.x + d.y * d.y <= tree.radius * tree.radius) claim({i + 0.5, j + 0.5}, t);
      }
    claim(tree.base, t);
    const int count = std::max(8, static_cast<int>(2.0 * std::numbers::pi * tree.radius / (0.5 * kSplit)));
    std::vector<Point> points;
    for (int n = 0; n < count; ++n) {
      const double a = 2.0 * std::numbers::pi * n / count;
      points.push_back({tree.base + tree.radius * DVec2(std::cos(a), std::sin(a))});
    }
    return points;
  }

  std::int32_t* cell(DVec2 p) {
    if (!(p.x >= 0 && p.y >= 0 && p.x < side_ && p.y < side_)) return nullptr;
    return &owner_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(p.x)];
  }
  void claim(DVec2 p, std::size_t t) {
    if (std::int32_t* c = cell(p); c && *c < 0) *c = static_cast<std::int32_t>(t), ++claimed_;
  }

  void advance(std::size_t t) {
    std::vector<Point>& points = outlines_[t];
    const double step = kFrontStep * trees_[t].speed / fastest_;

    // Grow: outward is to the right of the counter-clockwise way from one neighbour to the other.
    const std::vector<Point> old = points;
    for (std::size_t n = 0; n < old.size(); ++n) {
      if (old[n].halted) continue;
      const DVec2 across = old[(n + 1) % old.size()].at - old[(n + old.size() - 1) % old.size()].at;
      const double length = std::sqrt(across.x * across.x + across.y * across.y);
      if (length > 0) points[n].at += step / length * DVec2(across.y, -across.x);
      claim(points[n].at, t);
      const std::int32_t* c = cell(points[n].at);
      points[n].halted = !c || *c != static_cast<std::int32_t>(t);
    }

    // Split.
    std::vector<Point> split;
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Point &a = points[n], &b = points[(n + 1) % points.size()];
      split.push_back(a);
      const DVec2 d = b.at - a.at;
      if (d.x * d.x + d.y * d.y > kSplit * kSplit && !(a.halted && b.halted)) split.push_back({0.5 * (a.at + b.at)});
    }
    points = std::move(split);
  }

  const std::vector<PolygonTree>& trees_;
  std::int32_t side_;
  std::vector<std::int32_t> owner_;
  std::vector<std::vector<Point>> outlines_;
  std::size_t claimed_ = 0;
  double fastest_ = 0;
};

}  // namespace

std::vector<std::int32_t> polygon_division(const std::vector<PolygonTree>& trees, std::int32_t side) {
  return Division(trees, side).run();
}

}  // namespace bosquet::crowns
