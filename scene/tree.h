// Tree: one tree of a document, as it was planted, painted or surveyed; what becomes of it is grown.
//
// Units     metres; plan (east, north) from the site's south-west corner
// Identity  `id` names it (nodes, grids, files) and is never reused; `key` feeds its random streams and settles ties, so
//           adding or removing one tree changes no other
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/vec.h"
#include "crowns/clipped_form.h"
#include "scene/shared_list.h"

namespace bosquet::scene {

/// What is to happen to it, as plans and schedules tell.
enum class TreeStatus { proposed, existing, to_remove, to_protect };
inline constexpr std::array<std::string_view, 4> kTreeStatusNames{"proposed", "existing", "to_remove", "protected"};

/// A number, switch or choice of its species that is another for one tree, by its described key: "growth.straightness".
struct ParameterOverride {
  std::string key;
  std::variant<double, bool, std::string> value;  ///< a choice by its name

  bool operator==(const ParameterOverride&) const = default;
};

struct Tree {
  std::int32_t id = 0;  ///< 1, 2, ...
  std::uint64_t key = 0;
  std::size_t species = 0;  ///< index into Document::species
  Vec2 at{0.0f};            ///< plan
  float scale_height = 1.0f, scale_width = 1.0f;
  std::optional<float> trunk_diameter_m;  ///< given at 1.3 m; missing: as thick as it grows
  float clear_stem_m = 0.0f;              ///< below it no branch grows
  crowns::ClippedForm form;               ///< that it is kept cut to
  bool measured = false;                  ///< the size is what it has today, not what it will have
  TreeStatus status = TreeStatus::proposed;
  std::string inventory_name;  ///< what an inventory called its kind
  std::string inventory_id;

  bool locked = false;                      ///< not to be moved, erased or otherwise changed
  SharedList<ParameterOverride> overrides;  ///< only what differs from the species, by key (tree_parameters.h)
  SharedList<std::string> studio_edits;     ///< recorded operations, in order, replayed after it has grown again

  bool operator==(const Tree&) const = default;
};

}  // namespace bosquet::scene
