#include "cli/gallery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "cli/sheet.h"
#include "geometry/human_figure.h"
#include "growth/age.h"
#include "growth/grow.h"
#include "growth/measure.h"

namespace bosquet::cli {
namespace {

// Any ink darker than the lines of heights and the grey of small letters.
bool dark(const Image& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return p[0] < 80 && p[1] < 80 && p[2] < 80;
}

TEST(HumanFigure, StandsOnTheGroundAndIsAsTallAsItSays) {
  const Box3 box = geometry::human_figure().bounds();
  EXPECT_NEAR(box.low.y, 0.0f, 0.01f);
  EXPECT_NEAR(box.high.y, geometry::kFigureHeight, 1e-4f);
}

TEST(HumanFigure, HasAboutTheVolumeOfAPerson) {
  // Signed, so triangles that face inward would take away; parts that overlap count twice.
  const TriangleMesh mesh = geometry::human_figure();
  float volume = 0.0f;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const Vec3 &a = mesh.positions[mesh.indices[t]], &b = mesh.positions[mesh.indices[t + 1]],
               &c = mesh.positions[mesh.indices[t + 2]];
    volume += glm::dot(a, glm::cross(b, c)) / 6.0f;
  }
  EXPECT_GT(volume, 0.05f);
  EXPECT_LT(volume, 0.12f);
}

TEST(HumanFigure, IsClosed) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const TriangleMesh mesh = geometry::human_figure();
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.indices[t + k], b = mesh.indices[t + (k + 1) % 3];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0) << edge.first << " " << edge.second;
}

TEST(Sheet, ALetteredPageHasInkWhereTheTextIs) {
  auto sheet = Sheet::create(200, 60);
  ASSERT_TRUE(sheet) << sheet.error().message;
  const double width = sheet->text(150, 40, "Quercus", {20.0, Align::right, false, false, Vec3(0.0f)});
  EXPECT_GT(width, 40.0);
  const Image image = sheet->image();
  int left = image.width, right = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (dark(image, x, y)) left = std::min(left, x), right = std::max(right, x);
  EXPECT_NEAR(left, 150 - width, 3.0);
  EXPECT_NEAR(right, 150, 3.0);
}

TEST(Sheet, APictureLetsThePageThroughByItsCover) {
  Image picture(3, 1, 4);
  const std::uint8_t pixels[12] = {0, 0, 0, 0, 0, 0, 0, 128, 0, 0, 255, 255};
  std::copy(std::begin(pixels), std::end(pixels), picture.pixels.begin());
  auto sheet = Sheet::create(3, 1);
  ASSERT_TRUE(sheet);
  sheet->picture(0, 0, picture);
  const Image image = sheet->image();
  EXPECT_EQ(image.at(0, 0)[1], 255);
  EXPECT_NEAR(image.at(1, 0)[1], 127, 1);
  EXPECT_EQ(image.at(2, 0)[0], 0);
  EXPECT_EQ(image.at(2, 0)[2], 255);
}

// Heights in pixels, from the ground line up, of the figure and of the trees: the first columns with ink are the
// figure's, the rest the trees'.
TEST(Gallery, ThePersonAndTheTreesStandOnOneLineAtOneScale) {
  auto maple = scene::builtin_species("norway_maple");
  ASSERT_TRUE(maple);
  GalleryOptions options;
  options.ages = {9.0f};
  options.width = 700, options.height = 600;
  auto sheet = draw_gallery({*maple}, options, nullptr);
  ASSERT_TRUE(sheet) << sheet.error().message;
  EXPECT_EQ(sheet->width, 700);
  EXPECT_LE(sheet->height, 600);

  // The ground line is the only row dark from side to side.
  int ground = -1;
  for (int y = 0; y < sheet->height; ++y) {
    int ink = 0;
    for (int x = 0; x < sheet->width; ++x) ink += sheet->at(x, y)[1] < 150;
    if (ink > sheet->width * 8 / 10) ground = y;
  }
  ASSERT_GT(ground, 0);
  // Columns with ink right above the ground: the figure's feet, then a stem with leaves, then one without.
  std::vector<std::pair<int, int>> feet;
  for (int x = 0; x < sheet->width; ++x) {
    bool ink = false;
    for (int y = ground - 12; y < ground - 3; ++y) ink = ink || sheet->at(x, y)[1] < 200;
    if (!ink) continue;
    if (feet.empty() || x - feet.back().second > 12)
      feet.emplace_back(x, x);
    else
      feet.back().second = x;
  }
  ASSERT_EQ(feet.size(), 3u);
  const auto top = [&](std::pair<int, int> columns) {
    for (int y = 60; y < ground; ++y)
      for (int x = columns.first - 12; x <= columns.second + 12; ++x) {
        const std::uint8_t* p = sheet->at(x, y);
        // Skip the lines of heights, which are grey all along.
        if (std::max({p[0], p[1], p[2]}) < 200) return ground - y;
      }
    return 0;
  };
  const float person = static_cast<float>(top(feet[0]));
  growth::GrowthInput input;
  input.parameters = &maple->growth;
  input.max_height_m = maple->shape.mature_height_m;
  input.seed = options.seed, input.key = kGalleryKey;
  const growth::Skeleton skeleton = growth::grow(input);
  const float asked = growth::height_share_at_age(maple->growth, 9.0f) * maple->shape.mature_height_m;
  const float height = growth::measure(skeleton, growth::season_at_height(skeleton, asked)).height_m;
  // A twig or leaf stands up beyond the wood, and pixels are 2 cm.
  EXPECT_NEAR(static_cast<float>(top(feet[1])) / person * geometry::kFigureHeight, height, 0.3f);
  EXPECT_NEAR(static_cast<float>(top(feet[2])) / person * geometry::kFigureHeight, height, 0.3f);
}

TEST(Gallery, ASheetTooSmallForItsSpeciesIsRefused) {
  auto birch = scene::builtin_species("silver_birch");
  ASSERT_TRUE(birch);
  GalleryOptions options;
  options.width = 400, options.height = 40;
  auto sheet = draw_gallery({*birch}, options, nullptr);
  ASSERT_FALSE(sheet);
  EXPECT_NE(sheet.error().message.find("--size"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::cli
