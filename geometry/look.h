// Look: how a species is dressed, its bark, leaves and twigs, through the year.
//
// Who       bark_texture.h and leaf_atlas.h paint from it; branch and foliage meshes take sizes and tints from it
// Files     the [look] table of a species; colours as "RRGGBB" sRGB, as seen in mid-tone daylight photographs
// Decision  leaf colours are darkened to kLeafAlbedo when painted: a photograph shows a leaf brighter than it reflects
// Decision  one bark texture serves a whole tree. It is painted in the brightest of the colours that trunk, branch and
//           twig have, channel by channel, and bark_tint() says by which linear factor (0..1, a vertex colour) it is
//           multiplied where the wood is so thick: a birch's twigs are brown, a willow's golden
// Units     as named; colours here are sRGB 0..1, what functions return is linear
#pragma once

#include <array>
#include <string_view>

#include "core/parameter.h"
#include "core/vec.h"
#include "geometry/bloom.h"
#include "geometry/season.h"

namespace bosquet::geometry {

enum class BarkForm {
  ridges,  ///< interlaced ridges and furrows (oak, willow)
  plates,  ///< large plates, layered (pine)
  paper,   ///< smooth paper with level lenticels and dark rhombs (birch, cherry)
  scales,  ///< small round scales with lifting edges (spruce)
  smooth,  ///< smooth with fine level wrinkles (beech)
  mosaic,  ///< flaked off in patches of three colours (plane)
  strips,  ///< long thin fibrous strips with frayed ends (cypress)
};
inline constexpr std::array<std::string_view, 7> kBarkFormNames{"ridges", "plates", "paper", "scales",
                                                                "smooth", "mosaic", "strips"};

enum class LeafOutline {
  pinnate_lobed,
  ovate_deltoid,
  lanceolate,
  elliptic,
  cordate,
  palmate,
  needle_spray,
  pinnate_compound,  ///< leaflets in pairs on a stalk, one at its end (rowan)
  scale_cord,        ///< scales pressed to thin round cords (cypress)
};
inline constexpr std::array<std::string_view, 9> kLeafOutlineNames{"pinnate_lobed", "ovate_deltoid",    "lanceolate",
                                                                   "elliptic",      "cordate",          "palmate",
                                                                   "needle_spray",  "pinnate_compound", "scale_cord"};

/// True for the leaves of conifers, which clothe a shoot instead of standing on it one by one.
constexpr bool is_needle(LeafOutline outline) {
  return outline == LeafOutline::needle_spray || outline == LeafOutline::scale_cord;
}

enum class LeafMargin {
  entire,
  fine_teeth,
  coarse_teeth,
  double_teeth,
  long_teeth,  ///< few, drawn out into threads (Norway maple)
};
inline constexpr std::array<std::string_view, 5> kLeafMarginNames{"entire", "fine_teeth", "coarse_teeth",
                                                                  "double_teeth", "long_teeth"};

enum class ClusterForm {
  tuft,       ///< leaves crowded at the shoot's end (oak)
  alternate,  ///< leaves left and right of a zigzag twig (birch, beech, elm)
  strings,    ///< several slender parallel shoots, leaves along them (weeping willow)
  spray,      ///< shoot with side shoots clothed in needles (spruce, cypress)
  opposite,   ///< leaves in pairs, side shoots too (maple, olive)
  brush,      ///< few shoots from one place, long needles all around their ends (pine)
};
inline constexpr std::array<std::string_view, 6> kClusterFormNames{"tuft",  "alternate", "strings",
                                                                   "spray", "opposite",  "brush"};

/// True for twigs that needles clothe.
constexpr bool bears_needles(ClusterForm form) { return form == ClusterForm::spray || form == ClusterForm::brush; }

/// sRGB colour from 0xRRGGBB.
constexpr Vec3 srgb(unsigned rgb) {
  return {static_cast<float>(rgb >> 16 & 255u) / 255.0f, static_cast<float>(rgb >> 8 & 255u) / 255.0f,
          static_cast<float>(rgb & 255u) / 255.0f};
}

struct BarkLook {
  BarkForm form = BarkForm::ridges;
  float tile_m = 0.6f;
  Vec3 colour = srgb(0x6B655A);
  Vec3 furrow_colour = srgb(0x3A352E);
  Vec3 mark_colour = srgb(0x8C8075);
  Vec3 patch_colour = srgb(0x2A2624);
  Vec3 young_colour = srgb(0x7E7C70);
  Vec3 base_colour = srgb(0x6B655A);
  float base_height_m = 0.0f;
  float young_diameter_cm = 15.0f;
  float feature_width_cm = 3.0f;
  float feature_length_cm = 14.0f;
  float furrow_depth_cm = 2.0f;
  float criss_cross = 0.2f;
  float marks = 0.0f;
  float patches = 0.0f;
  float lichen = 0.0f;
};

template <class Parameters, class Visitor>
void describe_bark(Parameters& p, Visitor& visit) {
  visit(Choice{"bark_form", kBarkFormNames, "Build of the old bark"}, p.form);
  visit(Real{"bark_tile_m", "m", 0.2, 2, "Side of the piece of bark that the texture shows and repeats"}, p.tile_m);
  visit(Colour{"bark_colour", "Old bark: ridges, scales, paper or the first colour of a mosaic"}, p.colour);
  visit(Colour{"bark_furrow_colour", "Bottom of furrows and gaps between scales"}, p.furrow_colour);
  visit(Colour{"bark_mark_colour", "Lenticels, resin streaks, the second colour of a mosaic"}, p.mark_colour);
  visit(Colour{"bark_patch_colour", "Dark rhombs on paper bark, branch scars, the third colour of a mosaic"},
        p.patch_colour);
  visit(Colour{"bark_young_colour", "Bark of branches and young stems"}, p.young_colour);
  visit(Colour{"bark_base_colour", "Bark at the trunk's foot"}, p.base_colour);
  visit(Real{"bark_base_height_m", "m", 0, 20, "Height up to which the foot's colour reaches; 0 for none"},
        p.base_height_m);
  visit(Real{"bark_young_diameter_cm", "cm", 0.5, 100, "Thinner wood has young bark, twice as thick wood has old bark"},
        p.young_diameter_cm);
  visit(Real{"bark_feature_width_cm", "cm", 0.3, 30, "Width of a ridge, plate or scale, length of a lenticel"},
        p.feature_width_cm);
  visit(Real{"bark_feature_length_cm", "cm", 0.3, 60, "Length of a ridge or plate before it breaks, of a rhomb"},
        p.feature_length_cm);
  visit(Real{"bark_furrow_depth_cm", "cm", 0, 10, "Depth of furrows below the ridges"}, p.furrow_depth_cm);
  visit(Real{"bark_criss_cross", "", 0, 1, "Upright ridges (0) to a net of slanting ones (1)"}, p.criss_cross);
  visit(Real{"bark_marks", "", 0, 1, "How many lenticels or resin streaks"}, p.marks);
  visit(Real{"bark_patches", "", 0, 1, "How many dark rhombs or branch scars"}, p.patches);
  visit(Real{"bark_lichen", "", 0, 1, "How much of the bark is tinged by lichen and algae"}, p.lichen);
}

struct LeafLook {
  LeafOutline outline = LeafOutline::elliptic;
  LeafMargin margin = LeafMargin::entire;
  float length_mm = 80.0f;
  float width_mm = 45.0f;
  float petiole_mm = 10.0f;
  float widest = 0.5f;
  float point = 0.2f;
  int lobes = 4;
  float lobe_depth = 0.4f;
  int vein_pairs = 7;
  int needles_per_m = 1500;
  int fascicle = 1;
  float droop_deg = 25.0f;
  bool evergreen = false;
  Vec3 spring = srgb(0xA5C956);
  Vec3 summer = srgb(0x4F7030);
  Vec3 underside = srgb(0x86A068);
  Vec3 autumn = srgb(0xD9B23C);
  Vec3 autumn_late = srgb(0xA8742C);
  float colour_variation = 0.08f;
  float underside_share = 0.15f;
  float translucency = 0.35f;
  ClusterForm cluster = ClusterForm::alternate;
  float cluster_m = 0.3f;
  int cluster_leaves = 12;
  Vec3 twig_colour = srgb(0x6B5A46);
  Vec3 bud_colour = srgb(0x6B4A32);
  float twig_mm = 2.5f;
  Bloom flower, fruit;
};

template <class Parameters, class Visitor>
void describe_leaf(Parameters& p, Visitor& visit) {
  visit(Choice{"leaf_outline", kLeafOutlineNames, "Family of the leaf's outline"}, p.outline);
  visit(Choice{"leaf_margin", kLeafMarginNames, "Teeth along the edge"}, p.margin);
  visit(Real{"leaf_length_mm", "mm", 0.5, 500, "Length of the blade, of a needle or a scale"}, p.length_mm);
  visit(Real{"leaf_width_mm", "mm", 0.5, 400, "Greatest width of the blade, of a needle or of a cord with its scales"},
        p.width_mm);
  visit(Real{"leaf_petiole_mm", "mm", 0, 300, "Length of the stalk"}, p.petiole_mm);
  visit(Real{"leaf_widest", "", 0.1, 0.9, "Where the blade is widest: 0 at its base, 1 at its tip"}, p.widest);
  visit(Real{"leaf_point", "", 0, 0.5, "Share of the length that is drawn out into a point; 0 for a round tip"},
        p.point);
  visit(Whole{"leaf_lobes", 0, 9, "Lobes on each side, or of a palmate leaf in all; pairs of leaflets"}, p.lobes);
  visit(Real{"leaf_lobe_depth", "", 0, 0.9, "Depth of the bays between lobes as a share of the half width"},
        p.lobe_depth);
  visit(Whole{"leaf_vein_pairs", 0, 30, "Side veins on each side of the midrib"}, p.vein_pairs);
  visit(Whole{"leaf_needles_per_m", 50, 10000, "Needles, or bundles of them, on a metre of shoot"}, p.needles_per_m);
  visit(Whole{"leaf_fascicle", 1, 5, "Needles in a bundle"}, p.fascicle);
  visit(Real{"leaf_droop_deg", "deg", -90, 90, "Typical angle of the blade below level"}, p.droop_deg);
  visit(Switch{"leaf_evergreen", "Keeps its leaves in winter"}, p.evergreen);
  visit(Colour{"leaf_spring_colour", "Upper side of young leaves; tips of a conifer in spring"}, p.spring);
  visit(Colour{"leaf_summer_colour", "Upper side of grown leaves"}, p.summer);
  visit(Colour{"leaf_underside_colour", "Under side of grown leaves"}, p.underside);
  visit(Colour{"leaf_autumn_colour", "Leaves as they turn"}, p.autumn);
  visit(Colour{"leaf_autumn_late_colour", "Leaves just before they fall"}, p.autumn_late);
  visit(Real{"leaf_colour_variation", "", 0, 0.5, "Spread of brightness from leaf to leaf"}, p.colour_variation);
  visit(Real{"leaf_underside_share", "", 0, 1, "Share of the leaves of a twig that show their under side"},
        p.underside_share);
  visit(Real{"leaf_translucency", "", 0, 1, "Share of the light on the back that shines through"}, p.translucency);
  visit(Choice{"twig_form", kClusterFormNames, "How leaves stand on a twig"}, p.cluster);
  visit(Real{"twig_cluster_m", "m", 0.05, 2, "Side of the square that shows a whole leafed twig"}, p.cluster_m);
  visit(Whole{"twig_leaves", 3, 200, "Leaves of a whole twig, or side shoots of a needle spray"}, p.cluster_leaves);
  visit(Colour{"twig_colour", "Bark of the thinnest twigs"}, p.twig_colour);
  visit(Colour{"twig_bud_colour", "Winter buds"}, p.bud_colour);
  visit(Real{"twig_mm", "mm", 0.5, 20, "Diameter at the foot of a leafed twig"}, p.twig_mm);
  describe_bloom(p.flower, visit, kFlowerNames);
  describe_bloom(p.fruit, visit, kFruitNames);
}

struct Look {
  BarkLook bark;
  LeafLook leaf;
};

template <class Parameters, class Visitor>
void describe(Parameters& p, Visitor& visit) {
  describe_bark(p.bark, visit);
  describe_leaf(p.leaf, visit);
}

/// What a photographed leaf colour is multiplied by (linear) to be an albedo.
inline constexpr float kLeafAlbedo = 0.7f;

/// True when the tree bears leaves in this season; bare clusters show twigs and buds, bare single leaves nothing.
inline bool has_leaves(const LeafLook& leaf, Season season) { return leaf.evergreen || season != Season::bare; }

/// What flowers or fruits in this season; none: nullptr.
inline const Bloom* bloom_of(const LeafLook& leaf, Season season) {
  return leaf.fruit.shows(season) ? &leaf.fruit : leaf.flower.shows(season) ? &leaf.flower : nullptr;
}

/// The linear colour a bark texture is painted in: channel by channel the brightest of old, young, foot and twig.
Vec3 bark_reference(const Look& look);

/// Linear factor, each channel in 0..1, for the bark texture on wood of this diameter at this height above the tree's
/// base: twig colour below twice twig_mm, then young, then old bark; at the foot of thick trunks the foot's colour.
Vec3 bark_tint(const Look& look, float diameter_m, float height_m);

}  // namespace bosquet::geometry
