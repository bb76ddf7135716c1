// Tree levels: a tree for any triangle budget, from all of it down to four triangles.
//
// Levels    mesh   branches and leaves, clusters or cards (tree_mesh.h), from kLeastMeshTriangles up
//           shell  the thickest wood and a crown of patches (lod_shell.h), from kLeastShellTriangles up; both need
//                  more for trees of several stems
//           cards  pictures of the tree on four or two cards (impostor.h)
//           Where a level gives way to the next is where the next one looks more like the tree at the distance that so
//           few triangles are for (bench/lod_table measures the difference)
// Model     shell and cards are made from a source mesh of at most kSourceTriangles, whose own foliage keeps the area and
//           the colour of all leaves
// Units     metres, tree frame
// Holds     no form takes more than its budget, down to kTwoCardTriangles; the same bits anywhere
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/impostor.h"
#include "geometry/lod_raster.h"
#include "geometry/tree_mesh.h"
#include "geometry/wind.h"

namespace bosquet::geometry {

enum class TreeForm { mesh, shell, four_cards, two_cards };
inline constexpr std::array<std::string_view, 4> kTreeFormNames{"mesh", "shell", "four cards", "two cards"};

inline constexpr std::size_t kLeastMeshTriangles = 400;
inline constexpr std::size_t kLeastShellTriangles = 48;
inline constexpr std::size_t kSourceTriangles = 6000;

/// What a budget (0: no limit) makes of a tree with so many stems.
TreeForm form_within(std::size_t max_triangles, std::size_t stems = 1);

/// Stems that stand at the end of a season (-1: the last).
std::size_t stems(const growth::Skeleton& skeleton, int season);

struct TreeInput {
  const growth::Skeleton* skeleton = nullptr;
  std::span<const float> radius;
  const Look* look = nullptr;
  const FoliageLook* foliage = nullptr;
  MeshOptions options;  ///< its max_triangles is the level's budget
};

/// A species' textures as the rasteriser reads them.
struct TreeSkins {
  RasterSkin bark, leaf, mass;
};

/// The part of an atlas that a tree's pictures go to.
struct ImpostorPlace {
  Image* atlas = nullptr;
  ImpostorBlock block;
};

/// Its wind weights (wind.h).
TreeWind tree_wind(const TreeInput& tree);

/// The source mesh of a tree's coarse levels.
TreeMesh source_mesh(const TreeInput& tree);

/// Wood and shell within the tree's budget; the shell's foliage is `cards`, it shows the foliage mass.
TreeMesh build_shell(const TreeInput& tree, const TreeMesh& source, const TreeSkins& skins);

/// Paints the tree into its place.
ImpostorFrame build_picture(const TreeMesh& source, const TreeSkins& skins, const ImpostorPlace& place);

}  // namespace bosquet::geometry
