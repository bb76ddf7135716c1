#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "core/parallel.h"
#include "geometry/atlas_blade.h"
#include "geometry/leaf_atlas.h"
#include "tests/geometry/texture_checks.h"
#include "tests/geometry/texture_looks.h"

namespace bosquet::geometry {
namespace {

constexpr int kAtlasSize = 512, kHalf = kAtlasSize / 2;
const std::vector<std::string> kSpecies{"english_oak", "silver_birch", "norway_spruce", "weeping_willow"};
// One of each family, twig form and bloom form.
const std::vector<std::string> kFamilies{"english_oak",       "silver_birch", "norway_spruce", "weeping_willow",
                                         "scots_pine",        "norway_maple", "rowan",         "italian_cypress",
                                         "small_leaved_lime", "wild_cherry",  "london_plane"};
const std::vector<Season> kSeasons{Season::spring, Season::summer, Season::autumn, Season::bare};

class Atlas : public testing::TestWithParam<std::tuple<std::string, Season>> {};
INSTANTIATE_TEST_SUITE_P(Species, Atlas, testing::Combine(testing::ValuesIn(kFamilies), testing::ValuesIn(kSeasons)),
                         [](const auto& both) {
                           return std::get<0>(both.param) + "_" +
                                  std::string(kSeasonNames[static_cast<std::size_t>(std::get<1>(both.param))]);
                         });

float alpha(const LeafAtlas& atlas, int x, int y) { return static_cast<float>(atlas.base_colour.at(x, y)[3]) / 255.0f; }

// Share of a cell that is opaque.
float coverage(const LeafAtlas& atlas, const AtlasCell& cell) {
  float sum = 0;
  const int x0 = static_cast<int>(cell.u0 * kAtlasSize), y0 = static_cast<int>(cell.v0 * kAtlasSize);
  for (int y = y0; y < y0 + kHalf; ++y) {
    for (int x = x0; x < x0 + kHalf; ++x) sum += alpha(atlas, x, y) >= 0.5f ? 1.0f : 0.0f;
  }
  return sum / (kHalf * kHalf);
}

// Mean colour of what is opaque in a cell.
Vec3 colour(const LeafAtlas& atlas, const AtlasCell& cell) {
  Vec3 sum{0.0f};
  float count = 0;
  const int x0 = static_cast<int>(cell.u0 * kAtlasSize), y0 = static_cast<int>(cell.v0 * kAtlasSize);
  for (int y = y0; y < y0 + kHalf; ++y) {
    for (int x = x0; x < x0 + kHalf; ++x) {
      if (alpha(atlas, x, y) >= 0.5f) sum += linear(atlas.base_colour.at(x, y)), count += 1;
    }
  }
  return sum / std::max(count, 1.0f);
}

TEST_P(Atlas, EachCellHasAClearMarginAndStartsAtTheMiddleOfItsBottomEdge) {
  const auto& [name, season] = GetParam();
  const LeafLook leaf = species_look(name).leaf;
  const LeafAtlas atlas = make_leaf_atlas(leaf, season, 7, kAtlasSize);
  const int margin = static_cast<int>(kAtlasMargin * kHalf);
  ASSERT_GE(margin, 2);
  for (int cell = 0; cell < 4; ++cell) {
    const int x0 = cell % 2 * kHalf, y0 = cell / 2 * kHalf;
    for (int i = 0; i < kHalf; ++i) {
      for (int m = 0; m < margin; ++m) {
        EXPECT_EQ(alpha(atlas, x0 + i, y0 + m), 0.0f);
        EXPECT_EQ(alpha(atlas, x0 + i, y0 + kHalf - 1 - m), 0.0f);
        EXPECT_EQ(alpha(atlas, x0 + m, y0 + i), 0.0f);
        EXPECT_EQ(alpha(atlas, x0 + kHalf - 1 - m, y0 + i), 0.0f);
      }
    }
    if (cell >= 2 && !has_leaves(leaf, season)) continue;
    // The lowest opaque row: a stalk or twig close to the middle.
    float sum = 0, weight = 0;
    for (int x = 0; x < kHalf; ++x) {
      const float a = alpha(atlas, x0 + x, y0 + kHalf - 1 - margin);
      sum += a * (static_cast<float>(x) + 0.5f), weight += a;
    }
    ASSERT_GT(weight, 0.5f) << "cell " << cell;
    EXPECT_NEAR(sum / weight, 0.5f * kHalf, 0.03f * kHalf) << "cell " << cell;
    EXPECT_LT(weight, 0.1f * kHalf) << "cell " << cell;
  }
}

TEST_P(Atlas, CoversASensibleShareOfEachCell) {
  const auto& [name, season] = GetParam();
  const LeafLook leaf = species_look(name).leaf;
  const LeafAtlas atlas = make_leaf_atlas(leaf, season, 7, kAtlasSize);
  for (int variant = 0; variant < 2; ++variant) {
    const float cluster = coverage(atlas, cluster_cell(variant)), single = coverage(atlas, leaf_cell(variant));
    if (variant == 0 && bloom_of(leaf, season)) {  // a bunch in place of a leaf
      EXPECT_GT(cluster, 0.01f);
      EXPECT_LT(cluster, 0.65f);
      EXPECT_GT(single, 0.05f);
      EXPECT_LT(single, 0.75f);
      continue;
    }
    if (has_leaves(leaf, season)) {
      EXPECT_GT(cluster, 0.12f);  // the airiest, willow whips, about a seventh
      EXPECT_LT(cluster, 0.65f);
      if (is_needle(leaf.outline)) {
        // A shoot not quite two needles wide in a cell of five and a half, half of it needles; cords are thinner.
        EXPECT_GT(single, leaf.outline == LeafOutline::scale_cord ? 0.03f : 0.10f);
        EXPECT_LT(single, 0.30f);
        continue;
      }
      // A blade fills between two fifths and four fifths of its length times width.
      const float frame = 1e-6f * leaf.length_mm * leaf.width_mm / (leaf_cell_m(leaf) * leaf_cell_m(leaf));
      EXPECT_GT(single, 0.4f * frame);
      EXPECT_LT(single, 0.85f * frame);
    } else {
      EXPECT_GT(cluster, 0.004f);  // twigs and buds
      EXPECT_LT(cluster, 0.08f);
      EXPECT_EQ(single, 0.0f);
    }
  }
}

TEST_P(Atlas, IsTheSameForAnyNumberOfThreadsWithUnitNormals) {
  const auto& [name, season] = GetParam();
  const LeafLook leaf = species_look(name).leaf;
  LeafAtlas first;
  run_with_threads(1, [&] { first = make_leaf_atlas(leaf, season, 5, 128); });
  run_with_threads(8, [&] {
    const LeafAtlas again = make_leaf_atlas(leaf, season, 5, 128);
    EXPECT_EQ(again.base_colour.pixels, first.base_colour.pixels);
    EXPECT_EQ(again.normal.pixels, first.normal.pixels);
  });
  EXPECT_LT(worst_normal(first.normal), std::sqrt(3.0f) / 255.0f + 1e-4f);
}

TEST_P(Atlas, ColoursGoOnUnderTransparentPixels) {
  const auto& [name, season] = GetParam();
  const LeafAtlas atlas = make_leaf_atlas(species_look(name).leaf, season, 7, kAtlasSize);
  // A clear pixel beside an opaque one has nearly its colour; without dilation it would be black.
  double opaque = 0, beside = 0;
  for (int y = 0; y < kAtlasSize; ++y) {
    for (int x = 0; x + 2 < kAtlasSize; ++x) {
      if (alpha(atlas, x, y) < 0.9f || alpha(atlas, x + 2, y) > 0.0f) continue;
      opaque += luminance(linear(atlas.base_colour.at(x, y)));
      beside += luminance(linear(atlas.base_colour.at(x + 2, y)));
    }
  }
  EXPECT_GT(beside, 0.7 * opaque);
  EXPECT_LT(beside, 1.4 * opaque);
}

TEST(LeafAtlas, SingleLeavesAreAsLargeAsTheSpeciesSays) {
  for (const char* name : {"english_oak", "silver_birch", "weeping_willow"}) {
    const LeafLook leaf = species_look(name).leaf;
    const LeafAtlas atlas = make_leaf_atlas(leaf, Season::summer, 9, kAtlasSize);
    const float mm = 1000.0f * leaf_cell_m(leaf) / kHalf;  // a pixel
    for (int variant = 0; variant < 2; ++variant) {
      int low_x = kHalf, high_x = 0, top = kHalf;
      for (int y = 0; y < kHalf; ++y) {
        for (int x = 0; x < kHalf; ++x) {
          if (alpha(atlas, variant * kHalf + x, kHalf + y) < 0.5f) continue;
          low_x = std::min(low_x, x), high_x = std::max(high_x, x), top = std::min(top, y);
        }
      }
      const float height = static_cast<float>(kHalf - top) * mm, width = static_cast<float>(high_x + 1 - low_x) * mm;
      EXPECT_NEAR(height, leaf.length_mm + leaf.petiole_mm, 0.08f * (leaf.length_mm + leaf.petiole_mm)) << name;
      // Leaves are bent and their sides unlike: a fifth of the width and a tenth of the length.
      EXPECT_NEAR(width, leaf.width_mm, 0.2f * leaf.width_mm + 0.1f * leaf.length_mm) << name;
    }
  }
}

TEST(LeafAtlas, SummerLeavesHaveTheSpeciesColourAsAlbedo) {
  for (const std::string& name : kSpecies) {
    const LeafLook leaf = species_look(name).leaf;
    const LeafAtlas atlas = make_leaf_atlas(leaf, Season::summer, 7, kAtlasSize);
    const float given = kLeafAlbedo * luminance(linear_from_srgb(leaf.summer));
    for (int variant = bloom_of(leaf, Season::summer) ? 1 : 0; variant < 2; ++variant) {
      const Vec3 single = colour(atlas, leaf_cell(variant));
      EXPECT_GT(luminance(single), 0.7f * given) << name;
      EXPECT_LT(luminance(single), 1.45f * given) << name;
      EXPECT_GT(single.g, single.r) << name;
      EXPECT_GT(single.g, 1.5f * single.b) << name;
    }
  }
}

TEST(LeafAtlas, AutumnTurnsLeavesTowardRedAndSpringLightens) {
  for (const char* name : {"english_oak", "silver_birch", "weeping_willow"}) {
    const LeafLook leaf = species_look(name).leaf;
    const auto seen = [&](Season season) {
      return colour(make_leaf_atlas(leaf, season, 7, kAtlasSize), cluster_cell(0));
    };
    const Vec3 spring = seen(Season::spring), summer = seen(Season::summer), autumn = seen(Season::autumn);
    EXPECT_GT(luminance(spring), 1.2f * luminance(summer)) << name;
    EXPECT_GT(autumn.r / autumn.g, 1.3f * summer.r / summer.g) << name;
  }
}

TEST(LeafAtlas, AnEvergreenKeepsItsSummerDressInWinterAndFlushesInSpring) {
  const LeafLook spruce = species_look("norway_spruce").leaf;
  const auto cluster = [&](Season season) { return make_leaf_atlas(spruce, season, 7, kAtlasSize); };
  const LeafAtlas winter = cluster(Season::bare), spring = cluster(Season::spring), summer = cluster(Season::summer);
  EXPECT_NEAR(coverage(winter, cluster_cell(0)), coverage(summer, cluster_cell(0)), 0.02f);
  EXPECT_GT(luminance(colour(spring, cluster_cell(0))), 1.15f * luminance(colour(summer, cluster_cell(0))));
}

TEST(LeafAtlas, TheFourSpeciesDiffer) {
  // Slenderness of the single leaf: covered area over the square of its height.
  std::vector<float> slender;
  for (const std::string& name : kSpecies) {
    const LeafLook leaf = species_look(name).leaf;
    const float cell = 1000.0f * leaf_cell_m(leaf);
    slender.push_back(coverage(make_leaf_atlas(leaf, Season::summer, 7, kAtlasSize), leaf_cell(0)) * cell * cell /
                      (leaf.length_mm * leaf.length_mm));
  }
  EXPECT_GT(slender[0], 0.3f);               // oak
  EXPECT_LT(slender[3], 0.4f * slender[0]);  // willow
  const auto atlas = [](const std::string& name) {
    return make_leaf_atlas(species_look(name).leaf, Season::summer, 7, 128).base_colour.pixels;
  };
  for (std::size_t i = 0; i < kSpecies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(atlas(kSpecies[i]), atlas(kSpecies[j]));
  }
}

TEST(LeafBlade, OakHasLobesBirchATailAndBothEndAtTheTip) {
  const LeafBlade oak(species_look("english_oak").leaf, 1, 1), birch(species_look("silver_birch").leaf, 1, 1);
  // Walk down a line beside the midrib and count how often it enters the blade.
  const auto entries = [](const LeafBlade& blade, float u) {
    int count = 0;
    bool inside = false;
    for (int i = 0; i <= 1000; ++i) {
      const bool now = blade.distance(u, static_cast<float>(i) / 1000.0f) > 0.0f;
      count += now && !inside ? 1 : 0, inside = now;
    }
    return count;
  };
  EXPECT_GE(entries(oak, 0.23f), 3);
  EXPECT_EQ(entries(birch, 0.15f), 1);
  for (const LeafBlade* blade : {&oak, &birch}) {
    EXPECT_LT(blade->distance(0.0f, 1.01f), 0.0f);
    EXPECT_LT(blade->distance(0.0f, -0.01f), 0.0f);
    EXPECT_GT(blade->distance(0.0f, 0.5f), 0.1f);
  }
}

TEST(LeafAtlas, EveryBloomPaintsInsideItsCellInItsOwnColour) {
  for (std::size_t form = 1; form < kBloomFormNames.size(); ++form) {
    LeafLook leaf;
    leaf.flower.form = static_cast<BloomForm>(form);
    leaf.flower.from = leaf.flower.to = Season::summer;
    leaf.flower.colour = leaf.flower.heart = srgb(0xD02020);
    const LeafAtlas atlas = make_leaf_atlas(leaf, Season::summer, 3, kAtlasSize);
    EXPECT_GT(coverage(atlas, leaf_cell(0)), 0.02f) << kBloomFormNames[form];
    const Vec3 bunch = colour(atlas, leaf_cell(0)), twig = colour(atlas, cluster_cell(0)),
               plain = colour(atlas, cluster_cell(1));
    EXPECT_GT(bunch.r, 1.5f * bunch.g) << kBloomFormNames[form];
    EXPECT_GT(twig.r / twig.g, 1.03f * plain.r / plain.g) << kBloomFormNames[form];
  }
}

TEST(LeafBlade, PalmateBladesHaveTheirLobesHeartsANotchAndCompoundOnesGaps) {
  // Around the place where the main veins meet, how often the radius has a peak.
  const auto inside = [](const LeafBlade& blade, float angle_deg, float r) {
    const SinCos a = sin_cos(radians(angle_deg));
    return blade.distance(r * a.sin, 0.2f + r * a.cos) > 0.0f;
  };
  const LeafBlade plane(species_look("london_plane").leaf, 1, 1);
  int lobes = 0;
  for (int k = -180; k < 180; ++k)
    lobes += inside(plane, static_cast<float>(k), 0.55f) && !inside(plane, static_cast<float>(k - 1), 0.55f);
  EXPECT_GE(lobes, 3);
  EXPECT_LE(lobes, 7);
  const LeafBlade lime(species_look("small_leaved_lime").leaf, 1, 1);
  EXPECT_GT(lime.foot(), 0.02f);
  EXPECT_LT(lime.distance(0.0f, 0.3f * lime.foot()), 0.0f) << "the notch";
  EXPECT_GT(lime.distance(0.15f, 0.3f * lime.foot() + 0.06f), 0.0f) << "beside it an ear";
  // Along a line beside a rowan's stalk leaflet follows gap.
  const LeafBlade rowan(species_look("rowan").leaf, 1, 1);
  int leaflets = 0;
  bool was = false;
  for (int k = 0; k <= 1000; ++k) {
    const bool now = rowan.distance(0.19f, 0.001f * static_cast<float>(k)) > 0.0f;
    leaflets += now && !was, was = now;
  }
  EXPECT_GE(leaflets, 4);
  EXPECT_LE(leaflets, 7);
}

TEST(LeafAtlas, EveryOutlineFamilyAndTwigFormPaints) {
  for (std::size_t outline = 0; outline < kLeafOutlineNames.size(); ++outline) {
    for (std::size_t form = 0; form < kClusterFormNames.size(); ++form) {
      LeafLook leaf;
      leaf.outline = static_cast<LeafOutline>(outline);
      leaf.cluster = static_cast<ClusterForm>(form);
      if (is_needle(leaf.outline) != bears_needles(leaf.cluster)) continue;  // needles stand on sprays, blades do not
      if (leaf.outline == LeafOutline::needle_spray) leaf.length_mm = 20.0f, leaf.width_mm = 1.0f;
      if (leaf.outline == LeafOutline::scale_cord) leaf.length_mm = 2.0f, leaf.width_mm = 1.6f;
      const LeafAtlas atlas = make_leaf_atlas(leaf, Season::summer, 3, kAtlasSize);
      // Leaflets and cords leave most of their cell empty.
      EXPECT_GT(coverage(atlas, cluster_cell(0)), 0.06f) << kLeafOutlineNames[outline] << kClusterFormNames[form];
      EXPECT_GT(coverage(atlas, leaf_cell(0)), 0.06f) << kLeafOutlineNames[outline] << kClusterFormNames[form];
    }
  }
}

}  // namespace
}  // namespace bosquet::geometry
