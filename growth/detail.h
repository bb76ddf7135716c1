// Detail: the same tree in shorter or longer internodes.
//
// Decision  detail is how finely wood is drawn, not how it grows: markers, buds, light and shoots all act once an
//           internode, so a tree grown in other steps is another tree (at half the length crowns came out up to a
//           third wider, at twice the length some hardly branched). Every tree grows in steps of l, and its skeleton
//           is then told in l / detail
// Model     detail k >= 1: an internode becomes floor((i + 1) k) - floor(i k) pieces, i its place on its axis, along a
//           uniform Catmull-Rom curve through the nodes of the axis: nodes stay where they grew, bends become round.
//           detail k < 1: of every run of nodes with the same floor(i k) one stays, the tip of the axis or else the
//           one whose branches carry most wood; a branch that stood on another node moves to the nearest that stays
// Holds     at any detail: the tips of all axes stand where they grew, so height and crown width stay; the wood carries
//           the same pipes, so trunk and limbs are as thick; births and falls are kept; detail 1 is the tree itself
// Cost      two passes over the internodes
#pragma once

#include "growth/skeleton.h"

namespace bosquet::growth {

/// The skeleton, grown in whole internodes, at detail 0.25 to 4, with its radii.
Skeleton at_detail(const Skeleton& skeleton, float detail);

}  // namespace bosquet::growth
