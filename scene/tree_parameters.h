// Tree parameters: growth parameters of one tree, which are its species' but for what was changed for it alone.
//
// Model     a tree keeps only what differs, by described key ("growth." and the name in species files), so that a change
//           of the species reaches every tree in all that was not changed for it
// Decision  tables of phases and orders stay the species'
// Errors    unknown keys, values of a wrong kind, and what growth::check refuses, in one message
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "growth/parameters.h"
#include "scene/tree.h"

namespace bosquet::scene {

/// The species' parameters with a tree's own; `what` names the tree in messages.
Result<growth::Parameters> with_overrides(const growth::Parameters& species,
                                          const SharedList<ParameterOverride>& overrides,
                                          std::string_view what = "tree");

/// What `edited` has that is not as in `species`, in the order in which parameters are described.
SharedList<ParameterOverride> overrides_between(const growth::Parameters& species, const growth::Parameters& edited);

}  // namespace bosquet::scene
