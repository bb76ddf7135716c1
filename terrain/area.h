// Areas: the named parts of a site where nothing is planted, and what covers the ground there.
//
// Model     each cell knows the area on top, how far it covers the cell, and one area under it; what a newer area does
//           not cover of a cell still shows the older one, so edges between areas are as fine as those of a mask.
//           The share of a cell that is barred at all is the terrain's exclusion mask; the top area has the smaller of
//           its cover and that, the area under it the rest
// Frame     plan (east, north) metres; cell (i, j) as the mask's
// Decision  id 0 is the area without a name: an exclusion of which nobody said what it is. A third area in a cell
//           takes the place of the one that shows less
// Holds     ids are never reused or reordered by an edit; the table of areas is shared by copies
// Errors    none
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.h"
#include "terrain/lattice.h"
#include "terrain/tiled_grid.h"

namespace bosquet::terrain {

enum class AreaKind { other, path, lawn, bed, building, water };
inline constexpr std::array<std::string_view, 6> kAreaKindNames{"other", "path", "lawn", "bed", "building", "water"};

/// What an area's ground is drawn as; `natural` as the ground around it.
enum class Cover { natural, gravel, paving, grass, soil };
inline constexpr std::array<std::string_view, 5> kCoverNames{"natural", "gravel", "paving", "grass", "soil"};

/// What a kind of area is covered with unless it is said: paths and others with gravel, lawns with grass, beds and the
/// ground of water with soil, buildings with paving.
Cover usual_cover(AreaKind kind);

struct Area {
  std::string name = {};
  AreaKind kind = AreaKind::other;
  Cover cover = Cover::gravel;
  std::optional<float> water_level_m = {};  ///< of a pond: its own level, beside the site's

  bool operator==(const Area&) const = default;
};

using AreaId = std::uint16_t;
inline constexpr std::size_t kMostAreas = 65'535;

struct AreaCell {
  AreaId top = 0, under = 0;
  std::uint8_t cover = 0;  ///< of the top area, in 1/255

  bool operator==(const AreaCell&) const = default;
};

/// Shares of the covers at a place, in the order of Cover; together the share that is barred from planting.
using CoverShares = std::array<float, kCoverNames.size()>;

/// Which area lies where. Without areas it holds no cells.
class AreaLayer {
 public:
  AreaLayer() = default;

  const Area& area(AreaId id) const { return (*areas_)[id]; }
  std::size_t count() const { return areas_->size(); }  ///< the one without a name included
  const std::vector<Area>& all() const { return *areas_; }
  bool empty() const { return areas_->size() == 1; }
  AreaCell cell(int i, int j) const { return empty() ? AreaCell{} : grid_.at(i, j); }

  /// The id of an equal area, else of `area` put at the table's end. A full table (kMostAreas) gives the nameless one.
  AreaId add(const Lattice& lattice, const Area& area);

  const TiledGrid<AreaCell>& grid() const { return grid_; }
  TiledGrid<AreaCell>& grid() { return grid_; }  ///< to be edited through a TileEditor; after an add

  /// The cell once `id` covers `covered` / 255 of it, of which `barred` / 255 was barred before.
  static AreaCell painted(AreaCell cell, AreaId id, std::uint8_t covered, std::uint8_t barred);

 private:
  static const std::shared_ptr<const std::vector<Area>>& nameless();

  std::shared_ptr<const std::vector<Area>> areas_ = nameless();
  TiledGrid<AreaCell> grid_;
};

}  // namespace bosquet::terrain
