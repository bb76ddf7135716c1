#include "distribution/planting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

using terrain::Terrain;

constexpr float kFinestCell_m = 0.125f;  // a quarter of a trunk: finer fields only cost
constexpr float kChosenCells = 1024.0f;  // along the longer side, unless a cell is asked for
constexpr float kBucket_m = 2.0f;        // of the tree index: a few trees each in a dense stand
constexpr float kMostBuckets = 1024.0f;  // along the longer side
constexpr float kAnySlope_deg = 89.0f;   // from here on the slope is no limit

float steepness(Vec2 gradient) { return std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y); }

float rise_of(float slope_deg) {
  const SinCos slope = sin_cos(radians(slope_deg));
  return slope.sin / slope.cos;
}

// An upper bound of the steepness anywhere: the largest differences between neighbouring samples.
float steepest(const terrain::Heightfield& height) {
  const IVec2 n = height.cells();
  float east = 0.0f, north = 0.0f;
  for (int j = 0; j <= n.y; ++j)
    for (int i = 0; i <= n.x; ++i) {
      const float h = height.sample(i, j);
      if (i < n.x) east = std::max(east, std::abs(height.sample(i + 1, j) - h));
      if (j < n.y) north = std::max(north, std::abs(height.sample(i, j + 1) - h));
    }
  return steepness(Vec2{east, north} / height.cell_m());
}

bool everywhere(const terrain::Mask& mask, std::uint8_t value) {
  const IVec2 size = mask.grid().size();
  for (int j = 0; j < size.y; ++j)
    for (int i = 0; i < size.x; ++i)
      if (mask.grid().at(i, j) != value) return false;
  return true;
}

}  // namespace

std::string_view words(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "planted";
    case Refusal::outside_site:
      return "outside the site";
    case Refusal::excluded:
      return "in an excluded area";
    case Refusal::under_water:
      return "under water";
    case Refusal::built_over:
      return "where something is built";
    case Refusal::too_steep:
      return "on too steep ground";
    case Refusal::too_low:
      return "on too low ground";
    case Refusal::too_high:
      return "on too high ground";
    case Refusal::too_near:
      return "too near to another tree";
  }
  return "";
}

Result<Planting> Planting::make(Terrain terrain, std::vector<Species> species,
                                std::span<const Interaction> interactions, float cell_m, Barriers barriers) {
  Planting p;
  p.terrain_ = std::move(terrain);
  p.barriers_ = std::move(barriers);
  p.species_ = std::move(species);
  const std::size_t count = p.species_.size();
  for (std::size_t n = 0; n < count; ++n) {
    const Species& s = p.species_[n];
    for (std::size_t other = 0; other < n; ++other)
      if (p.species_[other].name == s.name) return Error{fmt::format("two species are named '{}'", s.name)};
    if (s.rules.scale_min > s.rules.scale_max)
      return Error{fmt::format("species '{}': scale_min {} is above scale_max {}", s.name, s.rules.scale_min,
                               s.rules.scale_max)};
    if (s.rules.min_altitude_m > s.rules.max_altitude_m)
      return Error{fmt::format("species '{}': min_altitude_m {} is above max_altitude_m {}", s.name,
                               s.rules.min_altitude_m, s.rules.max_altitude_m)};
  }

  for (const Species& s : p.species_) {
    p.name_hashes_.push_back(hash_text(s.name));
    p.steepest_allowed_.push_back(s.rules.max_slope_deg < kAnySlope_deg ? rise_of(s.rules.max_slope_deg)
                                                                        : std::numeric_limits<float>::max());
  }
  p.most_.assign(count, 1.0f);
  p.pairs_.resize(count * count);
  for (const Interaction& interaction : interactions) {
    const auto of = p.species_index(interaction.of), on = p.species_index(interaction.on);
    if (!of || !on)
      return Error{fmt::format("an interaction of '{}' on '{}': no species is named '{}'", interaction.of,
                               interaction.on, of ? interaction.on : interaction.of)};
    Pair& pair = p.pairs_[*of * count + *on];
    if (pair.active_radius_m > 0.0f)
      return Error{fmt::format("two interactions of '{}' on '{}'", interaction.of, interaction.on)};
    pair.acts = interaction.kind != KernelKind::none && interaction.effect > 1.0f;
    pair.active_radius_m = interaction.active_radius_m;
    if (interaction.kind == KernelKind::clustering) p.most_[*on] = std::max(p.most_[*on], interaction.effect);
    if (pair.acts) pair.log2_kernel = log2_kernel_table(interaction.kind, interaction.effect);
  }

  const Vec2 size = p.terrain_.size_m();
  const float longest = std::max(size.x, size.y);
  const float wanted = cell_m > 0.0f ? cell_m : std::max(kFinestCell_m, longest / kChosenCells);
  p.cell_m_ = std::max(wanted, longest / kMostFieldCells);
  const auto cells = [&](float side) {
    const float n = side / p.cell_m_;
    const int whole = static_cast<int>(n);
    return std::clamp(n - static_cast<float>(whole) > 1e-4f * n ? whole + 1 : whole, 1, kMostFieldCells);
  };
  p.cells_ = {cells(size.x), cells(size.y)};
  p.index_ = TreeIndex(size, std::max(kBucket_m, longest / kMostBuckets));
  p.heights_ = p.terrain_.height.range();
  p.some_excluded_ = !everywhere(p.terrain_.exclusion, 0);
  p.some_thinned_ = !everywhere(p.terrain_.density, 255);
  p.steepest_ = steepest(p.terrain_.height);
  p.fields_.resize(count);
  return p;
}

