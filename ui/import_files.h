// Import: ground, trees and buildings of somebody else's files as edits of the document that is open.
//
// Model     ground is resampled to the site, a raster that says nothing of where it lies from the site's corner on; trees
//           and outlines are put where their coordinates say, in the site's reference system where it has one; a mesh
//           stands with its origin on the ground at the site's south-west corner; a plan picture lies where its world file
//           says, or is as wide as the site
// Frame     plan (east, north) metres
// Errors    those of the readers in exchange/, naming the file; the document stays as it was
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/edits.h"
#include "ui/tools/tool_settings.h"

namespace bosquet::ui {

enum class ImportKind { ground, trees, buildings, underlay };

/// Endings of the files that each kind reads.
std::vector<std::string> import_endings(ImportKind kind);

/// What came with the file, and what was left out, stands in the edit's notes.
Result<scene::Edited> import_file(const scene::Document& document, ImportKind kind, const std::filesystem::path& file);

/// A saved tree to be set on the site; its species is the document's of that name, else the built-in one.
Result<HeroInHand> read_hero(const scene::Document& document, const std::filesystem::path& file);

/// What is said of an import: what came, how many trees it displaced, its first notes and how many more there are.
std::string import_words(const scene::Edited& edit, const std::filesystem::path& file);

/// As many of them as are said at once, a line each, and how many more there are.
std::string first_lines(const std::vector<std::string>& notes);

}  // namespace bosquet::ui
