// Model builder: meshes, materials and cameras of a grown scene, within a triangle budget.
//
// Model     ground and water take at most kGroundShare of the budget, grass kGrassShare, the trees share the rest: each tree asks for what
//           its full mesh needs; when that is too much every tree gets a + c * w^3, never more than it asks for: a an even
//           share of a part of the budget, w the largest apparent size (height / distance) to any camera of the recipe,
//           less out of its picture, or the height without cameras, c such that the sum is the budget
// Units     metres, world frame; extras in metres, years and degrees
// Holds     the same bits for any number of threads
// Errors    a budget below what ground, water, obstacles and four triangles a tree take (says the least possible);
//           cancelled (kind cannot_finish)
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "core/progress.h"
#include "core/result.h"
#include "geometry/season.h"
#include "geometry/tree_levels.h"
#include "scene/grown_scene.h"
#include "scene/model.h"
#include "scene/painting_cache.h"

namespace bosquet::scene {

inline constexpr float kGroundShare = 0.08f, kGrassShare = 0.12f;

struct ModelOptions {
  geometry::Season season = geometry::Season::summer;
  geometry::FoliageLevel foliage = geometry::FoliageLevel::clusters;
  std::size_t max_triangles = 3'000'000;     ///< of the finest levels; 0: no limit
  bool levels = false;                       ///< trees get coarser levels too (scene/tree_parts.h)
  bool wind = false;                         ///< trees get wind weights (geometry/wind.h)
  bool grass = false;                        ///< the model has the tufts that its cameras see best (scene/grass.h)
  const PaintingCache* paintings = nullptr;  ///< textures painted before; may be null
  /// The model is for one picture: budgets go by its camera alone, and trees so near that single leaves can be told are
  /// built of them where clusters would do for others.
  std::optional<Camera> picture{};
  int picture_height = 1080;  ///< pixels
  /// Called from any thread with the index of a tree of the scene whose skeleton is not read any more: it may be given up.
  std::function<void(std::size_t)> meshed{};
};

struct BuiltModel {
  Model model;
  Seconds seconds;                                                   ///< "geometry", "textures"
  std::size_t ground_triangles = 0;                                  ///< geometry::GroundOptions::max_triangles
  std::size_t leaf_cards = 0;                                        ///< leaves or leafed twigs in the meshes
  std::size_t triangles = 0;                                         ///< of the finest levels
  std::size_t mesh_bytes = 0;                                        ///< of all levels, in memory
  std::array<std::size_t, geometry::kTreeFormNames.size()> forms{};  ///< trees of each geometry::TreeForm
};

Result<BuiltModel> build_model(const GrownScene& scene, const ModelOptions& options, Progress* progress);

/// Triangles for each tree: min(need, even share + c * weight) with the sum not above `budget`, and all of `need` when
/// it fits.
std::vector<std::size_t> divide_budget(const std::vector<std::size_t>& need, const std::vector<float>& weight,
                                       std::size_t budget);

}  // namespace bosquet::scene
