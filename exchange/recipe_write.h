// Recipe writer: a document as a recipe with its data files beside it, so that it can be read, kept under version control
// and changed by hand.
//
// Files     NAME.toml, and in the folder NAME-files: trees.csv (every tree with its id and key), ground.tif and map.tif
//           (ground_rasters.h), a .toml for each species, obstacles as .obj, hero trees as .tree.json. An underlay stays
//           where it is and is named by the way from the recipe to it
// Holds     the recipe makes a document with the same digests (scene/document_digest.h), and with them the same skeletons,
//           if there is no warning
// Warned    two species of one name, a reference system that no recipe takes, interactions with unknown species, a ground
//           with cells of another width than a recipe's
// Errors    a file that cannot be written, by name
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::exchange {

struct WrittenRecipe {
  std::uint64_t bytes = 0;  ///< of the recipe and its files
  std::vector<std::string> warnings;
};

Result<WrittenRecipe> write_recipe(const scene::Document& document, const std::filesystem::path& target);

/// The trees of a recipe's table (planting kind "trees"): a CSV with the columns id, species, key and what else a tree
/// has, as write_recipe makes it. Species are found by name among `species`.
Result<std::vector<scene::Tree>> read_exact_trees(const std::filesystem::path& file,
                                                  const std::vector<std::shared_ptr<const scene::Species>>& species);

}  // namespace bosquet::exchange
