#include "growth/occupancy.h"

#include <algorithm>
#include <array>
#include <bit>

namespace bosquet::growth {
namespace {

constexpr int kReach = 2;                ///< cells around the one asked that may hold a node within r
constexpr int kMargin = 4;               ///< cells around those asked, so that all eight blocks exist
constexpr int kWood = kMargin + kReach;  ///< wood keeps so far inside that outside the margin all is free

/// Bits of the cells around a cell in the two blocks along each axis that they lie in. Block (x, y, z) of the eight is
/// number y * 4 + z * 2 + x; the cell asked is cell 2 + u of the eight along each axis.
struct Window {
  std::array<std::uint64_t, 8> cells{};  ///< that may hold a node within r: those across a corner are a whole r away
  std::uint64_t own = 0;                 ///< bit of the cell itself, in block own_block
  std::size_t own_block = 0;
};
std::array<Window, 64> all_windows() {
  std::array<Window, 64> windows;
  for (int u = 0; u < 64; ++u) {
    Window& window = windows[static_cast<std::size_t>(u)];
    for (int y = -kReach; y <= kReach; ++y) {
      for (int z = -kReach; z <= kReach; ++z) {
        for (int x = -kReach; x <= kReach; ++x) {
          const int cx = (u & 3) + 2 + x, cy = (u >> 4) + 2 + y, cz = (u >> 2 & 3) + 2 + z;
          const auto block = static_cast<std::size_t>(cy / 4 * 4 + cz / 4 * 2 + cx / 4);
          const std::uint64_t bit = std::uint64_t{1} << ((cy & 3) << 4 | (cz & 3) << 2 | (cx & 3));
          const bool corner = std::min({std::abs(x), std::abs(y), std::abs(z)}) == kReach;
          if (!corner) window.cells[block] |= bit;
          if (x == 0 && y == 0 && z == 0) window.own_block = block, window.own = bit;
        }
      }
    }
  }
  return windows;
}
const std::array<Window, 64> kWindows = all_windows();

}  // namespace

void Occupancy::reset(const Box3& room, float radius_m) {
  radius_m_ = radius_m;
  cell_m_ = radius_m * 0.577f, inverse_ = 1.0f / cell_m_;
  next_.clear(), cell_of_.clear(), at_.clear();
  lay_out(room);
}

void Occupancy::lay_out(const Box3& room) {
  room_ = room;
  low_ = room.low - Vec3(cell_m_ * static_cast<float>(kWood + 1));
  blocks_ = (IVec3((room.high - room.low) * inverse_) + IVec3(2 * kWood + 3 + 3)) / 4;
  cells_ = blocks_ * 4;
  const std::size_t blocks = block({0, blocks_.y, 0});
  bits_.assign(blocks, 0);
  if (first_.size() < blocks * 64) first_.resize(blocks * 64);
}

void Occupancy::link(std::int32_t node, IVec3 c) {
  const auto n = static_cast<std::size_t>(node);
  const Place place = this->place(c);
  const std::uint64_t bit = std::uint64_t{1} << place.bit;
  Entry& entry = first_[place.entry()];
  next_[n] = bits_[place.block] & bit ? entry.node : -1;
  bits_[place.block] |= bit;
  entry = {at_[n], node};
  cell_of_[n] = static_cast<std::int64_t>(place.entry());
}

void Occupancy::add(std::int32_t node, const Vec3& p) {
  const auto n = static_cast<std::size_t>(node);
  if (n >= at_.size()) at_.resize(n + 1), next_.resize(n + 1, -1), cell_of_.resize(n + 1, -1);
  at_[n] = p;
  IVec3 c = cell(p);
  if (!inside(c, kWood)) {
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
      if (cell_of_[i] >= 0) link(static_cast<std::int32_t>(i), cell(at_[i]));
    }
    c = cell(p);
  }
  link(node, c);
}

void Occupancy::remove(std::int32_t node) {
  const auto n = static_cast<std::size_t>(node);
  const auto place = static_cast<std::size_t>(cell_of_[n]);
  Entry& entry = first_[place];
  if (entry.node != node) {
    std::int32_t* link = &next_[static_cast<std::size_t>(entry.node)];
    while (*link != node) link = &next_[static_cast<std::size_t>(*link)];
    *link = next_[n];
  } else if (next_[n] >= 0) {
    entry = {at_[static_cast<std::size_t>(next_[n])], next_[n]};
  } else {
    bits_[place / 64] &= ~(std::uint64_t{1} << place % 64);
  }
  cell_of_[n] = -1;
}

/// Is a node of these cells of the block nearer to p than r?
inline bool Occupancy::near(const Vec3& p, std::size_t block, std::uint64_t cells) const {
  const float r2 = radius_m_ * radius_m_;
  const Entry* entries = first_.data() + block * 64;
  for (; cells != 0; cells &= cells - 1) {
    const Entry& entry = entries[std::countr_zero(cells)];
    const Vec3 to = entry.at - p;
    if (glm::dot(to, to) < r2) return true;
    for (std::int32_t n = next_[static_cast<std::size_t>(entry.node)]; n >= 0; n = next_[static_cast<std::size_t>(n)]) {
      const Vec3 to_next = at_[static_cast<std::size_t>(n)] - p;
      if (glm::dot(to_next, to_next) < r2) return true;
    }
  }
  return false;
}

bool Occupancy::occupied(Float4 p) const {
  const Int4 at = whole((p - lanes(low_)) * all4(inverse_));
  const IVec3 c{at[0], at[1], at[2]};
  if (!inside(c, kMargin)) return false;  // wood is farther inside than r
  const IVec3 low = c - kReach;
  const Window& window = kWindows[static_cast<std::size_t>((low.y & 3) << 4 | (low.z & 3) << 2 | (low.x & 3))];
  const auto row = static_cast<std::size_t>(blocks_.x), layer = row * static_cast<std::size_t>(blocks_.z);
  const std::size_t first = block(low >> 2);
  const std::array<std::size_t, 8> blocks{
      first,         first + 1,         first + row,         first + row + 1,
      first + layer, first + layer + 1, first + layer + row, first + layer + row + 1};

  std::array<std::uint64_t, 8> cells;
  unsigned some = 0;  // bit i: block i holds wood that is near enough to be measured
  for (unsigned i = 0; i < 8; ++i) {
    cells[i] = bits_[blocks[i]] & window.cells[i];
    some |= static_cast<unsigned>(cells[i] != 0) << i;
  }
  if (cells[window.own_block] & window.own) return true;
  const Vec3 place = vec3(p);
  if (near(place, blocks[window.own_block], cells[window.own_block])) return true;
  for (some &= ~(1u << window.own_block); some != 0; some &= some - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(some));
    if (near(place, blocks[i], cells[i])) return true;
  }
  return false;
}

}  // namespace bosquet::growth
