// Rows: trees at places that somebody chose: one by one, in rows and avenues, grids and hedges.
//
// Model     a row follows a polyline at a constant offset (corners mitred) with constant spacing along that offset
//           line; jitter moves each tree uniformly within a disc. Grid rows run east, then the grid turns about the
//           middle of its region's bounds
// Decision  such trees are not drawn from fields and keep no species spacing (a hedge stands closer than a forest); a
//           place off the site, excluded, under water or on another trunk is left out and reported
// Frame     plan (east, north) metres; left and right as seen along the line
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "distribution/planting.h"
#include "distribution/region.h"
#include "distribution/sowing.h"

namespace bosquet::distribution {

enum class RowSides { on_line, left, right, both };
inline constexpr std::array<std::string_view, 4> kRowSidesNames{"on_line", "left", "right", "both"};

struct RowRules {
  float spacing_m = 8.0f;
  RowSides sides = RowSides::on_line;
  float offset_m = 4.0f;
  int rows = 1;
  float row_gap_m = 3.0f;
  bool staggered = false;
  float jitter_m = 0.0f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, RowRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"spacing_m", "m", 0.1, 1000, "Distance from tree to tree along a row"}, p.spacing_m);
  visit(Choice{"sides", kRowSidesNames, "Where rows stand: on the line, left or right of it, or on both sides"},
        p.sides);
  visit(Real{"offset_m", "m", 0, 1000, "Distance of the nearest rows from the line, unless they stand on it"},
        p.offset_m);
  visit(Whole{"rows", 1, 20, "Number of parallel rows on each side"}, p.rows);
  visit(Real{"row_gap_m", "m", 0.1, 1000, "Distance from row to row"}, p.row_gap_m);
  visit(Switch{"staggered", "Every second row begins half a spacing later"}, p.staggered);
  visit(Real{"jitter_m", "m", 0, 100, "Largest distance of a tree from its place in the row"}, p.jitter_m);
}

struct GridRules {
  float spacing_m = 8.0f;
  float row_gap_m = 8.0f;
  float rotation_deg = 0.0f;
  bool staggered = false;
  float jitter_m = 0.0f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, GridRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"spacing_m", "m", 0.1, 1000, "Distance from tree to tree along a row"}, p.spacing_m);
  visit(Real{"row_gap_m", "m", 0.1, 1000, "Distance from row to row"}, p.row_gap_m);
  visit(Real{"rotation_deg", "deg", -180, 180, "Turn of the grid, counter-clockwise seen from above"}, p.rotation_deg);
  visit(Switch{"staggered", "Every second row begins half a spacing later"}, p.staggered);
  visit(Real{"jitter_m", "m", 0, 100, "Largest distance of a tree from its place in the grid"}, p.jitter_m);
}

/// A hedge: two staggered rows, close together.
inline RowRules hedge_rules() {
  return {.spacing_m = 0.5f, .sides = RowSides::on_line, .rows = 2, .row_gap_m = 0.4f, .staggered = true};
}

struct LeftOut {
  std::size_t index = 0;  ///< of the place in the pattern
  Vec2 at{0.0f};
  Refusal why = Refusal::none;
};

struct Planted {
  std::vector<StandingTree> trees;  ///< planted, in order; they stand in the planting now
  std::vector<LeftOut> left_out;
};

/// Places of the rows along a polyline, jitter not yet applied. A line without two different points, and more places
/// than kMostPlaces, are errors.
inline constexpr std::size_t kMostPlaces = 1'000'000;
Result<std::vector<Vec2>> row_places(std::span<const Vec2> line, const RowRules& rules);

/// Places of a grid inside a region, jitter not yet applied. More than kMostPlaces are an error.
Result<std::vector<Vec2>> grid_places(const Region& region, const GridRules& rules);

/// Plants at given places: tree n of the block at places[n], its type drawn from the mix and its scale from the range.
Planted plant_at(Planting& planting, const Sowing& what, std::span<const Vec2> places, float jitter_m = 0.0f);

/// Plants one tree of a chosen species, place and scale, or says why not.
Refusal plant_one(Planting& planting, std::uint64_t key, std::uint32_t species, Vec2 at, float scale);

}  // namespace bosquet::distribution
