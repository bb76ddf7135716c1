// Tree file: one grown tree saved as NAME.tree.json, to be set into other sites as a hero tree.
//
// Format    JSON: "bosquet_tree" 1, "species", "key" and "seed" (texts, as JSON numbers hold 53 bits), "size" (what it
//           grew with), "growth" (its species' parameters then, for the reader), "skeleton" with an array for each field of
//           growth/skeleton.h, positions as x, y, z in turn
// Frame     tree frame, metres
// Holds     a tree read back has the bits of the one that was written
// Errors    no such file, too large or too deep, arrays of different lengths, parents that do not come first, numbers
//           that are none, by file and field
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.h"
#include "growth/parameters.h"
#include "growth/skeleton.h"

namespace bosquet::exchange {

struct SavedTree {
  std::string species;
  std::uint64_t seed = 0, key = 0;
  float scale_height = 1.0f, scale_width = 1.0f;
  growth::Skeleton skeleton;
};

/// Writes beside `path` and renames into place; returns the bytes written.
Result<std::uint64_t> write_tree(const SavedTree& tree, const growth::Parameters& growth,
                                 const std::filesystem::path& path);

Result<SavedTree> read_tree(const std::filesystem::path& path);

}  // namespace bosquet::exchange
