// Voxels of an obstacle's mesh, by OpenVDB's distance to it. Nothing else is here: OpenVDB's templates take long to
// compile.
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "crowns/mesh_solid.h"
#include "crowns/obstacle.h"

namespace bosquet::crowns {
namespace {

// Distances are known this far from the surface, in voxels; only the first half voxel is asked for.
constexpr float kBand = 2.0f;
constexpr float kVoxelMargin = 0.5f - 1e-3f;
// A surface without thickness may run exactly between two voxels: both are taken, lest it have holes.
constexpr float kSurfaceMargin = 0.5f + 1e-3f;
// A surface of so many voxels is a square kilometre at 0.25 m, and so long a mesh 25 km: the unit is wrong, or a vertex.
constexpr double kMostVoxels = 2e7, kLongest = 1e5, kFarthest = 1e9;

// A mesh in voxels: x east, y up, z north, whole numbers at centres. Mirrored, which OpenVDB does not mind. Coordinates
// are counted from `origin`, so that floats hold them to a thousandth of a voxel.
struct IndexMesh {
  openvdb::Coord origin;
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

DVec3 in_voxels(const Vec3& p, VoxelSize size) {
  const double voxel = static_cast<double>(size.voxel_m), layer = static_cast<double>(size.layer_m);
  return {static_cast<double>(p.x) / voxel - 0.5, static_cast<double>(p.y) / layer - 0.5,
          static_cast<double>(-p.z) / voxel - 0.5};
}

IndexMesh index_mesh(const TriangleMesh& mesh, VoxelSize size) {
  IndexMesh out;
  const DVec3 first = glm::floor(in_voxels(mesh.positions[mesh.indices.front()], size));
  out.origin = {static_cast<int>(first.x), static_cast<int>(first.y), static_cast<int>(first.z)};
  for (const Vec3& p : mesh.positions) {
    const DVec3 v = in_voxels(p, size) - first;
    out.points.emplace_back(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  }
  for (std::size_t t = 0; t < mesh.triangles(); ++t)
    out.triangles.emplace_back(mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]);
  return out;
}

Result<void> check(const TriangleMesh& mesh, VoxelSize size) {
  if (mesh.empty()) return Error{"it has no triangles"};
  for (const Vec3& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return Error{"a vertex is not a number"};
  double area = 0;
  DVec3 low{kFarthest}, high{-kFarthest};
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto corner = [&](std::size_t n) { return in_voxels(mesh.positions[mesh.indices[3 * t + n]], size); };
    const DVec3 a = corner(0), b = corner(1), c = corner(2);
    if (std::fabs(a.x) > kFarthest || std::fabs(a.y) > kFarthest || std::fabs(a.z) > kFarthest)
      return Error{"it lies thousands of kilometres away; is its unit metres?"};
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    low = glm::min(low, glm::min(a, glm::min(b, c))), high = glm::max(high, glm::max(a, glm::max(b, c)));
  }
  const DVec3 extent = high - low;
  if (const double longest = std::max({extent.x, extent.y, extent.z}); longest > kLongest)
    return Error{fmt::format("it is {:.2g} voxels long, more than {:.2g}; is its unit metres?", longest, kLongest)};
  if (area > kMostVoxels)
    return Error{
        fmt::format("its surface would take {:.2g} voxels, more than {:.2g}; is its unit metres?", area, kMostVoxels)};
  return {};
}

}  // namespace

Result<ObstacleVolume> voxelise(const TriangleMesh& mesh, VoxelSize size, const Box2& within) {
  if (auto fine = check(mesh, size); !fine) return fine.error();
  std::string warning;
  if (!is_closed(mesh))
    warning = "its mesh is open: only its surface keeps crowns out";
  else if (crosses_itself(mesh))
    warning = "its mesh crosses itself: only its surface keeps crowns out";

  std::vector<ColumnSpan> spans;
  try {
    openvdb::initialize();
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const int flags = warning.empty() ? 0 : openvdb::tools::UNSIGNED_DISTANCE_FIELD;
    const IndexMesh voxels = index_mesh(mesh, size);
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(voxels.points,
                                                                                             voxels.triangles);
    openvdb::util::NullInterrupter never;
    const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(never, adapter, *transform, kBand, kBand, flags);
    const auto column = [&](float v) {
      return static_cast<int>(
          std::clamp(std::floor(static_cast<double>(v) / static_cast<double>(size.voxel_m)), -kFarthest, kFarthest));
    };
    const int lowest = std::numeric_limits<int>::lowest(), highest = std::numeric_limits<int>::max();
    const openvdb::Coord least(column(within.low.x), lowest, column(within.low.y)),
        most(column(within.high.x), highest, column(within.high.y));
    const auto take = [&](const openvdb::CoordBBox& box) {
      openvdb::Coord low = box.min() + voxels.origin, high = box.max() + voxels.origin;
      low = openvdb::Coord::maxComponent(low, least), high = openvdb::Coord::minComponent(high, most);
      for (int z = low.z(); z <= high.z(); ++z)
        for (int x = low.x(); x <= high.x(); ++x) spans.push_back({{x, z}, low.y(), high.y() + 1});
    };
    const float margin = warning.empty() ? kVoxelMargin : kSurfaceMargin;
    for (auto value = grid->tree().cbeginValueAll(); value; ++value)
      if (*value < margin) take(value.getBoundingBox());
  } catch (const std::exception& e) {
    return cannot_finish(fmt::format("OpenVDB could not voxelise it: {}", e.what()));
  }
  ObstacleVolume volume = gather(std::move(spans));
  volume.warning = std::move(warning);
  return volume;
}

}  // namespace bosquet::crowns