std::optional<std::uint32_t> Planting::species_index(std::string_view name) const {
  for (std::size_t n = 0; n < species_.size(); ++n)
    if (species_[n].name == name) return static_cast<std::uint32_t>(n);
  return std::nullopt;
}

const StandingTree* Planting::find(std::uint64_t key) const {
  const auto found = slot_of_.find(key);
  return found == slot_of_.end() ? nullptr : &trees_[found->second];
}

Stamp Planting::stamp(const StandingTree& tree, std::uint32_t on) const {
  const Pair& p = pair(tree.species, on);
  const float spacing = std::max(tree.spacing_m, species_[on].rules.min_spacing_m);
  return {tree.at, tree.trunk_radius_m, p.active_radius_m, p.acts ? &p.log2_kernel : nullptr,
          std::max(spacing, tree.trunk_radius_m)};
}

void Planting::add(const StandingTree& tree) {
  assert(tree.species < species_.size());
  const auto slot = static_cast<std::uint32_t>(trees_.size());
  [[maybe_unused]] const bool is_new = slot_of_.emplace(tree.key, slot).second;
  assert(is_new);
  trees_.push_back(tree);
  index_.add(slot, tree.at);
  widest_spacing_m_ = std::max(widest_spacing_m_, tree.spacing_m);
  widest_trunk_m_ = std::max(widest_trunk_m_, tree.trunk_radius_m);
  for (std::uint32_t on = 0; on < fields_.size(); ++on)
    if (fields_[on]) fields_[on]->add(stamp(tree, on));
}

bool Planting::remove(std::uint64_t key) {
  const auto found = slot_of_.find(key);
  if (found == slot_of_.end()) return false;
  const std::uint32_t slot = found->second, last = static_cast<std::uint32_t>(trees_.size()) - 1;
  const StandingTree tree = trees_[slot];
  for (std::uint32_t on = 0; on < fields_.size(); ++on)
    if (fields_[on]) fields_[on]->remove(stamp(tree, on));
  index_.remove(slot, tree.at);
  slot_of_.erase(found);
  if (slot != last) {
    trees_[slot] = trees_[last];
    slot_of_[trees_[slot].key] = slot;
    index_.rename(last, slot, trees_[slot].at);
  }
  trees_.pop_back();
  return true;
}

bool Planting::move(std::uint64_t key, Vec2 to) {
  const StandingTree* standing = find(key);
  if (!standing) return false;
  StandingTree tree = *standing;
  tree.at = to;
  return replace(tree);
}

bool Planting::replace(const StandingTree& tree) {
  if (!remove(tree.key)) return false;
  add(tree);
  return true;
}

