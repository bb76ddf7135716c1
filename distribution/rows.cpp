#include "distribution/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr float kSharpestMitre = 0.25f;  // a corner's offset point goes at most twice the offset away

Vec2 unit_or_zero(Vec2 v) {
  const float length = std::sqrt(v.x * v.x + v.y * v.y);
  return length > 0.0f ? v / length : Vec2{0.0f};
}

std::vector<Vec2> without_repeats(std::span<const Vec2> line) {
  std::vector<Vec2> out;
  for (const Vec2 p : line)
    if (out.empty() || p != out.back()) out.push_back(p);
  return out;
}

// The line moved to its left by `offset`, corners mitred.
std::vector<Vec2> offset_line(const std::vector<Vec2>& line, float offset) {
  if (offset == 0.0f) return line;
  std::vector<Vec2> out(line.size());
  for (std::size_t n = 0; n < line.size(); ++n) {
    const Vec2 in = unit_or_zero(n > 0 ? line[n] - line[n - 1] : line[1] - line[0]);
    const Vec2 on = unit_or_zero(n + 1 < line.size() ? line[n + 1] - line[n] : line[n] - line[n - 1]);
    const Vec2 left_in{-in.y, in.x}, left_on{-on.y, on.x};
    const float half = std::max(0.5f * (1.0f + left_in.x * left_on.x + left_in.y * left_on.y), kSharpestMitre);
    out[n] = line[n] + 0.5f * (left_in + left_on) * (offset / half);
  }
  return out;
}

void walk(const std::vector<Vec2>& line, float begin, float spacing, std::vector<Vec2>& places) {
  double next = begin, so_far = 0.0;  // along the line
  std::size_t planted = 0;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const Vec2 d = line[n] - line[n - 1];
    const double length = std::sqrt(static_cast<double>(d.x) * d.x + static_cast<double>(d.y) * d.y);
    // A tree due within a thousandth of the spacing past the end still stands.
    const double slack = n + 1 == line.size() ? 1e-3 * spacing : 0.0;
    for (; next <= so_far + length + slack; next = begin + static_cast<double>(++planted) * spacing)
      places.push_back(line[n - 1] + d * static_cast<float>((next - so_far) / length));
    so_far += length;
  }
}

Error too_many(double count) {
  return Error{fmt::format("the pattern would hold some {:.0f} trees; {} are allowed", count, kMostPlaces)};
}

}  // namespace

Result<std::vector<Vec2>> row_places(std::span<const Vec2> points, const RowRules& rules) {
  const std::vector<Vec2> line = without_repeats(points);
  if (line.size() < 2) return Error{"a row needs at least two different points"};
  std::vector<Vec2> places;
  assert(rules.spacing_m > 0.0f && rules.rows > 0);
  double length = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) length += glm::distance(line[n - 1], line[n]);
  const int sides = rules.sides == RowSides::both ? 2 : 1;
  const double about = (length / rules.spacing_m + 1.0) * rules.rows * sides;
  if (about > static_cast<double>(kMostPlaces)) return too_many(about);

  int row = 0;
  const auto add_row = [&](float to_the_left) {
    const bool later = rules.staggered && row++ % 2 == 1;
    walk(offset_line(line, to_the_left), later ? 0.5f * rules.spacing_m : 0.0f, rules.spacing_m, places);
  };
  for (int r = 0; r < rules.rows; ++r) {
    const float beside = rules.offset_m + static_cast<float>(r) * rules.row_gap_m;
    switch (rules.sides) {
      case RowSides::on_line:
        add_row((static_cast<float>(r) - 0.5f * static_cast<float>(rules.rows - 1)) * rules.row_gap_m);
        break;
      case RowSides::left:
        add_row(beside);
        break;
      case RowSides::right:
        add_row(-beside);
        break;
      case RowSides::both:
        add_row(beside);
        add_row(-beside);
    }
  }
  return places;
}

Result<std::vector<Vec2>> grid_places(const Region& region, const GridRules& rules) {
  assert(rules.spacing_m > 0.0f && rules.row_gap_m > 0.0f);
  std::vector<Vec2> places;
  const Box2 box = bounds(region);
  if (box.empty()) return places;
  const Vec2 half = 0.5f * box.size();
  const float reach = std::sqrt(half.x * half.x + half.y * half.y);  // of the grid, before it is cut
  const double about = 4.0 * reach * reach / rules.spacing_m / rules.row_gap_m;
  if (about > 4.0 * static_cast<double>(kMostPlaces)) return too_many(about);

  // An unturned grid begins in the corner of the bounds; a turned one has a tree in their middle.
  const bool turned = rules.rotation_deg != 0.0f;
  const SinCos turn = sin_cos(radians(rules.rotation_deg));
  const Vec2 origin = turned ? box.centre() : box.low;
  const auto last = [&](float length, float step) { return static_cast<int>(length / step + 1e-3f); };
  const int rows = last(turned ? reach : box.size().y, rules.row_gap_m);
  const int columns = last(turned ? reach : box.size().x, rules.spacing_m) + (rules.staggered && turned ? 1 : 0);
  for (int j = turned ? -rows : 0; j <= rows; ++j)
    for (int i = turned ? -columns : 0; i <= columns; ++i) {
      const float later = rules.staggered && j % 2 != 0 ? 0.5f : 0.0f;
      const float x = (static_cast<float>(i) + later) * rules.spacing_m, y = static_cast<float>(j) * rules.row_gap_m;
      const Vec2 at =
          turned ? origin + Vec2{x * turn.cos - y * turn.sin, x * turn.sin + y * turn.cos} : origin + Vec2{x, y};
      if (contains(region, at)) places.push_back(at);
    }
  if (places.size() > kMostPlaces) return too_many(static_cast<double>(places.size()));
  return places;
}

Planted plant_at(Planting& planting, const Sowing& what, std::span<const Vec2> places, float jitter_m) {
  Planted planted;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const std::uint64_t key = tree_key(what.block, what.first_index + n);
    RandomStream stream(what.seed, key, Purpose::planting);
    Vec2 at = places[n];
    if (jitter_m > 0.0f) {
      const float radius = jitter_m * std::sqrt(stream.uniform());
      const SinCos turn = sin_cos(2.0f * kPi * stream.uniform());
      at += radius * Vec2{turn.cos, turn.sin};
    }
    const auto type = draw_type(planting, what, key, {});
    if (!type) break;  // an empty mix plants nothing
    const StandingTree tree = standing_tree(key, what.mix[*type].species, planting.species()[what.mix[*type].species],
                                            at, draw_scale(planting, what, key, *type));
    const Refusal why = planting.refusal_by_hand(tree);
    if (why == Refusal::none) {
      planting.add(tree);
      planted.trees.push_back(tree);
    } else {
      planted.left_out.push_back({n, at, why});
    }
  }
  return planted;
}

Refusal plant_one(Planting& planting, std::uint64_t key, std::uint32_t species, Vec2 at, float scale) {
  const StandingTree tree = standing_tree(key, species, planting.species()[species], at, scale);
  const Refusal why = planting.refusal_by_hand(tree);
  if (why == Refusal::none) planting.add(tree);
  return why;
}

}  // namespace bosquet::distribution
