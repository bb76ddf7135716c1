#include "growth/occupancy.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace bosquet::growth {
namespace {

constexpr std::size_t kPairsAtOnce = 4;

using Byte16 = std::uint8_t __attribute__((vector_size(16)));

/// Which of so many voxels from `origin` on an interval touches.
VoxelRange touched(float low, float high, float origin, float edge, int count) {
  const float from = std::floor((low - origin) / edge), to = std::floor((high - origin) / edge);
  return {static_cast<int>(std::clamp(from, 0.0f, static_cast<float>(count))),
          static_cast<int>(std::clamp(to, -1.0f, static_cast<float>(count - 1)))};
}

/// Sums that end at 255.
inline Byte16 up_to_closed(Byte16 cells, Byte16 counted) {
  static_assert(Occupancy::kClosed == 255);
#ifdef __SSE2__
  using Char16 = char __attribute__((vector_size(16)));
  return reinterpret_cast<Byte16>(
      __builtin_ia32_paddusb128(reinterpret_cast<Char16>(cells), reinterpret_cast<Char16>(counted)));
#else
  return cells + (counted & reinterpret_cast<Byte16>(cells != Occupancy::kClosed));
#endif
}

/// One more or one less in the cells of each pair of rows; closed ones stay so.
template <int kChange>
void count_rows(std::uint8_t* at, const OccupiedRows* pair, const RowOffsets* offsets, std::size_t pairs) {
  for (std::size_t n = 0; n < pairs; n += kPairsAtOnce) {
#pragma GCC unroll 4
    for (std::size_t m = n; m < n + kPairsAtOnce; ++m) {
      std::uint8_t *const first = at + offsets[m][0], *const second = at + offsets[m][1];
      std::array<std::uint64_t, 2> words;
      std::memcpy(&words[0], first, 8), std::memcpy(&words[1], second, 8);
      Byte16 cells, counted;
      std::memcpy(&cells, &words, 16), std::memcpy(&counted, &pair[m], 16);
      if constexpr (kChange > 0) {
        cells = up_to_closed(cells, counted);
      } else {
        cells -= counted & reinterpret_cast<Byte16>(cells != Occupancy::kClosed);
      }
      std::memcpy(&words, &cells, 16);
      std::memcpy(first, &words[0], 8), std::memcpy(second, &words[1], 8);
    }
  }
}

}  // namespace

void Occupancy::reset(const Box3& room, float radius_m, float reach_m, const crowns::CrownRegion* region, float lid_m,
                      float least_cell_m) {
  const float cell_m = std::max(radius_m * kCell, least_cell_m);
  if (radius_m != radius_m_ || cell_m != cell_m_) {
    radius_m_ = radius_m, cell_m_ = cell_m;
    make_spheres();
  }
  inverse_ = 1.0f / cell_m_;
  region_ = region, lid_m_ = lid_m;
  margin_ = std::max(kBefore, static_cast<int>(reach_m * inverse_) + 2);
  const IVec3 low = IVec3(glm::floor(room.low * inverse_)), high = IVec3(glm::floor(room.high * inverse_));
  lay_out(low - margin_ - 2 + static_cast<int>(kOrigin), high - low + 2 * margin_ + 5);
  close();
}

