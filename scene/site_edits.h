// Site edits: ground, water, areas without trees, buildings and hero trees.
//
// Model     trees keep their plan positions: they rise and sink with the ground
// Decision  trees that come to stand on an exclusion, in water or inside a building stay where they are and are listed in
//           `displaced`; with Displaced::remove those of them that are not locked are taken away in the same step
// Decision  hero trees follow the ground. An obstacle rises and sinks with it when more than half of the ground along its
//           foot does, by the median of what it does there: heaping earth against a house lifts no house, a hill raised
//           under it or real heights imported beneath it do. Its walls always go down to the ground where they did
// Frame     plan (east, north) metres; levels in metres, up
// Errors    what cannot be, by name
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene/edits.h"
#include "terrain/area.h"
#include "terrain/brush.h"
#include "terrain/pond.h"

namespace bosquet::scene {

enum class Displaced { stay, remove };

/// One stroke of a brush; its name says what it does.
Edited shape_ground(const Document& document, const terrain::Stroke& stroke, Displaced displaced = Displaced::stay);

/// A terrain made by other means, such as terrain::LiveStroke, in place of the document's; of equal size.
Edited set_ground(const Document& document, terrain::Terrain terrain, std::string name,
                  Displaced displaced = Displaced::stay);

Edited set_water_level(const Document& document, std::optional<float> level_m, Displaced displaced = Displaced::stay);

Edited exclude_area(const Document& document, const Polygon& polygon, const terrain::Area& area = {},
                    Displaced displaced = Displaced::stay);
Edited exclude_path(const Document& document, std::span<const Vec2> path, float width_m, const terrain::Area& area = {},
                    Displaced displaced = Displaced::stay);
Edited dig_pond(const Document& document, const std::string& name, const Polygon& outline, std::optional<float> level_m,
                const terrain::PondRules& rules = {}, Displaced displaced = Displaced::stay);

/// A building over an outline, `height_m` above the ground at it.
Result<Edited> add_building(const Document& document, std::string name, Polygon outline, float height_m,
                            Displaced displaced = Displaced::stay);
/// Any obstacle; its id is given here.
Result<Edited> add_obstacle(const Document& document, Obstacle obstacle, Displaced displaced = Displaced::stay);
Result<Edited> remove_obstacle(const Document& document, std::int32_t id);

/// A hero tree; its id is given here.
Result<Edited> add_hero(const Document& document, HeroTree hero);
/// Enlarges it and turns it about its foot, counter-clockwise seen from above.
Result<Edited> turn_hero(const Document& document, std::int32_t id, float scale, float rotation_deg);
Result<Edited> move_hero(const Document& document, std::int32_t id, Vec2 to);
Result<Edited> remove_hero(const Document& document, std::int32_t id);

/// An outline extruded between two heights.
Obstacle extruded_between(std::string name, Polygon outline, float low_y, float high_y);
/// An extruded outline from a little below the lowest ground at it up to `height_m` above the mean of the ground there.
Obstacle extruded(std::string name, Polygon outline, float height_m, const terrain::Terrain& ground);

}  // namespace bosquet::scene
