#include "exchange/plan_contours.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace bosquet::exchange {
namespace {

/// Directed pieces of contour between grid edges, above the level on their left.
class Tracer {
 public:
  /// With a border, the outermost samples are repeated at their own places with a value below the level.
  Tracer(const SampleGrid& grid, float level, bool border) : grid_(grid), level_(level), border_(border ? 1 : 0) {
    width_ = grid.size.x + 2 * border_;
    for (int j = 0; j + 1 < grid.size.y + 2 * border_; ++j)
      for (int i = 0; i + 1 < width_; ++i) cell(i, j);
  }

  std::vector<std::vector<DVec2>> lines() const {
    std::vector<std::vector<DVec2>> all;
    std::unordered_map<std::uint64_t, bool> used;
    const auto follow = [&](std::uint64_t start) {
      std::vector<DVec2> line{point(start)};
      std::uint64_t edge = start;
      for (auto step = next_.find(edge); step != next_.end() && !used[edge]; step = next_.find(edge)) {
        used[edge] = true;
        edge = step->second;
        line.push_back(point(edge));
      }
      all.push_back(std::move(line));
    };
    for (const std::uint64_t start : order_)
      if (!entered_.count(start)) follow(start);  // lines that begin at the grid's edge
    for (const std::uint64_t start : order_)
      if (!used[start]) follow(start);
    return all;
  }

 private:
  float value(int i, int j) const {
    const int x = i - border_, y = j - border_;
    const bool outside = x < 0 || y < 0 || x >= grid_.size.x || y >= grid_.size.y;
    return outside ? level_ - 1.0f : grid_.at(x, y);
  }
  DVec2 place(int i, int j) const {
    const int x = std::clamp(i - border_, 0, grid_.size.x - 1), y = std::clamp(j - border_, 0, grid_.size.y - 1);
    return grid_.low + grid_.step_m * DVec2(x, y);
  }
  // Edge 0 of sample (i, j) leads east from it, edge 1 north.
  std::uint64_t edge(int i, int j, int north) const {
    return 2 * (static_cast<std::uint64_t>(j) * static_cast<std::uint64_t>(width_) + static_cast<std::uint64_t>(i)) +
           static_cast<std::uint64_t>(north);
  }
  DVec2 point(std::uint64_t e) const {
    const bool north = e & 1;
    const int i = static_cast<int>(e / 2 % static_cast<std::uint64_t>(width_));
    const int j = static_cast<int>(e / 2 / static_cast<std::uint64_t>(width_));
    const int i2 = north ? i : i + 1, j2 = north ? j + 1 : j;
    const float a = value(i, j), b = value(i2, j2);
    const double share = static_cast<double>((level_ - a) / (b - a));
    return glm::mix(place(i, j), place(i2, j2), std::clamp(share, 0.0, 1.0));
  }
  void piece(std::uint64_t from, std::uint64_t to) {
    next_.emplace(from, to);
    entered_.emplace(to, true);
    order_.push_back(from);
  }
  void cell(int i, int j) {
    const float sw = value(i, j), se = value(i + 1, j), ne = value(i + 1, j + 1), nw = value(i, j + 1);
    const int above = (sw > level_) | (se > level_) << 1 | (ne > level_) << 2 | (nw > level_) << 3;
    if (above == 0 || above == 15) return;
    const std::uint64_t s = edge(i, j, 0), e = edge(i + 1, j, 1), n = edge(i, j + 1, 0), w = edge(i, j, 1);
    const bool middle = 0.25f * (sw + se + ne + nw) > level_;
    switch (above) {  // above on the left of each piece
      case 1:
        return piece(s, w);
      case 2:
        return piece(e, s);
      case 3:
        return piece(e, w);
      case 4:
        return piece(n, e);
      case 5:
        return middle ? (piece(s, e), piece(n, w)) : (piece(s, w), piece(n, e));
      case 6:
        return piece(n, s);
      case 7:
        return piece(n, w);
      case 8:
        return piece(w, n);
      case 9:
        return piece(s, n);
      case 10:
        return middle ? (piece(w, s), piece(e, n)) : (piece(e, s), piece(w, n));
      case 11:
        return piece(e, n);
      case 12:
        return piece(w, e);
      case 13:
        return piece(s, e);
      default:
        return piece(w, s);
    }
  }

  const SampleGrid& grid_;
  float level_;
  int border_, width_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> next_;
  std::unordered_map<std::uint64_t, bool> entered_;
  std::vector<std::uint64_t> order_;
};

double distance2_to_piece(DVec2 p, DVec2 a, DVec2 b) {
  const DVec2 piece = b - a;
  const double length2 = glm::dot(piece, piece);
  const double along = length2 > 0 ? std::clamp(glm::dot(p - a, piece) / length2, 0.0, 1.0) : 0.0;
  const DVec2 off = p - (a + along * piece);
  return glm::dot(off, off);
}

std::vector<std::vector<DVec2>> traced(const SampleGrid& grid, float level, bool border, double tolerance_m) {
  if (grid.size.x < 2 || grid.size.y < 2) return {};
  std::vector<std::vector<DVec2>> lines = Tracer(grid, level, border).lines();
  for (auto& line : lines) line = simplified(line, tolerance_m);
  std::erase_if(lines, [&](const auto& line) { return line.size() < (border ? 4u : 2u); });
  if (border)
    for (auto& ring : lines) ring.pop_back();
  return lines;
}

}  // namespace

std::vector<DVec2> simplified(const std::vector<DVec2>& line, double tolerance_m) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance_m * tolerance_m;
    std::size_t at = 0;
    for (std::size_t i = first + 1; i < last; ++i)
      if (const double d = distance2_to_piece(line[i], line[first], line[last]); d > farthest) farthest = d, at = i;
    if (at == 0) continue;
    kept[at] = true;
    open.emplace_back(first, at), open.emplace_back(at, last);
  }
  std::vector<DVec2> rest;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (kept[i]) rest.push_back(line[i]);
  return rest;
}

std::vector<std::vector<DVec2>> rings_above(const SampleGrid& grid, float level, double tolerance_m) {
  return traced(grid, level, true, tolerance_m);
}

std::vector<std::vector<DVec2>> lines_at(const SampleGrid& grid, float level, double tolerance_m) {
  return traced(grid, level, false, tolerance_m);
}

}  // namespace bosquet::exchange