std::vector<std::uint64_t> Planting::keys_in(const Region& region) const {
  std::vector<std::uint64_t> keys;
  for (const StandingTree& tree : trees_)
    if (contains(region, tree.at)) keys.push_back(tree.key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

bool Planting::too_near(const StandingTree& tree, bool trunks_only) const {
  const float trunks = tree.trunk_radius_m + widest_trunk_m_;
  const float reach = trunks_only ? trunks : std::max({tree.spacing_m, widest_spacing_m_, trunks});
  return index_.any_near(tree.at, reach, [&](std::uint32_t slot) {
    const StandingTree& other = trees_[slot];
    if (other.key == tree.key) return false;
    const float least = trunks_only ? tree.trunk_radius_m + other.trunk_radius_m : least_distance_m(tree, other);
    const Vec2 d = other.at - tree.at;
    return d.x * d.x + d.y * d.y < least * least;
  });
}

bool Planting::may_be_wet() const {
  return terrain_.has_ponds() || (terrain_.water_level_m && heights_.low < *terrain_.water_level_m);
}

Refusal Planting::refusal_by_ground(const StandingTree& tree) const {
  const Vec2 at = tree.at;
  if (!terrain::on_site(terrain_, at)) return Refusal::outside_site;
  if (may_be_wet() && terrain_.under_water(at)) return Refusal::under_water;
  if (terrain_.excluded(at)) return Refusal::excluded;
  if (barriers_.holds(at, tree.trunk_radius_m)) return Refusal::built_over;
  return Refusal::none;
}

Refusal Planting::refusal_by_hand(const StandingTree& tree) const {
  const Refusal ground = refusal_by_ground(tree);
  if (ground != Refusal::none) return ground;
  return too_near(tree, true) ? Refusal::too_near : Refusal::none;
}

Refusal Planting::refusal(const StandingTree& tree) const {
  const Refusal ground = refusal_by_ground(tree);
  if (ground != Refusal::none) return ground;
  const PlantingRules& rules = species_[tree.species].rules;
  if (heights_.low < rules.min_altitude_m && terrain_.ground(tree.at) < rules.min_altitude_m) return Refusal::too_low;
  if (heights_.high > rules.max_altitude_m && terrain_.ground(tree.at) > rules.max_altitude_m) return Refusal::too_high;
  const float rise = steepest_allowed_[tree.species];
  if (steepest_ > rise && steepness(terrain_.height.gradient(tree.at)) > rise) return Refusal::too_steep;
  return too_near(tree, false) ? Refusal::too_near : Refusal::none;
}

std::vector<std::uint8_t> Planting::suitability(std::uint32_t species) const {
  const PlantingRules& rules = species_[species].rules;
  // What can be told for the whole site at once is not asked of every cell; none means: all suit fully.
  const bool water = may_be_wet();
  const bool low = heights_.low<rules.min_altitude_m, high = heights_.high> rules.max_altitude_m;
  const float rise = steepest_allowed_[species];
  const bool steep = steepest_ > rise;

  const bool last_on_site = terrain::on_site(terrain_, (Vec2(cells_) - 0.5f) * cell_m_);
  const bool exclusions = some_excluded_, thinned = some_thinned_, barred = !barriers_.empty();
  if (last_on_site && !water && !low && !high && !steep && !exclusions && !thinned && !barred) return {};

  const auto width = static_cast<std::size_t>(cells_.x);
  std::vector<std::uint8_t> suits(width * static_cast<std::size_t>(cells_.y), 255);
  parallel_for(static_cast<std::size_t>(cells_.y), [&](std::size_t j) {
    for (std::size_t i = 0; i < width; ++i) {
      const Vec2 at = (Vec2(i, j) + 0.5f) * cell_m_;
      std::uint8_t& suit = suits[j * width + i];
      if (!terrain::on_site(terrain_, at) || (exclusions && terrain_.excluded(at)) || (barred && barriers_.holds(at))) {
        suit = 0;
        continue;
      }
      if (water || low || high) {
        const float ground = terrain_.ground(at);
        if ((water && terrain_.under_water(at)) || ground < rules.min_altitude_m || ground > rules.max_altitude_m) {
          suit = 0;
          continue;
        }
      }
      if (steep && steepness(terrain_.height.gradient(at)) > rise) {
        suit = 0;
        continue;
      }
      if (thinned) suit = terrain::Mask::stored(terrain_.density.at(at));
    }
  });
  return suits;
}

ProbabilityField& Planting::field(std::uint32_t species) {
  assert(species < species_.size());
  std::optional<ProbabilityField>& field = fields_[species];
  if (!field) {
    field.emplace(cells_, cell_m_, suitability(species), most_[species]);
    for (const StandingTree& tree : trees_) field->add(stamp(tree, species));
  }
  return *field;
}

std::vector<std::uint64_t> displaced(const Terrain& terrain, std::span<const StandingTree> trees) {
  std::vector<std::uint64_t> keys;
  for (const StandingTree& tree : trees)
    if (!terrain::on_site(terrain, tree.at) || terrain.excluded(tree.at) || terrain.under_water(tree.at))
      keys.push_back(tree.key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace bosquet::distribution
