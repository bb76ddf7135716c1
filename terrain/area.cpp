#include "terrain/area.h"

#include <algorithm>

namespace bosquet::terrain {

Cover usual_cover(AreaKind kind) {
  switch (kind) {
    case AreaKind::lawn:
      return Cover::grass;
    case AreaKind::bed:
    case AreaKind::water:
      return Cover::soil;
    case AreaKind::building:
      return Cover::paving;
    case AreaKind::other:
    case AreaKind::path:
      break;
  }
  return Cover::gravel;
}

const std::shared_ptr<const std::vector<Area>>& AreaLayer::nameless() {
  static const auto table = std::make_shared<const std::vector<Area>>(1);
  return table;
}

AreaId AreaLayer::add(const Lattice& lattice, const Area& area) {
  const auto found = std::find(areas_->begin(), areas_->end(), area);
  if (found != areas_->end()) return static_cast<AreaId>(found - areas_->begin());
  if (areas_->size() >= kMostAreas) return 0;
  if (empty() || grid_.size() != lattice.cells) grid_ = TiledGrid<AreaCell>(lattice.cells, AreaCell{});
  auto table = std::make_shared<std::vector<Area>>(*areas_);
  table->push_back(area);
  areas_ = std::move(table);
  return static_cast<AreaId>(areas_->size() - 1);
}

AreaCell AreaLayer::painted(AreaCell cell, AreaId id, std::uint8_t covered, std::uint8_t barred) {
  if (covered == 0) return cell;
  const int top = std::min(cell.cover, barred), under = barred - top;
  AreaCell now{id, cell.under, covered};
  if (cell.top == id)
    // What there was of it stays: a second stroke of the same area widens nothing.
    now.cover = static_cast<std::uint8_t>(std::max<int>(top, covered));
  else if (cell.under == id || top >= under)
    now.under = cell.top;
  if (now.cover >= barred) now.under = id;  // nothing shows under it
  return now;
}

}  // namespace bosquet::terrain