void Occupancy::make_spheres() {
  for (std::size_t eighth = 0; eighth < 8; ++eighth) {
    const auto from = [&](std::size_t axis) { return eighth >> axis & 1 ? 0.25f : -0.25f; };
    Sphere& sphere = spheres_[eighth];
    sphere.pairs.clear(), sphere.at.clear();
    const auto add_row = [&](const std::array<std::uint8_t, kRow>& cells, IVec2 at) {
      if (sphere.at.size() % 2 == 0) sphere.pairs.push_back({});
      std::copy(cells.begin(), cells.end(), sphere.pairs.back().cells.begin() + sphere.at.size() % 2 * kRow);
      sphere.at.push_back(at);
    };
    for (int j = -kBefore; j <= kBefore; ++j) {
      for (int k = -kBefore; k <= kBefore; ++k) {
        std::array<std::uint8_t, kRow> row{};
        bool some = false;
        for (int i = -kBefore; i <= kBefore; ++i) {
          const Vec3 to = (Vec3(i, j, k) - Vec3{from(0), from(1), from(2)}) * cell_m_;
          const bool within = (i == 0 && j == 0 && k == 0) || glm::dot(to, to) < radius_m_ * radius_m_;
          row[static_cast<std::size_t>(i + kBefore)] = within;
          some = some || within;
        }
        if (some) add_row(row, {j, k});
      }
    }
    // Empty rows make the pairs up to a whole number; they stand apart from the last row, with which one may be paired.
    while (sphere.at.size() % (2 * kPairsAtOnce) != 0) add_row({}, {0, 0});
  }
}

void Occupancy::lay_out(IVec3 first, IVec3 cells) {
  first_ = first, cells_ = cells;
  for (Sphere& sphere : spheres_) {
    sphere.offsets.clear();
    const auto offset = [&](IVec2 at) {
      return (static_cast<std::ptrdiff_t>(at.x) * cells.z + at.y) * cells.x - kBefore;
    };
    for (std::size_t n = 0; n < sphere.at.size(); n += 2) {
      sphere.offsets.push_back({offset(sphere.at[n]), offset(sphere.at[n + 1])});
    }
  }
}

void Occupancy::close() {
  const std::size_t layer = static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.z);
  const auto width = static_cast<std::size_t>(cells_.x);
  const std::size_t all = layer * static_cast<std::size_t>(cells_.y) + kRow;
  if (taken_.size() < all) taken_.resize(all);
  const auto at = [&](int cell, int axis) {
    return static_cast<float>(cell + first_[axis] - static_cast<int>(kOrigin)) * cell_m_;
  };
  const int ground = std::clamp(static_cast<int>(kOrigin) - first_.y, 0, cells_.y);
  std::fill_n(taken_.begin(), layer * static_cast<std::size_t>(ground), kClosed);
  const auto above = taken_.begin() + static_cast<std::ptrdiff_t>(layer * static_cast<std::size_t>(ground));
  if (!region_) {
    std::fill(above, taken_.begin() + static_cast<std::ptrdiff_t>(all), std::uint8_t{0});
    return;
  }
  const crowns::CrownRegion& r = *region_;
  const auto columns = [&](int i) { return touched(at(i, 0), at(i + 1, 0), r.low.x, r.voxel_m, r.cells.x); };
  const auto layers = [&](int j) {
    return touched(std::min(at(j, 1), lid_m_), std::min(at(j + 1, 1), lid_m_), r.low.y, r.layer_m, r.cells.y);
  };
  const auto rows = [&](int k) { return touched(at(k, 2), at(k + 1, 2), r.low.z, r.voxel_m, r.cells.z); };

  // Each row of voxels becomes a row of cells once; cells that touch several take what is closed in all of them.
  columns_.assign(static_cast<std::size_t>(r.cells.x), {cells_.x, -1});
  for (int i = 0; i < cells_.x; ++i) {
    const VoxelRange x = columns(i);
    for (int a = x.first; a <= x.last; ++a) {
      VoxelRange& cells = columns_[static_cast<std::size_t>(a)];
      cells.first = std::min(cells.first, i), cells.last = i;
    }
  }
  rows_.assign(width * static_cast<std::size_t>(r.cells.y) * static_cast<std::size_t>(r.cells.z), kClosed);
  for (int b = 0; b < r.cells.y; ++b) {
    for (int c = 0; c < r.cells.z; ++c) {
      const std::size_t first = r.index({0, b, c});
      std::uint8_t* row = rows_.data() + width * (static_cast<std::size_t>(b) * static_cast<std::size_t>(r.cells.z) +
                                                  static_cast<std::size_t>(c));
      for (std::size_t a = 0; a < columns_.size(); ++a) {
        if (r.bits[(first + a) >> 6] >> ((first + a) & 63) & 1u) {
          for (int i = columns_[a].first; i <= columns_[a].last; ++i) row[i] = 0;
        }
      }
    }
  }
  VoxelRange y_before{0, -2};
  for (int j = ground; j < cells_.y; ++j) {
    std::uint8_t* to = taken_.data() + static_cast<std::size_t>(j) * layer;
    const VoxelRange y = layers(j);
    if (y == y_before) {
      std::memcpy(to, to - layer, layer);
      continue;
    }
    y_before = y;
    VoxelRange z_before{0, -2};
    for (int k = 0; k < cells_.z; ++k, to += width) {
      const VoxelRange z = rows(k);
      if (z == z_before) {
        std::memcpy(to, to - width, width);
        continue;
      }
      z_before = z;
      std::memset(to, kClosed, width);
      for (int b = y.first; b <= y.last; ++b) {
        for (int c = z.first; c <= z.last; ++c) {
          const std::uint8_t* row =
              rows_.data() +
              width * (static_cast<std::size_t>(b) * static_cast<std::size_t>(r.cells.z) + static_cast<std::size_t>(c));
          for (std::size_t i = 0; i < width; ++i) to[i] &= row[i];
        }
      }
    }
  }
}

