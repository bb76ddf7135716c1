// Edits of trees: functions from a document to the document after them, with a name for the history.
//
// Model     an edit shares with the document before it all that it does not change; nothing else happens: what is grown
//           follows from the document (pipeline.h). Planting is in planting_edits.h, ground and buildings in
//           site_edits.h, species and settings in settings_edits.h
// Decision  what cannot be done to single trees is no error: locked trees, and those that would leave the site, stay as
//           they are and stand in `skipped`. Trees may be set on exclusions, into water and under buildings; they are in
//           `displaced`, so that a window can show them
// Decision  a selection that names trees which are gone is taken without them, so that it may be older than the document
// Frame     plan (east, north) metres
// Errors    numbers that are not allowed, as one message; then nothing is changed
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::scene {

/// A document after an edit.
struct Edited {
  Document document;
  std::string name;                     ///< "Plant 34 trees"
  std::vector<std::int32_t> trees;      ///< added, changed or taken away, by rising id
  std::vector<std::int32_t> skipped;    ///< asked for, but locked or left on the site, by rising id
  std::vector<std::int32_t> displaced;  ///< of the document's trees: off the ground that trees may stand on since now
  std::vector<std::string> notes;       ///< what was left out, and why
};

/// Ids of trees, in any order.
using Selection = std::span<const std::int32_t>;

Edited remove_trees(const Document& document, Selection trees);

/// Moves all by the same way.
Result<Edited> move_trees(const Document& document, Selection trees, Vec2 by);

/// Multiplies heights and widths, each kept within kLeastTreeScale and kMostTreeScale; a measured trunk goes with the
/// width.
Result<Edited> scale_trees(const Document& document, Selection trees, float height, float width);
inline constexpr float kLeastTreeScale = 0.02f, kMostTreeScale = 4.0f;

/// Locked trees are neither moved, erased, nor changed in any other way, until they are unlocked.
Edited lock_trees(const Document& document, Selection trees, bool locked);

/// Sizes stay as they are in metres when they were measured, else as shares of the mature size. Parameters of their own
/// and studio edits, which belong to the old species, go.
Result<Edited> replace_species(const Document& document, Selection trees, std::size_t species);

Edited set_status(const Document& document, Selection trees, TreeStatus status);

/// Gives trees parameters of their own in place of those they had (tree_parameters.h).
Result<Edited> set_overrides(const Document& document, Selection trees, SharedList<ParameterOverride> overrides);

/// Gives a tree its studio edits in place of those it had.
Edited set_studio_edits(const Document& document, std::int32_t tree, SharedList<std::string> operations);

/// Puts a tree as it is grown now in place of the one that grows.
Result<Edited> keep_as_hero(const Document& document, std::int32_t tree,
                            std::shared_ptr<const growth::Skeleton> skeleton, std::string name);

/// Any change to the selected trees but their ids and keys; `name` has "{}" for "3 trees" or "a tree".
Edited change_trees(const Document& document, Selection trees, std::string_view name,
                    const std::function<void(Tree&)>& change);

/// Trees, by rising id, that stand on an exclusion, under water or inside a building with an outline.
std::vector<std::int32_t> displaced_trees(const Document& document);

/// "a tree", "34 trees".
std::string trees_in_words(std::size_t count);

}  // namespace bosquet::scene
