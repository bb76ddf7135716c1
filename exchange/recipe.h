// Recipe: a forest as a readable text file (TOML).
//
// Format    docs/recipe.md lists every key with type, unit, range and default
// Frame     plan positions are (east, north) metres from the site's south-west corner; camera heights are metres above
//           the ground under the camera or target
// Decision  a recipe is read whole into plain values first (read_recipe), so that mistakes come before any work; then
//           the ground is made and the trees are planted, block by block in the order of the file (build_document)
// Holds     the same recipe gives the same document; a tree's key comes from its block's name and its number in it, so
//           adding a block reshuffles no other block's trees
// Errors    file, line, key, what is allowed, and the nearest known name
#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/polygon.h"
#include "core/progress.h"
#include "core/result.h"
#include "distribution/kernels.h"
#include "distribution/region.h"
#include "distribution/rows.h"
#include "distribution/sowing.h"
#include "distribution/thinning.h"
#include "exchange/ground_recipe.h"
#include "exchange/tree_file.h"
#include "exchange/tree_import.h"
#include "exchange/world_file.h"
#include "scene/document.h"
#include "scene/grown_scene.h"

namespace bosquet::exchange {

enum class PlantingKind { fill, thinning, brush, row, grid, hedge, single, inventory, trees };
inline constexpr std::array<std::string_view, 9> kPlantingKindNames{"fill",  "thinning", "brush",     "row",  "grid",
                                                                    "hedge", "single",   "inventory", "trees"};

/// What is ordered of a block's trees beside their species and size.
struct TreeOrder {
  scene::TreeStatus status = scene::TreeStatus::proposed;
  float clear_stem_m = 0.0f;
  crowns::ClippedForm form;  ///< width and depth 0: as the rows ask for
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, TreeOrder>
void describe(P& p, Visitor& visit) {
  visit(Choice{"status", scene::kTreeStatusNames, "What is to happen to the trees; an inventory's are existing"},
        p.status);
  visit(Real{"clear_stem_m", "m", 0, 40, "Height below which no branch grows"}, p.clear_stem_m);
  describe(p.form, visit);
}

struct PlantingRecipe {
  std::string name;
  PlantingKind kind = PlantingKind::fill;
  TreeOrder order;
  std::vector<distribution::MixEntry> mix;
  std::optional<distribution::Region> area;  ///< missing: the whole site
  std::optional<std::size_t> count;
  std::optional<float> per_hectare;
  distribution::ThinningRules thinning;
  std::vector<Vec2> line;  ///< of rows, hedges and brush strokes
  distribution::RowRules row;
  distribution::GridRules grid;
  distribution::PlantBrush brush;
  float seconds = 2.0f;  ///< that the brush stroke took
  Vec2 at{0.0f};
  float scale = 1.0f;
  std::filesystem::path file;
  TreeImport import;  ///< of an inventory
  std::size_t default_species = 0;
};

struct ObstacleRecipe {
  std::string name;
  std::filesystem::path file;  ///< a mesh, or outlines; empty: `outline`
  std::vector<Vec2> outline;   ///< plan
  Vec2 at{0.0f};               ///< of a mesh's origin, plan
  float rotation_deg = 0.0f;   ///< counter-clockwise seen from above
  float scale = 1.0f;
  float height_m = 8.0f;                 ///< of outlines that say none
  std::vector<std::vector<Vec2>> holes;  ///< of `outline`
  std::optional<float> low_m, high_m;    ///< of `outline`, above datum; in place of height_m
  bool on_ground = true;                 ///< a mesh's height 0 is the ground at `at`, else the datum
  std::int32_t id = 0;                   ///< 0: the next
};

struct HeroRecipe {
  std::string name;
  std::filesystem::path file;
  Vec2 at{0.0f};
  float scale = 1.0f, rotation_deg = 0.0f;
  std::int32_t id = 0;      ///< 0: the next
  std::size_t species = 0;  ///< for its look
  std::shared_ptr<const SavedTree> tree;
};

struct CameraRecipe {
  std::string name;
  Vec3 eye{0.0f}, target{0.0f};  ///< east, north, metres above the ground there, or the datum
  float vertical_fov_deg = 40.0f;
  bool on_ground = true;  ///< false: heights are above the site's datum
};

/// The next ids and block of a document, where they are past what is in it.
struct CounterRecipe {
  std::int32_t tree = 1, standing = -1;
  std::uint64_t block = 1;
};

struct Recipe {
  std::filesystem::path file;
  Vec2 size_m{0.0f};         ///< (0, 0): the site is as large as its boundary or its elevation
  scene::Document document;  ///< species and settings; ground and trees come with build_document
  GroundRecipe ground;
  int layers = 0;  ///< of the crown space, when given in place of layer_m
  std::vector<distribution::Interaction> interactions;
  std::vector<PlantingRecipe> plantings;
  std::vector<ObstacleRecipe> obstacles;
  std::vector<HeroRecipe> heroes;
  std::vector<CameraRecipe> cameras;
  std::vector<scene::Figure> figures;
  CounterRecipe counters;
  FromWorldFile underlay_from_world_file{false, false};  ///< what the recipe leaves to it
};

/// Reads and checks a recipe. `seed` replaces the recipe's own when given.
Result<Recipe> read_recipe(const std::filesystem::path& file, std::optional<std::uint64_t> seed = {});

/// The same from text; relative files in it are looked for beside `file`.
Result<Recipe> parse_recipe(std::string_view text, const std::filesystem::path& file,
                            std::optional<std::uint64_t> seed = {});

struct BuiltRecipe {
  scene::Document document;
  scene::Seconds seconds;  ///< "terrain", "distribution"
  std::vector<std::string> warnings;
};

/// Makes the ground and plants the trees.
Result<BuiltRecipe> build_document(const Recipe& recipe, Progress* progress = nullptr);

}  // namespace bosquet::exchange
