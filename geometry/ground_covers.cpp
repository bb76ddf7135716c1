#include "geometry/ground_covers.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"

namespace bosquet::geometry {
namespace {

using terrain::Cover;
using terrain::TiledGrid;

// A line keeps so far off a triangle's corners, as a share of the edge: else it would make triangles without area.
constexpr float kOffCorner = 0.02f;
constexpr int kHalvings = 4;  // of an edge until shares are linear on what is left

std::size_t index(Cover cover) { return static_cast<std::size_t>(cover); }

Cover largest(const terrain::CoverShares& shares) {
  return static_cast<Cover>(std::max_element(shares.begin(), shares.end()) - shares.begin());  // ties: the first
}

/// Which tiles of the mask bar anything, in the mask's own order.
std::vector<std::uint8_t> barring_tiles(const terrain::Mask& mask) {
  const IVec2 tiles = mask.grid().tiles();
  std::vector<std::uint8_t> found;
  for (int j = 0; j < tiles.y; ++j)
    for (int i = 0; i < tiles.x; ++i) {
      const auto& tile = mask.grid().tile({i, j});
      found.push_back(std::any_of(tile.begin(), tile.end(), [](std::uint8_t v) { return v > 0; }) ? 1 : 0);
    }
  return found;
}

/// What the cell of the mask is covered with all over, or kSeveral.
std::uint8_t cover_of_mask_cell(const terrain::Terrain& terrain, int i, int j) {
  const std::uint8_t barred = terrain.exclusion.grid().at(i, j);
  if (barred == 0) return static_cast<std::uint8_t>(Cover::natural);
  if (barred < 255) return CellCovers::kSeveral;
  if (terrain.areas.empty()) return static_cast<std::uint8_t>(Cover::gravel);
  const terrain::AreaCell cell = terrain.areas.cell(i, j);
  return cell.cover == 255 ? static_cast<std::uint8_t>(terrain.areas.area(cell.top).cover) : CellCovers::kSeveral;
}

}  // namespace

terrain::CoverShares cover_shares(const terrain::Terrain& terrain, Vec2 plan) {
  terrain::CoverShares shares{};
  const float barred = terrain.exclusion.at(plan);
  if (barred > 0.0f) {
    if (terrain.areas.empty())
      shares[index(Cover::gravel)] = barred;
    else
      shares = terrain.covers(plan);
  }
  shares[index(Cover::natural)] += 1.0f - std::accumulate(shares.begin(), shares.end(), 0.0f);
  return shares;
}

bool bars_anything(const terrain::Terrain& terrain) {
  const std::vector<std::uint8_t> tiles = barring_tiles(terrain.exclusion);
  return std::find(tiles.begin(), tiles.end(), 1) != tiles.end();
}

CellCovers::CellCovers(const terrain::Terrain& terrain, const GroundGrid& grid, int fineness)
    : nx_(grid.nx), ny_(grid.ny), cells_(grid.cells(), static_cast<std::uint8_t>(Cover::natural)) {
  const std::vector<std::uint8_t> barring = barring_tiles(terrain.exclusion);
  if (std::find(barring.begin(), barring.end(), 1) == barring.end()) return;
  const terrain::Lattice& lattice = terrain.exclusion.lattice();
  const IVec2 tiles = terrain.exclusion.grid().tiles();
  constexpr int kTile = TiledGrid<std::uint8_t>::kTile;
  const auto mask_cell = [&](float x, int count, int more) {
    return std::clamp(static_cast<int>(x / lattice.cell_m - 0.5f) + more, 0, count - 1);
  };

  const auto look = [&](int i, int j) -> std::uint8_t {
    // All cells of the mask that any place of this one is read from.
    const Vec2 low = grid.plan(i, j), high = grid.plan(i + 1, j + 1);
    const IVec2 first(mask_cell(low.x, lattice.cells.x, 0), mask_cell(low.y, lattice.cells.y, 0));
    const IVec2 last(mask_cell(high.x, lattice.cells.x, 1), mask_cell(high.y, lattice.cells.y, 1));
    bool barred = false;
    for (int tj = first.y / kTile; tj <= last.y / kTile; ++tj)
      for (int ti = first.x / kTile; ti <= last.x / kTile; ++ti)
        barred = barred || barring[static_cast<std::size_t>(tj * tiles.x + ti)];
    if (!barred) return static_cast<std::uint8_t>(Cover::natural);
    const std::uint8_t corner = cover_of_mask_cell(terrain, first.x, first.y);
    bool even = corner != kSeveral;
    for (int mj = first.y; even && mj <= last.y; ++mj)
      for (int mi = first.x; even && mi <= last.x; ++mi) even = cover_of_mask_cell(terrain, mi, mj) == corner;
    if (even) return corner;

    const auto cover_at = [&](int s, int t) {
      return static_cast<std::uint8_t>(largest(cover_shares(terrain, grid.plan_in(i, j, s, t, fineness))));
    };
    const std::uint8_t cover = cover_at(0, 0);
    for (int t = 0; t <= fineness; ++t)
      for (int s = 0; s <= fineness; ++s)
        if (cover_at(s, t) != cover) return kSeveral;
    return cover;
  };
  parallel_for(static_cast<std::size_t>(ny_), [&](std::size_t j) {
    for (int i = 0; i < nx_; ++i) cells_[grid.cell(i, static_cast<int>(j))] = look(i, static_cast<int>(j));
  });
  several_ = static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), kSeveral));
}

CoverPoint::CoverPoint(const Vec3& position, const terrain::CoverShares& found)
    : at(position), shares(found), cover(largest(found)) {}

Vec3 crossing(const terrain::Terrain& terrain, const CoverPoint& a, const CoverPoint& b) {
  // From the end with the lower cover, so that both triangles at an edge find the same point.
  const bool up = a.cover < b.cover;
  const CoverPoint &low = up ? a : b, &high = up ? b : a;
  const auto lead = [&](const terrain::CoverShares& s) { return s[index(low.cover)] - s[index(high.cover)]; };
  float from = 0.0f, to = 1.0f, at_from = lead(low.shares), at_to = lead(high.shares);
  for (int step = 0; step < kHalvings; ++step) {
    const float middle = 0.5f * (from + to);
    const float there = lead(cover_shares(terrain, to_plan(low.at + (high.at - low.at) * middle)));
    if (there > 0.0f)
      from = middle, at_from = there;
    else
      to = middle, at_to = there;
  }
  const float t = from + (to - from) * (at_from > at_to ? at_from / (at_from - at_to) : 0.5f);
  return low.at + (high.at - low.at) * std::clamp(t, kOffCorner, 1.0f - kOffCorner);
}

}  // namespace bosquet::geometry
