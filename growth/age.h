// Age: how old a tree of a given height is, and which season shows it.
//
// Model     H(t) = H_mature * (1 - exp(-g t))^p  (Chapman-Richards), fitted to open-grown trees
// Units     years, metres
// Decision  seasons are not years: a tree of age t is drawn as it stood in the first season in which its height was at
//           least H(t) / H_mature * h_max
#pragma once

#include "growth/parameters.h"
#include "growth/skeleton.h"

namespace bosquet::growth {

/// H(t) / H_mature, in [0, 1).
float height_share_at_age(const Parameters& parameters, float years);

/// Age at which a tree has this share of its final height; for shares near 1 the age is cut at 1000 years.
float age_at_height_share(const Parameters& parameters, float share);

/// The first season at whose end the tree was at least `height_m` high; the last season if it never was.
int season_at_height(const Skeleton& skeleton, float height_m);

}  // namespace bosquet::growth
