#include "terrain/exclusion.h"

#include "terrain/brush.h"
#include "terrain/scanline.h"

namespace bosquet::terrain {
namespace {

// Bars cells one by one, and gives them to an area.
class Bar {
 public:
  Bar(Terrain& terrain, const Area& area)
      : terrain_(terrain),
        id_(terrain.areas.add(terrain.exclusion.lattice(), area)),
        mask_(terrain.exclusion.grid()),
        areas_(terrain.areas.grid()) {}

  void operator()(int i, int j, float share) {
    const std::uint8_t covered = Mask::stored(share), was = terrain_.exclusion.grid().at(i, j);
    if (covered == 0) return;
    if (covered > was) mask_.set(i, j, covered);
    if (terrain_.areas.empty()) return;
    const AreaCell before = terrain_.areas.cell(i, j), now = AreaLayer::painted(before, id_, covered, was);
    if (now != before) areas_.set(i, j, now);
  }

 private:
  Terrain& terrain_;
  AreaId id_;
  TileEditor<std::uint8_t> mask_;
  TileEditor<AreaCell> areas_;
};

}  // namespace

Terrain exclude(const Terrain& terrain, const Polygon& polygon, const Area& area) {
  Terrain after = terrain;
  Bar bar(after, area);
  visit_covered(polygon, after.exclusion.lattice(), bar);
  return after;
}

Terrain exclude_outside(const Terrain& terrain, const Polygon& polygon, const Area& area) {
  Terrain after = terrain;
  const Lattice& lattice = after.exclusion.lattice();
  Mask inside(lattice, 0.0f);
  {
    TileEditor<std::uint8_t> editor(inside.grid());
    visit_covered(polygon, lattice, [&](int i, int j, float share) { editor.set(i, j, Mask::stored(share)); });
  }
  Bar bar(after, area);
  for (int j = 0; j < lattice.cells.y; ++j)
    for (int i = 0; i < lattice.cells.x; ++i) bar(i, j, 1.0f - inside.cell(i, j));
  return after;
}

Terrain exclude_path(const Terrain& terrain, std::span<const Vec2> path, float width_m, const Area& area) {
  return apply(
      terrain,
      {.kind = BrushKind::exclude, .points = {path.begin(), path.end()}, .radius_m = 0.5f * width_m, .area = area});
}

}  // namespace bosquet::terrain
