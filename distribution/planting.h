// Planting: the trees standing on a site and, for every species, where the next one may stand.
//
// Source    Longay 2014, 6.4 (deformation kernels, masks by terrain)
// Decision  the field proposes, the exact rule disposes: cells are coarse, so each proposed position is checked against
//           the distance to every tree (least_distance_m), the terrain and the species' rules
// Holds     fields are a function of terrain, rules and the trees standing: after any adding, removing and moving they
//           equal, bit for bit, fields made anew from those trees
// Cost      a species' field is made when it is first drawn from; n x n cells take 11 to 13 n^2 bytes for each
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "distribution/barriers.h"
#include "distribution/kernels.h"
#include "distribution/probability_field.h"
#include "distribution/region.h"
#include "distribution/species.h"
#include "distribution/tree_index.h"
#include "terrain/terrain.h"

namespace bosquet::distribution {

/// Why a tree is not planted somewhere.
enum class Refusal { none, outside_site, excluded, under_water, built_over, too_steep, too_low, too_high, too_near };

/// As in "left out: ...".
std::string_view words(Refusal refusal);

class Planting {
 public:
  /// `cell_m` of the fields; 0 chooses max(0.125 m, longest side / 1024). An interaction that names a species not in
  /// the list, two for the same pair, rules whose low exceeds their high, and two species of one name are errors.
  static Result<Planting> make(terrain::Terrain terrain, std::vector<Species> species,
                               std::span<const Interaction> interactions, float cell_m = 0.0f, Barriers barriers = {});

  /// Adds a tree as it is, asking no rule. Its key must be new.
  void add(const StandingTree& tree);
  /// False when no tree has the key.
  bool remove(std::uint64_t key);
  bool move(std::uint64_t key, Vec2 to);
  /// Another size, species or place for the tree of this key, asking no rule; false when no tree has it.
  bool replace(const StandingTree& tree);

  const StandingTree* find(std::uint64_t key) const;
  std::span<const StandingTree> trees() const { return trees_; }   ///< in no promised order
  std::vector<std::uint64_t> keys_in(const Region& region) const;  ///< sorted
  const std::vector<Species>& species() const { return species_; }
  std::optional<std::uint32_t> species_index(std::string_view name) const;
  std::uint64_t name_hash(std::uint32_t species) const { return name_hashes_[species]; }
  const terrain::Terrain& terrain() const { return terrain_; }

  /// Why `tree` may not stand where it does by its species' rules, or `none`. A standing tree of the same key is
  /// overlooked.
  Refusal refusal(const StandingTree& tree) const;

  /// The same for a place that somebody chose: only the site's edge, exclusions, water, barriers and
  /// other trunks count.
  Refusal refusal_by_hand(const StandingTree& tree) const;

  /// The field of a species, made when first asked for.
  ProbabilityField& field(std::uint32_t species);

  float field_cell_m() const { return cell_m_; }

 private:
  Planting() = default;
  struct Pair {
    bool acts = false;
    float active_radius_m = 0.0f;
    KernelTable log2_kernel{};
  };
  bool too_near(const StandingTree& tree, bool trunks_only) const;
  bool may_be_wet() const;
  Refusal refusal_by_ground(const StandingTree& tree) const;
  Stamp stamp(const StandingTree& tree, std::uint32_t on) const;
  const Pair& pair(std::uint32_t of, std::uint32_t on) const { return pairs_[of * species_.size() + on]; }
  std::vector<std::uint8_t> suitability(std::uint32_t species) const;

  terrain::Terrain terrain_;
  Barriers barriers_;
  std::vector<Species> species_;
  std::vector<Pair> pairs_;              // [of * species + on]
  std::vector<float> most_;              // of each species: largest factor that clustering makes in its field
  std::vector<float> steepest_allowed_;  // of each species: rise per metre
  std::vector<std::uint64_t> name_hashes_;
  float cell_m_ = 1.0f;
  IVec2 cells_{0};
  terrain::HeightRange heights_;
  bool some_excluded_ = false, some_thinned_ = false;      // anywhere on the site
  float steepest_ = 0.0f;                                  // no ground rises more per metre
  float widest_spacing_m_ = 0.0f, widest_trunk_m_ = 0.0f;  // of the trees ever added
  std::vector<StandingTree> trees_;
  std::unordered_map<std::uint64_t, std::uint32_t> slot_of_;  // key -> place in trees_
  TreeIndex index_;
  std::vector<std::optional<ProbabilityField>> fields_;
};

/// Keys of the trees that stand where a terrain now has an exclusion, water or no site, sorted.
std::vector<std::uint64_t> displaced(const terrain::Terrain& terrain, std::span<const StandingTree> trees);

}  // namespace bosquet::distribution
