#include "growth/shadow.h"

#include <algorithm>
#include <cmath>

namespace bosquet::growth {

void ShadowGrid::reset(const Box3& room, float cell_m, float strength, float falloff, int depth) {
  cell_m_ = cell_m, inverse_ = 1.0f / cell_m, depth_ = depth;
  amount_.fill(0);
  float amount = strength * kUnit;
  for (int q = 0; q <= depth; ++q, amount /= falloff) {
    amount_[static_cast<std::size_t>(q)] = static_cast<std::int32_t>(amount + 0.5f);
  }
  // Layers below the ground are not kept; to the sides there is room for the widest layer of a pyramid.
  const float margin = cell_m * static_cast<float>(depth + 1);
  low_ = {room.low.x - margin, room.low.y, room.low.z - margin};
  const Vec3 size = room.high - low_;
  cells_ = {static_cast<int>((size.x + margin) * inverse_) + 1, static_cast<int>(size.y * inverse_) + 2,
            static_cast<int>((size.z + margin) * inverse_) + 1};
  sum_.assign(
      static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z), 0);
}

void ShadowGrid::make_room(IVec3 c) {
  // A quarter more on every side that is too small.
  const int side = depth_ + 1;
  IVec3 before{0}, after{0};
  if (c.x < side) before.x = side - c.x + cells_.x / 4;
  if (c.z < side) before.z = side - c.z + cells_.z / 4;
  if (c.y < 0) before.y = -c.y + 2;
  if (c.x >= cells_.x - side) after.x = c.x - (cells_.x - side) + 1 + cells_.x / 4;
  if (c.z >= cells_.z - side) after.z = c.z - (cells_.z - side) + 1 + cells_.z / 4;
  if (c.y >= cells_.y) after.y = c.y - cells_.y + 1 + cells_.y / 4;

  old_.swap(sum_);
  const IVec3 old_cells = cells_;
  cells_ += before + after;
  low_ -= Vec3(before) * cell_m_;
  sum_.assign(
      static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z), 0);
  const std::int32_t* from = old_.data();
  for (int j = 0; j < old_cells.y; ++j) {
    for (int k = 0; k < old_cells.z; ++k, from += old_cells.x) {
      std::copy(from, from + old_cells.x, sum_.data() + index({before.x, j + before.y, k + before.z}));
    }
  }
}

void ShadowGrid::add(const Vec3& p, int sign) {
  IVec3 c = cell(p);
  const int side = depth_ + 1;
  if (c.x < side || c.z < side || c.y < 0 || c.x >= cells_.x - side || c.z >= cells_.z - side || c.y >= cells_.y) {
    make_room(c);
    c = cell(p);
  }
  for (int q = 0; q <= depth_ && c.y - q >= 0; ++q) {
    const std::int32_t amount = sign * amount_[static_cast<std::size_t>(q)];
    for (int k = c.z - q; k <= c.z + q; ++k) {
      std::int32_t* row = sum_.data() + index({c.x - q, c.y - q, k});
      for (int i = 0; i <= 2 * q; ++i) row[i] += amount;
    }
  }
}

}  // namespace bosquet::growth
