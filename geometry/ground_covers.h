// Ground covers: which cover lies where on a ground grid, and ground triangles cut along the lines between covers.
//
// Model     at a place each cover has a share (terrain::CoverShares, the rest natural); the largest one is seen. The line
//           between two covers crosses a triangle's edge where their shares are equal, found by halving. Edges of areas
//           are stored as ramps about a cell wide (terrain/mask.h), so a line at any angle follows the drawn one within
//           a tenth of a cell
// Holds     triangles that share an edge cut it at the same point, to the bit
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "geometry/ground_grid.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

/// Shares of all covers, together 1: what is not barred counts as natural; without areas what is barred is gravel.
terrain::CoverShares cover_shares(const terrain::Terrain& terrain, Vec2 plan);

/// Whether planting is barred anywhere; quick.
bool bars_anything(const terrain::Terrain& terrain);

/// What each cell of a grid shows: one cover all over, or several.
class CellCovers {
 public:
  static constexpr std::uint8_t kSeveral = 255;

  /// Looks at `fineness` x `fineness` places a cell and its edges.
  CellCovers(const terrain::Terrain& terrain, const GroundGrid& grid, int fineness);

  /// A terrain::Cover, or kSeveral.
  std::uint8_t of(int i, int j) const { return cells_[static_cast<std::size_t>(j * nx_ + i)]; }
  bool several(int i, int j) const { return i >= 0 && j >= 0 && i < nx_ && j < ny_ && of(i, j) == kSeveral; }
  std::size_t several_count() const { return several_; }

 private:
  int nx_, ny_;
  std::size_t several_ = 0;
  std::vector<std::uint8_t> cells_;
};

/// A corner of a triangle to be cut.
struct CoverPoint {
  Vec3 at{0.0f};
  terrain::CoverShares shares{};
  terrain::Cover cover = terrain::Cover::natural;

  CoverPoint() = default;
  CoverPoint(const Vec3& position, const terrain::CoverShares& found);
};

/// Where the line between the covers of two points crosses the edge between them.
Vec3 crossing(const terrain::Terrain& terrain, const CoverPoint& a, const CoverPoint& b);

/// Calls put(cover, a, b, c) with the triangles that a triangle is cut into, turning as it does.
template <class Put>
void cut_by_cover(const terrain::Terrain& terrain, const std::array<CoverPoint, 3>& p, const Put& put) {
  const auto quad = [&](terrain::Cover cover, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    put(cover, a, b, c), put(cover, a, c, d);
  };
  const bool same01 = p[0].cover == p[1].cover, same12 = p[1].cover == p[2].cover, same20 = p[2].cover == p[0].cover;
  if (same01 && same12) return put(p[0].cover, p[0].at, p[1].at, p[2].at);
  if (!same01 && !same12 && !same20) {
    const Vec3 m01 = crossing(terrain, p[0], p[1]), m12 = crossing(terrain, p[1], p[2]),
               m20 = crossing(terrain, p[2], p[0]);
    const Vec3 middle = (m01 + m12 + m20) * (1.0f / 3.0f);
    quad(p[0].cover, p[0].at, m01, middle, m20);
    quad(p[1].cover, p[1].at, m12, middle, m01);
    quad(p[2].cover, p[2].at, m20, middle, m12);
    return;
  }
  // Two alike, one alone.
  const std::size_t alone = same12 ? 0 : same20 ? 1 : 2;
  const CoverPoint &a = p[alone], &b = p[(alone + 1) % 3], &c = p[(alone + 2) % 3];
  const Vec3 mb = crossing(terrain, a, b), mc = crossing(terrain, a, c);
  put(a.cover, a.at, mb, mc);
  quad(b.cover, mb, b.at, c.at, mc);
}

}  // namespace bosquet::geometry
