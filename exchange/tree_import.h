// Tree import: the trees of an inventory become trees of a document.
//
// Model     species by name (scene/species_names.h), with a user's synonyms before all others; sizes by
//           scene::set_measured_size, without any by age, without that drawn from the species' range; a narrow cultivar
//           whose crown nobody measured claims less width. Trees at one place are moved apart (distribution/inventory.h)
// Identity  a tree's key comes from the block's name and its number in the file, so that the same file gives the same trees
// Decision  surveyed trees are existing ones unless their row says otherwise
// Errors    those of read_inventory() and of the synonyms' file; nothing usable in the file
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "distribution/species.h"
#include "exchange/inventory.h"
#include "scene/document.h"
#include "scene/species_names.h"

namespace bosquet::exchange {

struct TreeImport {
  InventoryOptions reading;
  std::filesystem::path synonyms;        ///< CSV of name,species; may be empty
  std::string block;                     ///< names the planting, for keys; empty: the file's name
  std::string fallback = "english_oak";  ///< species of names that say nothing
  std::optional<Vec2> scale;             ///< smallest and largest where no size is given; missing: the species' own
  scene::TreeStatus status = scene::TreeStatus::existing;
};

/// Synonyms from a CSV file of two columns, a name and the species it means by any of its names; a header
/// "name,species" may come first.
Result<scene::Synonyms> read_synonyms(const std::filesystem::path& file,
                                      std::span<const std::shared_ptr<const scene::Species>> known);

/// What became of the rows of a file.
struct ImportTally {
  std::size_t trees = 0;      ///< that were added, with those that are moved or to be removed
  std::size_t left_out = 0;   ///< rows without a usable place
  std::size_t moved = 0;      ///< from a place where another tree stands
  std::size_t to_remove = 0;  ///< not grown
  std::size_t nameless = 0;   ///< of which nothing says what they are
  std::string drawn_as;       ///< the species that those are
};
/// "18 trees of 20 rows; 2 left out; 1 moved aside from another's place".
std::string words(const ImportTally& tally, bool features);

struct ImportedTrees {
  ImportTally tally;
  std::vector<scene::Tree> trees;                    ///< without ids
  std::vector<distribution::StandingTree> standing;  ///< the same trees
  std::optional<scene::Georeference> place;          ///< that the site gets, when it had none
  std::vector<std::string> warnings;
};

/// Reads the trees of a file for a site that is given in `import.reading`. `species` are those a name may mean; `fallback`
/// is an index among them. `others` already stand.
Result<ImportedTrees> read_trees(const std::filesystem::path& file, const TreeImport& import, std::uint64_t seed,
                                 std::span<const std::shared_ptr<const scene::Species>> species, std::size_t fallback,
                                 std::span<const distribution::StandingTree> others = {});

/// These and the built-in species that they lack: all that a name may mean.
Result<std::vector<std::shared_ptr<const scene::Species>>> species_to_name(
    std::vector<std::shared_ptr<const scene::Species>> own);

/// The site of whole metres around the crowns of trees whose plan counts from anywhere: its corner there, and its size.
std::pair<DVec2, DVec2> site_around(std::span<const InventoryTree> trees,
                                    std::span<const std::shared_ptr<const scene::Species>> species,
                                    std::size_t fallback, const scene::Synonyms* synonyms = nullptr);

struct ImportedDocument {
  scene::Document document;
  ImportTally tally;
  std::vector<std::string> warnings;
};

/// Adds the trees of a file to a document. One without ground becomes a flat site around the trees; the built-in species
/// that the trees need join those it has. Site and size in `import.reading` are the document's.
Result<ImportedDocument> import_trees(const scene::Document& document, const std::filesystem::path& file,
                                      TreeImport import = {});

}  // namespace bosquet::exchange
