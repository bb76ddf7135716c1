// Obstacles: buildings, walls and other things that stand before any tree, as voxels that no crown enters.
//
// Source    Longay 2014, 6.5.1 names obstacles and trees that are already there as owners of voxels
// Model     a closed mesh fills its inside; an extruded outline fills the prism over it. A voxel belongs to the obstacle
//           when its centre lies inside, or nearer than half a voxel to the surface
// Decision  what lies outside the plan box that is asked for is left out; the others take memory wherever they stand
// Decision  the half voxel keeps walls thinner than a voxel tight, and crowns off the wall by as much
// Decision  a mesh that is open or crosses itself has no certain inside: its surface alone is an obstacle, and says so
// Units     metres; voxels of the lattice of crown_space.h
// Holds     a volume is a pure function of shape and lattice, the same for any number of threads
// Errors    a mesh that is not finite, or so large on this lattice that a wrong unit is likelier
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/polygon.h"
#include "core/result.h"
#include "core/triangle_mesh.h"
#include "core/vec.h"

namespace bosquet::crowns {

/// Edges of a voxel.
struct VoxelSize {
  float voxel_m = 0.25f;  ///< horizontal
  float layer_m = 1.0f;
};

/// Voxels [low, high) over one column.
struct ColumnSpan {
  IVec2 column{0};  ///< (east, north)
  std::int32_t low = 0, high = 0;

  bool operator==(const ColumnSpan&) const = default;
};

struct ObstacleVolume {
  std::vector<ColumnSpan> spans;  ///< sorted by (north, east, low), disjoint
  IVec2 low{0}, high{-1};         ///< columns, both included
  std::string warning;            ///< why only its surface counts; empty when it is filled
};

/// Something that stands there. `id` is below 0 and unique among obstacles and hero trees; it is what grids and slices
/// hold. Where two share a voxel, the one with the higher id (nearer to 0) has it.
struct Obstacle {
  std::int32_t id = -1;
  std::string name;
  std::shared_ptr<const ObstacleVolume> volume;

  bool operator==(const Obstacle&) const = default;
};

/// Everywhere.
inline constexpr Box2 kEverywhere{Vec2{std::numeric_limits<float>::lowest()}, Vec2{std::numeric_limits<float>::max()}};

/// Voxels of a mesh in world metres.
Result<ObstacleVolume> voxelise(const TriangleMesh& mesh, VoxelSize size, const Box2& within = kEverywhere);

/// Voxels of the prism over `outline` between two heights.
ObstacleVolume extrude(const Polygon& outline, float low_y, float high_y, VoxelSize size,
                       const Box2& within = kEverywhere);

/// Spans of a volume in one row of columns.
std::span<const ColumnSpan> row(const ObstacleVolume& volume, std::int32_t north);

/// Whether voxel (i, k, j) belongs to the volume.
bool holds(const ObstacleVolume& volume, IVec3 voxel);

/// Sorts and joins spans, and takes their bounds.
ObstacleVolume gather(std::vector<ColumnSpan> spans);

/// How the footprint of a volume lies to a point: of the columns that are taken at height `above_y` or higher.
struct Footprint {
  double area_m2 = 0;     ///< of all columns
  DVec2 nearest{0.0};     ///< plan, metres
  double distance_m = 0;  ///< from the point to it; 0 inside
  DVec2 middle{0.0};      ///< centroid of all columns, plan metres
};

/// Nothing when no such column lies within `within_m` of the point.
std::optional<Footprint> footprint_beside(const ObstacleVolume& volume, VoxelSize size, Vec2 point, float above_y,
                                          double within_m);

}  // namespace bosquet::crowns
