// Self-thinning: an area filled with seedlings that grow into each other until the strong ones are left.
//
// Source    Deussen et al. 1998, "Realistic modeling and rendering of plant ecosystems", section 4.2 (self-thinning: plants
//           are circles that grow; where two meet, the smaller is dominated and dies)
// Model     every year seedlings may come up at random, and each tree's circle has the radius
//             r = crowding * S * R,   S = S_final * (1 - exp(-g age))^p
//           with R the crown radius of its species in the open and S_final drawn for it. Then, from the largest tree to the
//           smallest (ties by key), a tree dies whose circle meets that of a larger one that lives; so does
//           one that has reached its lifespan, drawn for it within a fifth of the rules'
// Decision  crowding is 0.4 unless told: oaks of 25 m have crowns 6 m wide in closed stands, 16 m in the open; of oaks and
//           birches sown together it leaves some 190 on a hectare after 90 years
// Decision  trees that stood there before keep their room: whatever meets their circles dies
// Decision  ground, slope, altitude, barriers, density and spacing count as in sowing; the kernels' fields do not, the
//           circles take their part
// Holds     no two circles of the trees left meet; without regeneration numbers fall as sizes rise, the mean volume about as
//           the number to the power -3/2 (Yoda et al. 1963) once circles meet. A seedling's numbers hang on
//           its key alone, and running for fewer years gives the same stand as it was then
// Units     metres, years, hectares
// Cost      a sort of the living and their neighbours a year: 10,000 seedlings over 60 years some 0.05 s
#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/progress.h"
#include "distribution/planting.h"
#include "distribution/region.h"
#include "distribution/sowing.h"

namespace bosquet::distribution {

struct ThinningRules {
  float seedlings_per_ha = 2500.0f;
  float regeneration_per_ha = 50.0f;
  int years = 60;
  float lifespan_years = 300.0f;
  float crowding = 0.4f;
  float least_scale = 0.1f;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, ThinningRules>
void describe(P& p, Visitor& visit) {
  visit(Real{"seedlings_per_ha", "trees/ha", 0, 1e5, "Seedlings in the first year"}, p.seedlings_per_ha);
  visit(Real{"regeneration_per_ha", "trees/ha/year", 0, 1e4, "Seedlings in every later year; 0 makes trees of one age"},
        p.regeneration_per_ha);
  visit(Whole{"years", 1, 1000, "How long they grow"}, p.years);
  visit(Real{"lifespan_years", "years", 5, 5000, "Age at which trees die and leave a gap, within a fifth"},
        p.lifespan_years);
  visit(Real{"crowding", "", 0.1, 1,
             "Width at which a tree bears no larger neighbour, as a share of its crown's in the open"},
        p.crowding);
  visit(Real{"least_scale", "", 0.02, 1,
             "Trees smaller than this, as a share of the mature size, are left out in the end"},
        p.least_scale);
}

/// How large a species' crown is in the open at scale 1, and how its size rises: (1 - exp(-rate age))^shape.
struct Stature {
  float crown_radius_m = 4.0f;
  float rate = 0.03f, shape = 1.5f;
};

/// More seedlings than this, over all years, are an error of the caller's.
inline constexpr double kMostSeedlings = 20e6;
double seedlings_in_all(const Region& where, const ThinningRules& rules);

struct Thinned {
  std::vector<StandingTree> trees;      ///< left in the end, by rising number; they stand in the planting now
  std::vector<int> ages;                ///< of each, years
  std::size_t seedlings = 0;            ///< that found ground
  std::size_t dominated = 0, aged = 0;  ///< of them, died
  bool cancelled = false;
};

/// Fills a region. `statures` has one entry for each of the planting's species.
Thinned fill_by_thinning(Planting& planting, const Sowing& what, const Region& where, const ThinningRules& rules,
                         std::span<const Stature> statures, Progress* progress = nullptr);

}  // namespace bosquet::distribution
