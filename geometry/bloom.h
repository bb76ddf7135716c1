// Bloom: the flowers and the fruit that a species is known for, on its thin branches in their part of the year.
//
// Source    Longay 2014, C.1.3: an organ stands where p = r L^2 passes a threshold, r a hash of the position, L the
//           exposure there: blossom and fruit in the light, hardly any in the shade
// Decision  L is the rank of the exposure in its crown, 0..1: exposures of different trees and detail then mean the same
// Model     a leaf atlas (leaf_atlas.h) of a season with a bloom shows it in its first column, on a leafed twig and as
//           one bunch alone; the second column stays plain. A twig of the tree blooms when r L^2 > 1 - share
// Decision  flower and fruit are two Blooms of a species; should both be there in a season, the fruit is shown
// Units     mm; colours sRGB 0..1
#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "core/parameter.h"
#include "core/vec.h"
#include "geometry/season.h"

namespace bosquet::geometry {

enum class BloomForm {
  none,
  blossom,  ///< open flowers of five petals in loose bunches on stalks (cherry)
  corymb,   ///< flat heads of many small flowers or berries (rowan)
  tuft,     ///< small dense bunches sitting on the twig (maple and elm in flower, elm fruit)
  catkin,   ///< hanging tassels (hazel, birch, poplar, willow)
  balls,    ///< balls on strings (plane)
  keys,     ///< hanging bunches of winged pairs (maple)
  bracts,   ///< small heads hanging from a pale narrow leaf (lime)
  drupes,   ///< single fruit on stalks (cherry, olive)
  nuts,     ///< the same in cups (oak)
  cones,    ///< scaly cones (spruce, pine, cypress)
};
inline constexpr std::array<std::string_view, 11> kBloomFormNames{
    "none", "blossom", "corymb", "tuft", "catkin", "balls", "keys", "bracts", "drupes", "nuts", "cones"};

/// Length of a leaf on a twig that flowers before its leaves have unfolded, as a share of a spring leaf's.
inline constexpr float kFoldedLeaf = 0.42f;

struct Bloom {
  BloomForm form = BloomForm::none;
  Season from = Season::spring, to = Season::spring;
  Vec3 colour{0.95f, 0.94f, 0.9f};
  Vec3 heart{0.8f, 0.75f, 0.45f};
  float size_mm = 25.0f;
  int count = 4;
  int bunches = 4;
  float share = 0.5f;
  bool before_leaves = false;

  /// True when it is there in this season; the year goes round, so autumn to spring includes bare.
  bool shows(Season season) const {
    if (form == BloomForm::none) return false;
    return from <= to ? from <= season && season <= to : season >= from || season <= to;
  }
};

struct BloomNames {
  std::string_view form, from, to, colour, heart, size, count, bunches, share, before_leaves;
};
inline constexpr BloomNames kFlowerNames{"flower_form",         "flower_from",         "flower_to",    "flower_colour",
                                         "flower_heart_colour", "flower_mm",           "flower_count", "flower_bunches",
                                         "flower_share",        "flower_before_leaves"};
inline constexpr BloomNames kFruitNames{"fruit_form",         "fruit_from",         "fruit_to",    "fruit_colour",
                                        "fruit_heart_colour", "fruit_mm",           "fruit_count", "fruit_bunches",
                                        "fruit_share",        "fruit_before_leaves"};

template <class Parameters, class Visitor>
void describe_bloom(Parameters& p, Visitor& visit, const BloomNames& name) {
  visit(Choice{name.form, kBloomFormNames, "How flowers or fruit stand; none for none that are seen"}, p.form);
  visit(Choice{name.from, kSeasonNames, "First season in which they are seen"}, p.from);
  visit(Choice{name.to, kSeasonNames, "Last season in which they are seen"}, p.to);
  visit(Colour{name.colour, "Petals, berries, scales or keys"}, p.colour);
  visit(Colour{name.heart, "Middle of a flower, cup of an acorn, bract, edge of a scale"}, p.heart);
  visit(Real{name.size, "mm", 1, 300, "A flower, fruit or cone across or, hanging, long"}, p.size_mm);
  visit(Whole{name.count, 1, 200, "Flowers or fruit in a bunch"}, p.count);
  visit(Whole{name.bunches, 1, 40, "Bunches on a leafed twig"}, p.bunches);
  visit(Real{name.share, "", 0, 1, "Share of the brightest twigs that have them; r L^2 > 1 - share, so fewer in shade"},
        p.share);
  visit(Switch{name.before_leaves, "Leaves of such twigs are still folded"}, p.before_leaves);
}

}  // namespace bosquet::geometry
