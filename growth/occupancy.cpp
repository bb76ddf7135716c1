#include "growth/occupancy.h"

#include <algorithm>
#include <array>

namespace bosquet::growth {
namespace {

constexpr int kMargin = 2;  ///< cells around the one asked that may hold a node within r

/// Offsets of those cells, nearest first; the cells across a corner are a whole r away.
struct Offset {
  IVec3 by;
  int gap2;
};
std::vector<Offset> offsets_by_distance() {
  std::vector<Offset> found;
  for (int y = -2; y <= 2; ++y) {
    for (int z = -2; z <= 2; ++z) {
      for (int x = -2; x <= 2; ++x) {
        const IVec3 gap{std::max(0, std::abs(x) - 1), std::max(0, std::abs(y) - 1), std::max(0, std::abs(z) - 1)};
        const int gap2 = gap.x + gap.y + gap.z;
        if (gap2 < 3 && (x || y || z)) found.push_back({{x, y, z}, x * x + y * y + z * z});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Offset& a, const Offset& b) { return a.gap2 < b.gap2; });
  return found;
}

}  // namespace

void Occupancy::reset(const Box3& room, float radius_m) {
  radius_m_ = radius_m;
  cell_m_ = radius_m * 0.577f, inverse_ = 1.0f / cell_m_;
  next_.clear(), cell_of_.clear(), at_.clear();
  lay_out(room);
}

void Occupancy::lay_out(const Box3& room) {
  room_ = room;
  low_ = room.low - Vec3(cell_m_ * (kMargin + 1));
  cells_ = IVec3((room.high - room.low) * inverse_) + IVec3(2 * kMargin + 3);
  first_.assign(
      static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z), -1);
  static const std::vector<Offset> offsets = offsets_by_distance();
  near_.clear();
  for (const Offset& o : offsets) near_.push_back(index(o.by));
}

void Occupancy::link(std::int32_t node, std::int32_t cell) {
  const auto n = static_cast<std::size_t>(node), c = static_cast<std::size_t>(cell);
  cell_of_[n] = cell;
  next_[n] = first_[c];
  first_[c] = node;
}

void Occupancy::add(std::int32_t node, const Vec3& p) {
  const auto n = static_cast<std::size_t>(node);
  if (n >= at_.size()) at_.resize(n + 1), next_.resize(n + 1, -1), cell_of_.resize(n + 1, -1);
  at_[n] = p;
  IVec3 c = cell(p);
  if (!inside(c, kMargin)) {
    // Make room and bring every node to its new cell.
    Box3 wider = room_;
    const Vec3 more = (room_.high - room_.low) * 0.25f;
    if (p.x < wider.low.x) wider.low.x = p.x - more.x;
    if (p.y < wider.low.y) wider.low.y = p.y - more.y;
    if (p.z < wider.low.z) wider.low.z = p.z - more.z;
    if (p.x > wider.high.x) wider.high.x = p.x + more.x;
    if (p.y > wider.high.y) wider.high.y = p.y + more.y;
    if (p.z > wider.high.z) wider.high.z = p.z + more.z;
    lay_out(wider);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (cell_of_[i] >= 0) link(static_cast<std::int32_t>(i), index(cell(at_[i])));
    }
    c = cell(p);
  }
  link(node, index(c));
}

void Occupancy::remove(std::int32_t node) {
  const auto n = static_cast<std::size_t>(node);
  std::int32_t* link = &first_[static_cast<std::size_t>(cell_of_[n])];
  while (*link != node) link = &next_[static_cast<std::size_t>(*link)];
  *link = next_[n];
  cell_of_[n] = -1;
}

bool Occupancy::occupied(const Vec3& p) const {
  const IVec3 c = cell(p);
  if (!inside(c, kMargin)) {
    // Outside the grid's inner part there is wood at most in the margin: look at the cells that exist.
    const float r2 = radius_m_ * radius_m_;
    for (int y = std::max(0, c.y - 2); y <= std::min(cells_.y - 1, c.y + 2); ++y) {
      for (int z = std::max(0, c.z - 2); z <= std::min(cells_.z - 1, c.z + 2); ++z) {
        for (int x = std::max(0, c.x - 2); x <= std::min(cells_.x - 1, c.x + 2); ++x) {
          for (std::int32_t n = first_[static_cast<std::size_t>(index({x, y, z}))]; n >= 0;
               n = next_[static_cast<std::size_t>(n)]) {
            const Vec3 to = at_[static_cast<std::size_t>(n)] - p;
            if (glm::dot(to, to) < r2) return true;
          }
        }
      }
    }
    return false;
  }
  const std::int32_t* own = first_.data() + index(c);
  if (*own >= 0) return true;
  const float r2 = radius_m_ * radius_m_;
  for (const std::int32_t offset : near_) {
    for (std::int32_t n = own[offset]; n >= 0; n = next_[static_cast<std::size_t>(n)]) {
      const Vec3 to = at_[static_cast<std::size_t>(n)] - p;
      if (glm::dot(to, to) < r2) return true;
    }
  }
  return false;
}

}  // namespace bosquet::growth
