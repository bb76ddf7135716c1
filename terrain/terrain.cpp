#include "terrain/terrain.h"

namespace bosquet::terrain {
namespace {

// The four cells whose middles surround a place, with the weights of bilinear interpolation; as Mask::at.
struct Around {
  int i[2], j[2];
  float u, v;

  Around(const Lattice& lattice, Vec2 plan) {
    const auto along = [&](float x, int cells, int(&n)[2]) {
      const float p = x / lattice.cell_m - 0.5f;
      const float inside = p > 0.0f ? std::min(p, static_cast<float>(cells - 1)) : 0.0f;
      n[0] = static_cast<int>(inside);
      n[1] = std::min(n[0] + 1, cells - 1);
      return inside - static_cast<float>(n[0]);
    };
    u = along(plan.x, lattice.cells.x, i);
    v = along(plan.y, lattice.cells.y, j);
  }
};

// Calls visit(id, share) for what the cells around a place hold of each area.
template <class Visit>
void visit_shares(const Terrain& terrain, Vec2 plan, const Visit& visit) {
  const Around around(terrain.exclusion.lattice(), plan);
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a < 2; ++a) {
      const std::uint8_t barred = terrain.exclusion.grid().at(around.i[a], around.j[b]);
      if (barred == 0) continue;
      const float weight = (a ? around.u : 1.0f - around.u) * (b ? around.v : 1.0f - around.v) * (1.0f / 255.0f);
      const AreaCell cell = terrain.areas.cell(around.i[a], around.j[b]);
      const std::uint8_t top = std::min(cell.cover, barred);
      if (top > 0) visit(cell.top, weight * static_cast<float>(top));
      if (barred > top) visit(cell.under, weight * static_cast<float>(barred - top));
    }
}

}  // namespace

std::optional<float> Terrain::water_level(Vec2 plan) const {
  if (!has_ponds()) return water_level_m;
  const Lattice& lattice = height.lattice();
  const auto cell = [&](float x, int n) {
    const float p = x / lattice.cell_m;
    return p > 0.0f ? static_cast<int>(std::min(p, static_cast<float>(n - 1))) : 0;
  };
  const AreaId pond = ponds.at(cell(plan.x, lattice.cells.x), cell(plan.y, lattice.cells.y));
  const std::optional<float> own = pond ? areas.area(pond).water_level_m : std::nullopt;
  if (!own || !water_level_m) return own ? own : water_level_m;
  return std::max(*own, *water_level_m);
}

const Area* Terrain::area_at(Vec2 plan) const {
  if (!excluded(plan)) return nullptr;
  if (areas.empty()) return &areas.area(0);
  AreaId ids[8];
  float shares[8];
  int count = 0;
  visit_shares(*this, plan, [&](AreaId id, float share) {
    int n = 0;
    while (n < count && ids[n] != id) ++n;
    if (n == count) ids[n] = id, shares[n] = 0.0f, ++count;
    shares[n] += share;
  });
  int best = 0;  // ties: the lower id
  for (int n = 1; n < count; ++n)
    if (shares[n] > shares[best] || (shares[n] == shares[best] && ids[n] < ids[best])) best = n;
  return &areas.area(count > 0 ? ids[best] : AreaId{0});
}

CoverShares Terrain::covers(Vec2 plan) const {
  CoverShares shares{};
  visit_shares(*this, plan,
               [&](AreaId id, float share) { shares[static_cast<std::size_t>(areas.area(id).cover)] += share; });
  return shares;
}

}  // namespace bosquet::terrain
