#include "distribution/region_mask.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "terrain/scanline.h"

namespace bosquet::distribution {
namespace {

using Cover = RegionMask::Cover;

// How a region covers the rectangle of a node's cell centres.
Cover cover_of(const Box2& region, const Box2& centres) {
  if (region.contains(centres.low) && region.contains(centres.high)) return Cover::full;
  const bool apart = centres.high.x < region.low.x || centres.low.x > region.high.x || centres.high.y < region.low.y ||
                     centres.low.y > region.high.y;
  return apart ? Cover::empty : Cover::partial;
}

Cover cover_of(const Disc& disc, const Box2& centres) {
  const Vec2 nearest = glm::clamp(disc.centre, centres.low, centres.high) - disc.centre;
  const Vec2 farthest = glm::max(glm::abs(centres.low - disc.centre), glm::abs(centres.high - disc.centre));
  const float r2 = disc.radius_m * disc.radius_m;
  if (farthest.x * farthest.x + farthest.y * farthest.y <= r2) return Cover::full;
  return nearest.x * nearest.x + nearest.y * nearest.y > r2 ? Cover::empty : Cover::partial;
}

// Cover of every node of every level under a polygon, from its cells upward.
class PolygonCover {
 public:
  PolygonCover(const Polygon& polygon, IVec2 cells, float cell_m, int top) {
    levels_.resize(static_cast<std::size_t>(top) + 1);
    levels_[0] = {cells, std::vector<Cover>(count(cells), Cover::empty)};
    for (int j = 0; j < cells.y; ++j) {
      const float north = (static_cast<float>(j) + 0.5f) * cell_m;
      const std::size_t row = static_cast<std::size_t>(j) * static_cast<std::size_t>(cells.x);
      terrain::scan_polygon(polygon, north, [&](float west, float east, int sign) {
        // Cells whose centre lies in [west, east).
        const auto first = [&](float x) {
          const float n = std::clamp(x / cell_m - 0.5f, -1.0f, static_cast<float>(cells.x));
          const int whole = static_cast<int>(n + 1.0f) - 1;
          return std::clamp(static_cast<float>(whole) < n ? whole + 1 : whole, 0, cells.x);
        };
        std::fill(levels_[0].covers.begin() + static_cast<std::ptrdiff_t>(row) + first(west),
                  levels_[0].covers.begin() + static_cast<std::ptrdiff_t>(row) + first(east),
                  sign > 0 ? Cover::full : Cover::empty);
      });
    }
    for (std::size_t level = 1; level < levels_.size(); ++level) {
      const IVec2 below = levels_[level - 1].nodes, nodes = (below + 1) / 2;
      levels_[level] = {nodes, std::vector<Cover>(count(nodes))};
      for (int y = 0; y < nodes.y; ++y)
        for (int x = 0; x < nodes.x; ++x) {
          bool some = false, all = true;
          for (int c = 0; c < 4; ++c) {
            const IVec2 child{2 * x + c % 2, 2 * y + c / 2};
            if (child.x >= below.x || child.y >= below.y) continue;
            const Cover cover = at(static_cast<int>(level) - 1, child.x, child.y);
            some = some || cover != Cover::empty;
            all = all && cover == Cover::full;
          }
          levels_[level]
              .covers[static_cast<std::size_t>(y) * static_cast<std::size_t>(nodes.x) + static_cast<std::size_t>(x)] =
              all    ? Cover::full
              : some ? Cover::partial
                     : Cover::empty;
        }
    }
  }

  Cover at(int level, int x, int y) const {
    const Level& l = levels_[static_cast<std::size_t>(level)];
    return l.covers[static_cast<std::size_t>(y) * static_cast<std::size_t>(l.nodes.x) + static_cast<std::size_t>(x)];
  }

 private:
  struct Level {
    IVec2 nodes{0};
    std::vector<Cover> covers;
  };
  static std::size_t count(IVec2 n) { return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y); }
  std::vector<Level> levels_;
};

}  // namespace

RegionMask::RegionMask(const Region& region, IVec2 cells, float cell_m, int top) {
  std::function<Cover(int, int, int)> cover;
  const auto over_centres = [&](const auto& shape) {
    return [&shape, cells, cell_m](int level, int x, int y) {
      const IVec2 low{x << level, y << level}, high = glm::min(IVec2{(x + 1) << level, (y + 1) << level}, cells) - 1;
      return cover_of(shape, Box2{(Vec2(low) + 0.5f) * cell_m, (Vec2(high) + 0.5f) * cell_m});
    };
  };
  if (const auto* box = std::get_if<Box2>(&region)) {
    cover = over_centres(*box);
  } else if (const auto* disc = std::get_if<Disc>(&region)) {
    cover = over_centres(*disc);
  } else {
    cover = [polygon = PolygonCover(std::get<Polygon>(region), cells, cell_m, top)](int level, int x, int y) {
      return polygon.at(level, x, y);
    };
  }

  nodes_.push_back({0, 0, static_cast<std::uint8_t>(top), cover(top, 0, 0), 0});
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node parent = nodes_[n];
    if (parent.cover != Cover::partial) continue;
    assert(parent.level > 0);
    nodes_[n].first_child = static_cast<std::uint32_t>(nodes_.size());
    const int level = parent.level - 1;
    for (int c = 0; c < 4; ++c) {
      const int x = 2 * parent.x + c % 2, y = 2 * parent.y + c / 2;
      const bool on_grid = (x << level) < cells.x && (y << level) < cells.y;
      nodes_.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), static_cast<std::uint8_t>(level),
                        on_grid ? cover(level, x, y) : Cover::empty, 0});
    }
  }
}

}  // namespace bosquet::distribution
