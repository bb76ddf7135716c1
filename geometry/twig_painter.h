// Twig painter: one cell of a leaf atlas, a leafed twig or a single leaf in the dress of a season.
//
// Model     a twig grows from the middle of the cell's bottom edge upward; its form says where side shoots and leaves
//           stand. What lies behind is painted first. Where a bloom (bloom.h) is given, its bunches spring from the
//           twig's nodes
// Frame     metres, as atlas_canvas.h
// Holds     a pure function of its arguments
#pragma once

#include <cstdint>

#include "geometry/atlas_canvas.h"
#include "geometry/look.h"

namespace bosquet::geometry {

/// What a cell shows.
enum class AtlasSubject { twig, leaf, bunch };

/// `cell` tells the variants apart; `bloom` may be none (nullptr) but for a bunch.
AtlasCanvas paint_cell(const LeafLook& leaf, Season season, const Bloom* bloom, AtlasSubject subject,
                       std::uint64_t seed, int cell, int pixels, float side_m);

/// The colour that goes on where nothing is painted at all.
Vec3 twig_albedo(const LeafLook& leaf);

}  // namespace bosquet::geometry
