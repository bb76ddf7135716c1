// Plan symbols: how trees look on a plan: the outline of a crown as it grew, and a pattern for each species.
//
// Frame     plan metres (east, north)
// Decision  an outline is a radius by direction about the crown's middle, so that a pattern is one more factor on it
// Cost      one pass over the tree's internodes
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec.h"
#include "exchange/plan_drawing.h"
#include "scene/document.h"
#include "scene/grown_scene.h"

namespace bosquet::exchange {

struct CrownOutline {
  static constexpr std::size_t kDirections = 32;  ///< from east, counter-clockwise
  DVec2 middle{0.0};                              ///< from the base
  std::array<double, kDirections> radius{};

  double mean() const;
};

/// As far as the crown reaches in each direction at the end of `season` (-1 the last), twigs' leaves not counted.
CrownOutline crown_outline(const growth::Skeleton& skeleton, int season);

/// A circle for a tree that nobody grew.
CrownOutline round_outline(double diameter_m);

/// The plan of a clipped form about its base: a rectangle or an ellipse.
std::vector<DVec2> form_outline(const crowns::ClippedForm& form);

enum class CrownPattern { plain, scalloped, lobed, wavy, spiny };

struct SpeciesSymbol {
  CrownPattern pattern = CrownPattern::plain;
  bool ring = false;    ///< a second line inside the outline
  bool spokes = false;  ///< short lines from the outline inward
  Vec3 tint{0.5f};
};

/// The symbol of the species at a place in the key. No two of the first forty are alike.
SpeciesSymbol species_symbol(const scene::Species& species, std::size_t place);

/// A crown about its base as lines on the ground: its closed outline first, then the lines inside it. `finest_m` is the
/// smallest feature that can be seen at the scale.
std::vector<std::vector<DVec2>> symbol_lines(const CrownOutline& crown, const SpeciesSymbol& symbol, DVec2 base,
                                             double finest_m);

/// Outlines joined into as few areas as possible (GEOS, by way of GDAL); rings of outsides and holes.
std::vector<std::vector<DVec2>> joined(const std::vector<std::vector<DVec2>>& outlines);

/// Short names for a key, from the botanical ones: "TC" for Tilia cordata; alike ones get more letters of the second word.
std::vector<std::string> species_codes(const std::vector<std::string>& botanical_names);

}  // namespace bosquet::exchange