void Occupancy::make_room(IVec3 c) {
  const IVec3 old_first = first_, old_cells = cells_;
  IVec3 first = first_, end = first_ + cells_;
  for (int axis = 0; axis < 3; ++axis) {
    const int more = cells_[axis] / 4;
    if (c[axis] - margin_ < first[axis]) first[axis] = c[axis] - margin_ - more;
    if (c[axis] + margin_ >= end[axis]) end[axis] = c[axis] + margin_ + 1 + more;
  }
  old_.swap(taken_);
  lay_out(first, end - first);
  close();
  old_.reserve(taken_.capacity());  // the two change places each time
  const IVec3 moved = old_first - first;
  const auto width = static_cast<std::size_t>(old_cells.x);
  const std::uint8_t* from = old_.data();
  for (int j = 0; j < old_cells.y; ++j) {
    for (int k = 0; k < old_cells.z; ++k, from += width) {
      std::memcpy(taken_.data() + index(IVec3{0, j, k} + moved), from, width);
    }
  }
}

void Occupancy::change(IVec3 half_cell, bool more) {
  const IVec3 c = half_cell >> 1;
  const IVec3 low = c - first_ - margin_, high = first_ + cells_ - margin_ - 1 - c;
  if (std::min({low.x, low.y, low.z, high.x, high.y, high.z}) < 0) make_room(c);
  const std::size_t eighth =
      static_cast<std::size_t>((half_cell.x & 1) | (half_cell.y & 1) << 1 | (half_cell.z & 1) << 2);
  const Sphere& sphere = spheres_[eighth];
  std::uint8_t* const at = taken_.data() + index(c - first_);
  (more ? count_rows<1> : count_rows<-1>)(at, sphere.pairs.data(), sphere.offsets.data(), sphere.pairs.size());
}

void Occupancy::move(const Vec3& from, const Vec3& to) {
  const IVec3 before = half_cell(from), after = half_cell(to);
  if (before == after) return;
  change(before, false), change(after, true);
}

bool Occupancy::occupied(const Vec3& p) const {
  const Vec3 q = p * inverse_ + kOrigin;
  const Vec3 low = Vec3(first_), high = Vec3(first_ + cells_);
  if (!(q.x >= low.x && q.y >= low.y && q.z >= low.z && q.x < high.x && q.y < high.y && q.z < high.z)) return false;
  return taken_[index(IVec3(q) - first_)] != 0;
}

}  // namespace bosquet::growth
