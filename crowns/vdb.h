// The crown space as a sparse OpenVDB grid, and its .vdb file that film tools open.
//
// Grid      Int32, name "trees"; a voxel holds its tree's id; 0 is the background and means free. Ids below 0 are
//           obstacles and hero trees.
// Frame     index (x, y, z) = (i, k, -1 - j) of the lattice of crown_space.h: x east, y up, z south. The grid's
//           transform maps index 0.5 past it, the voxel's centre, to world metres, so tools see the forest where glTF
//           shows it.
// Errors    a path that cannot be written comes back as a message; the file appears whole or not at all
// Holds     values are the same for any number of threads; file bytes are not (OpenVDB stamps each write)
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "crowns/crown_space.h"

namespace bosquet::crowns {

/// A sparse grid of tree ids; copies share it. OpenVDB's headers stay in vdb.cpp.
class TreeGrid {
 public:
  struct Impl;
  explicit TreeGrid(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::size_t active_voxels() const;
  /// Id at lattice voxel (i, k, j), 0 when free.
  std::int32_t id(IVec3 voxel) const;
  float voxel_m() const;
  float layer_m() const;
  /// World position of a voxel's centre by the grid's own transform.
  Vec3 world_centre(IVec3 voxel) const;
  /// The name that the grid's metadata holds for a tree; empty when none.
  std::string name(std::int32_t id) const;
  /// Calls visit(voxel, id) for every active voxel, in no order that means anything.
  void for_each(const std::function<void(IVec3, std::int32_t)>& visit) const;
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// All claimed voxels as one grid. Leaves are filled in parallel.
TreeGrid build_grid(const CrownSpace& space);

/// Writes the grid beside `path` and renames it into place. `names` (id, name) go into the grid's metadata as
/// "tree <id>", of obstacles and hero trees as "standing <id>".
Result<void> write_vdb(const TreeGrid& grid, const std::filesystem::path& path,
                       const std::vector<std::pair<std::int32_t, std::string>>& names = {});

/// Reads a grid that write_vdb wrote.
Result<TreeGrid> read_vdb(const std::filesystem::path& path);

}  // namespace bosquet::crowns
