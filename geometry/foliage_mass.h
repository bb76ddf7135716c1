// Foliage mass: what the cards of far trees show, many small leafed twigs in place of one large one.
//
// Model     the upper cells of a leaf atlas are painted again as a ragged mass of that cell's twigs, each kTwigScale as
//           large, the ones behind darker. A card that stands for some ten to fifty twig clusters then shows leaves
//           of about their true size, where the leaf atlas would show giant ones
// Decision  twigs of hanging whips (strings) are put on one another along a few strands that run from the card's foot to
//           its tip, with daylight between them: a mass that points to all sides would make lumps of a weeping crown
// Decision  as many twigs as cover the card as the one twig does, in its mean colour: so leaf area and colour stay when
//           cards take the place of clusters
// Layout    that of leaf_atlas.h at half its pixels, so that the same uv coordinates serve; the lower cells are empty
// Holds     a pure function of its arguments, the same bits for any build and x86-64 CPU
// Cost      about 0.06 s for 1024 x 1024 on one core
#pragma once

#include <cstdint>

#include "geometry/leaf_atlas.h"

namespace bosquet::geometry {

inline constexpr float kTwigScale = 0.24f;

/// `leaves` is an atlas of make_leaf_atlas. The normal map stays empty: a mass is shaded by the card's own normals.
LeafAtlas make_foliage_mass(const LeafAtlas& leaves, ClusterForm form, std::uint64_t seed);

}  // namespace bosquet::geometry
