// Recipe writer: a document as a recipe with its data files beside it, so that it can be read, kept under version control
// and changed by hand.
//
// Files     NAME.toml, and in the folder NAME-files: trees.csv (every tree with its id and key), ground.tif, a .toml for
//           each species, obstacles as .obj, hero trees as .tree.json
// Holds     the recipe makes the same skeletons as the document did (report key skeleton_digest)
// Left out  masks of planting density and of barred areas, covers and ponds, which no recipe tells by cells; the species
//           bar of brushes. What of them a document has stands in `warnings`
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
