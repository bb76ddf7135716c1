// Standing edits: hero trees put on the site, and edits of selections that hold trees and hero trees alike.
//
// Model     ids above 0 are trees, those below 0 hero trees (scene/document.h)
// Frame     plan (east, north) metres
// Errors    those of scene/edits.h and scene/site_edits.h
#pragma once

#include <cstdint>
#include <span>

#include "scene/edits.h"
#include "ui/tools/tool_settings.h"

namespace bosquet::ui {

/// How far a hero tree's living wood reaches.
struct HeroExtent {
  float height_m = 0, radius_m = 0;
};
HeroExtent extent_of(const growth::Skeleton& skeleton);

const scene::HeroTree* find_hero(const scene::Document& document, std::int32_t id);

/// Sets a hero tree, turned counter-clockwise; its species joins the document's unless one of its name is there.
Result<scene::Edited> place_hero(const scene::Document& document, const HeroInHand& hero, Vec2 at, float turn_deg);

/// A hero tree that stands already, to be set again.
HeroInHand hero_in_hand(const scene::Document& document, const scene::HeroTree& hero);

Result<scene::Edited> move_selected(const scene::Document& document, std::span<const std::int32_t> ids, Vec2 by);
scene::Edited remove_selected(const scene::Document& document, std::span<const std::int32_t> ids);
Result<scene::Edited> scale_selected(const scene::Document& document, std::span<const std::int32_t> ids, float by);

}  // namespace bosquet::ui
