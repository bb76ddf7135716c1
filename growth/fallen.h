// Fallen: a tree without the wood that fell from it.
//
// Decision  what only shows a finished tree has no use for fallen wood, two fifths of a forest's internodes; radii, which
//           that wood went on to thicken, are kept as they were solved
// Holds     meshes are the same bits: every internode keeps the number that its leaves are drawn by
// Units     as skeleton.h
#pragma once

#include "growth/skeleton.h"

namespace bosquet::growth {

/// The standing wood of a skeleton with its radii solved. Earlier seasons and other radii cannot be told from it.
Skeleton without_fallen(const Skeleton& skeleton);

}  // namespace bosquet::growth
