// Clipped growth: the parameters of a tree that is kept cut to a form.
//
// Model     whoever cuts the leading shoots off every year lifts the dominance of the tips: buds that would have slept
//           break, and none dies for want of vigor, as long as there is room in the form. Nothing is shed, for a clipped
//           tree is thick to its base, and branches turn level, into the sides of the form, whatever the habit of the
//           species is
// Decision  phases and orders of the species end with it: they tell how a free crown changes as it rises
// Decision  twigs are as many as fill the form evenly, whatever its size: the room around a node is a fixed share of it,
//           within what is a twig at all. Twigs are thinner as they are shorter
// Units     as in parameters.h; room in m3
#pragma once

#include "growth/parameters.h"

namespace bosquet::growth {

Parameters clipped(const Parameters& natural, float room_m3);

}  // namespace bosquet::growth
