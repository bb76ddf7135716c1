// Ground grid: the terrain's heights on a square grid, as the meshes of ground and water read them.
//
// Model     one step, the smallest multiple of the terrain's cell that keeps to a budget of two triangles a cell, less a
//           quarter where lines between covers will take some; every cell is cut from its south-east to its north-west
//           corner
// Frame     sample (i, j) from the south-west corner, i east, j north; plan (east, north) metres
#pragma once

#include <cstddef>
#include <vector>

#include "core/vec.h"
#include "terrain/terrain.h"

namespace bosquet::geometry {

struct GroundGrid {
  int nx = 1, ny = 1;  ///< cells
  int fineness = 1;    ///< steps of the terrain's own cell in one of these
  Vec2 size{1.0f};
  std::vector<float> height;  ///< of (nx + 1) x (ny + 1) samples, southern row first

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx + 1) + static_cast<std::size_t>(i);
  }
  std::size_t cell(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
  std::size_t cells() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  Vec2 plan(int i, int j) const {
    return {size.x * static_cast<float>(i) / static_cast<float>(nx),
            size.y * static_cast<float>(j) / static_cast<float>(ny)};
  }
  Vec3 world(int i, int j) const { return to_world(plan(i, j), height[index(i, j)]); }

  /// Place (s, t) of the n x n parts of a cell: those on an edge are the same to the bit from both of its sides.
  Vec2 plan_in(int i, int j, int s, int t, int n) const;
  /// There, on the triangle of the cell.
  Vec3 world_in(int i, int j, int s, int t, int n) const;

  /// Of the triangles' surface at a plan position of the site.
  float height_at(Vec2 plan) const;
};

/// `max_triangles` is at least 2.
GroundGrid make_ground_grid(const terrain::Terrain& terrain, std::size_t max_triangles);

}  // namespace bosquet::geometry
