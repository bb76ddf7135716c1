#include <gtest/gtest.h>

#include "core/parallel.h"
#include "geometry/foliage_mass.h"
#include "tests/geometry/texture_looks.h"

namespace bosquet::geometry {
namespace {

constexpr int kMassSide = 512;  // of the mass; the atlas has twice the pixels

LeafAtlas oak_atlas() { return make_leaf_atlas(species_look("english_oak").leaf, Season::summer, 7, 2 * kMassSide); }

double mean_alpha(const Image& image, int x0, int x1, int y0, int y1) {
  double sum = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) sum += image.at(x, y)[3];
  return sum / 255.0 / ((x1 - x0) * (y1 - y0));
}

TEST(FoliageMass, IsTheSameForAnyNumberOfThreads) {
  const LeafAtlas atlas = oak_atlas();
  std::vector<std::uint8_t> one, eight;
  run_with_threads(1, [&] { one = make_foliage_mass(atlas, ClusterForm::tuft, 3).base_colour.pixels; });
  run_with_threads(8, [&] { eight = make_foliage_mass(atlas, ClusterForm::tuft, 3).base_colour.pixels; });
  EXPECT_EQ(one, eight);
}

TEST(FoliageMass, CoversMuchOfTheCardAndLeavesItsRimClear) {
  const Image mass = make_foliage_mass(oak_atlas(), ClusterForm::tuft, 3).base_colour;
  for (int cell : {0, 1}) {
    const int left = cell * kMassSide / 2;
    const double cover = mean_alpha(mass, left, left + kMassSide / 2, 0, kMassSide / 2);
    EXPECT_GT(cover, 0.2);
    EXPECT_LT(cover, 0.75);
    EXPECT_EQ(mean_alpha(mass, left, left + kMassSide / 2, 0, 2), 0.0);
    EXPECT_EQ(mean_alpha(mass, left, left + 2, 0, kMassSide / 2), 0.0);
  }
}

TEST(FoliageMass, ShowsSmallerLeavesThanTheAtlas) {
  // Smaller leaves change from leaf to gap more often along a row.
  const auto edges = [](const Image& image) {
    int n = 0;
    for (int y = 0; y < image.height / 2; ++y)
      for (int x = 1; x < image.width / 2; ++x) n += (image.at(x, y)[3] > 127) != (image.at(x - 1, y)[3] > 127);
    return static_cast<double>(n) / image.height;
  };
  const LeafAtlas atlas = oak_atlas();
  EXPECT_GT(edges(make_foliage_mass(atlas, ClusterForm::tuft, 3).base_colour), 1.25 * edges(atlas.base_colour));
}

}  // namespace
}  // namespace bosquet::geometry
