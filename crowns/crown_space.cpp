#include "crowns/crown_space.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "crowns/space_layout.h"

namespace bosquet::crowns {
namespace {

// Floor division: tile and column inside it of a column that may be negative.
std::int32_t tile_index(std::int32_t column) { return column >> 6; }
std::int32_t within_tile(std::int32_t column) { return column & (kTileEdge - 1); }

constexpr double kFarIndex = 0x1p30;  // beyond every lattice, within 32 bits

std::int32_t floor_index(double metres, float edge) {
  return static_cast<std::int32_t>(std::clamp(std::floor(metres / static_cast<double>(edge)), -kFarIndex, kFarIndex));
}
std::int32_t ceil_index(double metres, float edge) { return -floor_index(-metres, edge); }

}  // namespace

const SpaceTile* CrownSpace::find_tile(IVec2 tile) const {
  const auto at = std::lower_bound(tiles_.begin(), tiles_.end(), tile,
                                   [](const auto& held, IVec2 asked) { return by_north_then_east(held->tile, asked); });
  return at != tiles_.end() && (*at)->tile == tile ? at->get() : nullptr;
}

std::int32_t CrownSpace::owner(IVec3 voxel) const {
  const SpaceTile* tile = find_tile({tile_index(voxel.x), tile_index(voxel.z)});
  if (!tile || !tile->has(voxel.y)) return kFree;
  const std::int32_t held =
      tile->owner[tile->offset(voxel.y) +
                  static_cast<std::size_t>(within_tile(voxel.z) * kTileEdge + within_tile(voxel.x))];
  return held < 0 ? held : claimant_of(held);
}

std::int32_t CrownSpace::id(IVec3 voxel) const {
  const std::int32_t held = owner(voxel);
  return held < 0 ? id_of_owner(held) : claimants_[static_cast<std::size_t>(held)].id;
}

std::uint64_t CrownSpace::ticks(IVec3 voxel) const {
  const SpaceTile* tile = find_tile({tile_index(voxel.x), tile_index(voxel.z)});
  if (!tile || !tile->has(voxel.y) || tile->ticks.empty()) return 0;
  return tile->ticks[tile->offset(voxel.y) +
                     static_cast<std::size_t>(within_tile(voxel.z) * kTileEdge + within_tile(voxel.x))];
}

std::int32_t CrownSpace::owner_at(const Vec3& world) const {
  return owner({floor_index(world.x, voxel_m()), floor_index(world.y, layer_m()), floor_index(-world.z, voxel_m())});
}

std::size_t CrownSpace::claimed_voxels(std::size_t claimant) const {
  std::int64_t sum = 0;
  for (const LayerShare& share : shares(claimant)) sum += share.voxels;
  return static_cast<std::size_t>(sum);
}

Vec2 CrownSpace::centroid(const LayerShare& share) const {
  const double n = static_cast<double>(share.voxels), edge = static_cast<double>(voxel_m());
  return {static_cast<float>((static_cast<double>(share.east_sum) / n + 0.5) * edge),
          static_cast<float>((static_cast<double>(share.north_sum) / n + 0.5) * edge)};
}

std::size_t CrownSpace::bytes() const {
  std::size_t sum = 0;
  for (const auto& tile : tiles_)
    sum += tile->owner.size() * sizeof(std::int32_t) + tile->ticks.size() * sizeof(std::uint64_t) +
           tile->ground->size() * sizeof(std::int32_t);
  return sum;
}

CrownRegion region(const CrownSpace& space, std::size_t claimant) {
  const auto shares = space.shares(claimant);
  const Claimant& tree = space.claimants()[claimant];
  CrownRegion out;
  out.voxel_m = space.voxel_m();
  out.layer_m = space.layer_m();
  if (shares.empty()) return out;

  // The tight box, in columns and layers.
  IVec2 low = shares.front().low, high = shares.front().high;
  for (const LayerShare& share : shares) low = glm::min(low, share.low), high = glm::max(high, share.high);
  const std::int32_t bottom = shares.front().layer, top = shares.back().layer;
  out.cells = {high.x - low.x + 1, top - bottom + 1, high.y - low.y + 1};
  const double voxel = static_cast<double>(out.voxel_m), layer = static_cast<double>(out.layer_m);
  out.low = {static_cast<float>(low.x * voxel - static_cast<double>(tree.base.x)),
             static_cast<float>(bottom * layer - static_cast<double>(tree.ground_y)),
             static_cast<float>(static_cast<double>(tree.base.y) - (high.y + 1) * voxel)};
  const std::size_t cells = static_cast<std::size_t>(out.cells.x) * static_cast<std::size_t>(out.cells.y) *
                            static_cast<std::size_t>(out.cells.z);
  out.bits.assign((cells + 63) / 64, 0);

  const std::int32_t me = space.slot_of(claimant);
  for (const LayerShare& share : shares)
    for (std::int32_t tn = tile_index(share.low.y); tn <= tile_index(share.high.y); ++tn)
      for (std::int32_t te = tile_index(share.low.x); te <= tile_index(share.high.x); ++te) {
        const SpaceTile* tile = space.find_tile({te, tn});
        if (!tile || !tile->has(share.layer)) continue;
        const std::int32_t* owner = tile->owner.data() + tile->offset(share.layer);
        const IVec2 corner{te * kTileEdge, tn * kTileEdge};
        const IVec2 from = glm::max(share.low, corner), to = glm::min(share.high, corner + (kTileEdge - 1));
        for (std::int32_t j = from.y; j <= to.y; ++j)
          for (std::int32_t i = from.x; i <= to.x; ++i)
            if (owner[(j - corner.y) * kTileEdge + (i - corner.x)] == me)
              out.claim({i - low.x, share.layer - bottom, high.y - j});
      }
  return out;
}

SpaceSlice slice(const CrownSpace& space, float y, const Box2& area) {
  SpaceSlice out;
  out.voxel_m = space.voxel_m();
  const std::int32_t layer = floor_index(y, space.layer_m());

  // What tiles cover of the area, in columns.
  IVec2 low{std::numeric_limits<std::int32_t>::max()}, high{std::numeric_limits<std::int32_t>::lowest()};
  for (const auto& tile : space.tiles()) {
    low = glm::min(low, tile->tile * kTileEdge);
    high = glm::max(high, tile->tile * kTileEdge + (kTileEdge - 1));
  }
  if (area.empty() || low.x > high.x) return out;
  low = glm::max(low, IVec2{floor_index(area.low.x, out.voxel_m), floor_index(area.low.y, out.voxel_m)});
  high = glm::min(high, IVec2{ceil_index(area.high.x, out.voxel_m) - 1, ceil_index(area.high.y, out.voxel_m) - 1});
  if (low.x > high.x || low.y > high.y) return out;
  out.low = {static_cast<float>(low.x) * out.voxel_m, static_cast<float>(low.y) * out.voxel_m};
  out.width = high.x - low.x + 1;
  out.height = high.y - low.y + 1;
  out.ids.assign(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), 0);

  for (const auto& tile : space.tiles()) {
    if (!tile->has(layer)) continue;
    const std::int32_t* owner = tile->owner.data() + tile->offset(layer);
    const IVec2 corner = tile->tile * kTileEdge;
    const IVec2 from = glm::max(low, corner), to = glm::min(high, corner + (kTileEdge - 1));
    for (std::int32_t j = from.y; j <= to.y; ++j)
      for (std::int32_t i = from.x; i <= to.x; ++i) {
        const std::int32_t held = owner[(j - corner.y) * kTileEdge + (i - corner.x)];
        out.ids[static_cast<std::size_t>(j - low.y) * static_cast<std::size_t>(out.width) +
                static_cast<std::size_t>(i - low.x)] =
            held < 0 ? id_of_owner(held) : space.claimants()[static_cast<std::size_t>(space.claimant_of(held))].id;
      }
  }
  return out;
}

}  // namespace bosquet::crowns
