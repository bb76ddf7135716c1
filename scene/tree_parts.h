// Tree parts: the meshes of all trees of a scene, each at the level that its budget pays for.
//
// Model     a tree with its full need met is meshed whole; else its budget chooses a form (geometry/tree_levels.h). Trees
//           that become cards get their pictures on atlas pages of kPageBlocks x kPageBlocks blocks, which are appended
//           to the materials, two to a page: one-sided for four cards, two-sided for two
// Levels    when asked for, each tree also gets coarser levels: a fifth of its triangles twice, a shell, four cards. A
//           level serves down to the coverage at which the next has as many triangles for its area on the picture
// Decision  at most kMostPictures trees are painted; where more become cards, trees of one species that are alike in
//           crown width over height share a picture, stretched to their size
// Holds     the same bits for any number of threads
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "geometry/tree_levels.h"
#include "scene/model.h"

namespace bosquet::scene {

inline constexpr int kPageBlocks = 16;
inline constexpr std::size_t kMostPictures = 1024;

/// A tree to be built.
struct TreeOrder {
  geometry::TreeInput input;
  std::size_t species = 0;
  std::size_t budget = 0;  ///< triangles; 0: no limit
  std::size_t need = 0;    ///< triangles of all of it, about
  Vec2 size{1.0f};         ///< crown width, height, metres
};

struct TreeParts {
  std::vector<Part> parts;
  std::vector<Level> coarser;
  float coverage = 0.0f;       ///< of `parts`
  float wind_m = 0.0f;         ///< with wind weights: how far what moves most does (geometry/wind.h)
  std::size_t leaf_cards = 0;  ///< leaves or leafed twigs in `parts`
  geometry::TreeForm form = geometry::TreeForm::mesh;
};

/// `materials` are those of materials.h. Progress advances once a tree; cancelled, some of the parts are missing. `done`
/// (may be empty) is called from any thread with the index of a tree whose input is not read any more.
std::vector<TreeParts> build_tree_parts(std::span<const TreeOrder> trees, bool levels, std::vector<Material>& materials,
                                        Progress* progress, const std::function<void(std::size_t)>& done = {});

}  // namespace bosquet::scene
