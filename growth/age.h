// Age: how old a tree of a given height is, and the younger tree that it was.
//
// Model     H(t) = H_full * (1 - exp(-g t))^p  (Chapman-Richards), fitted to open-grown trees; H_full is where the
//           tree's own curve ends: its final height when it was planted to reach that, the species' mature height when
//           its present height was measured and it is still growing
// Units     years, metres; seasons count from 0
// Decision  seasons are not years: a tree of age t is drawn as it stood in the first season in which its height was at
//           least H(t)
// Decision  the curve never arrives, so a tree is as old as it takes to 95 % of H_full, at most; at that age and after it
//           is drawn whole. Time takes a tree back from what was grown, never forward
// Holds     season_at_age and age_at_height agree: a tree at its age is the whole tree, and at t < age it is t old
#pragma once

#include "growth/parameters.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

/// H(t) / H_full, in [0, 1).
float height_share_at_age(const Parameters& parameters, float years);

/// Age at which a tree has this share of its full height; for shares near 1 the age is cut at 1000 years.
float age_at_height_share(const Parameters& parameters, float share);

/// Age of a tree that is `height_m` high now.
float age_at_height(const Parameters& parameters, float full_height_m, float height_m);

/// The first season at whose end the tree was at least `height_m` high; the last season if it never was.
int season_at_height(const Skeleton& skeleton, float height_m);

/// The season that shows the tree at this age; `height_m` is the height it was grown to, its present one.
int season_at_age(const Parameters& parameters, const Skeleton& skeleton, float full_height_m, float height_m,
                  float years);

/// The tree as it stood at the end of `season`, as if growth had ended there: its wood, the wood that had fallen (which
/// goes on to thicken the rest) and its radii. Only deflected wood stands where it ended up, and light and vigor are
/// those of the last season.
Skeleton tree_at_season(const Skeleton& skeleton, int season);

}  // namespace bosquet::growth
