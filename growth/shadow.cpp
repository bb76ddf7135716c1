#include "growth/shadow.h"

#include <algorithm>

namespace bosquet::growth {

void ShadowGrid::reset(const Box3& room, const Vec3& anchor, float cell_m, float strength, float falloff, int depth) {
  anchor_ = anchor, inverse_ = 1.0f / cell_m, depth_ = depth;
  for (const IVec3 c : changed_) waiting_[index(c)] = 0;  // of a tree that was given up: all others settled
  changed_.clear();
  amount_.fill(0);
  float amount = strength * kUnit;
  for (int q = 0; q <= depth; ++q, amount /= falloff) {
    amount_[static_cast<std::size_t>(q)] = static_cast<std::int32_t>(amount + 0.5f);
  }
  // Layers below the ground are not kept; to the sides there is room for the widest layer of a pyramid.
  const int side = depth + 1;
  const IVec3 low = IVec3(glm::floor((room.low - anchor) * inverse_));
  const IVec3 high = IVec3(glm::floor((room.high - anchor) * inverse_));
  first_ = {low.x - side, 0, low.z - side};
  cells_ = {high.x - low.x + 2 * side + 1, std::max(0, high.y) + 2, high.z - low.z + 2 * side + 1};
  const std::size_t cells =
      static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z);
  sum_.assign(cells + kPastPyramid, 0);
  waiting_.resize(std::max(waiting_.size(), cells));
  prepare();
}

void ShadowGrid::prepare() {
  const std::int32_t row = cells_.x, side = depth_ + 1;
  reader_ = {lanes(anchor_),
             all4(inverse_),
             Int4{first_.x, first_.y, first_.z, 0},
             Int4{cells_.x, cells_.y, cells_.z, 1},
             row,
             row * cells_.z,
             amount_[0],
             sum_.data()};
  inner_low_ = Int4{side, 0, side, 0};
  inner_end_ = reader_.cells - inner_low_;
}

void ShadowGrid::make_room(IVec3 c) {
  settle();
  ++layout_;
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
  first_ -= before;
  const std::size_t cells =
      static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(cells_.z);
  sum_.assign(cells + kPastPyramid, 0);
  waiting_.resize(std::max(waiting_.size(), cells));
  old_.reserve(sum_.capacity());  // the two change places each time
  const std::int32_t* from = old_.data();
  for (int j = 0; j < old_cells.y; ++j) {
    for (int k = 0; k < old_cells.z; ++k, from += old_cells.x) {
      std::copy(from, from + old_cells.x, sum_.data() + index({before.x, j + before.y, k + before.z}));
    }
  }
  prepare();
}

std::int32_t ShadowGrid::count(const Vec3& p, int change) {
  Int4 c = reader_.cell(p);
  if (!all((c >= inner_low_) & (c < inner_end_))) {
    make_room({c[0], c[1], c[2]});
    c = reader_.cell(p);
  }
  const std::int32_t place = reader_.number(c);
  std::int32_t& waiting = waiting_[static_cast<std::size_t>(place)];
  if (waiting == 0) changed_.push_back({c[0], c[1], c[2]});
  waiting += change;
  return place;
}

std::size_t ShadowGrid::settle() {
  std::size_t settled = 0;
  for (const IVec3 c : changed_) {
    // A cell may be listed again after it came back to 0: then the first entry takes all.
    std::int32_t& waiting = waiting_[index(c)];
    if (waiting == 0) continue;
    add(c, waiting);
    waiting = 0;
    ++settled;
  }
  changed_.clear();
  return settled;
}

void ShadowGrid::add(IVec3 c, int times) {
  const auto stride = static_cast<std::size_t>(cells_.x);
  const ShadowPyramid pyramid{std::min(depth_, c.y), stride, stride * static_cast<std::size_t>(cells_.z),
                              amount_.data()};
  add_pyramid(pyramid, sum_.data() + index(c), times);
}

}  // namespace bosquet::growth
