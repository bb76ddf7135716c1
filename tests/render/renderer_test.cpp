#include "render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/random.h"
#include "geometry/ground_texture.h"
#include "render/atmosphere.h"
#include "render/framing.h"
#include "render/gl.h"
#include "render/headless_context.h"
#include "render/lens.h"
#include "render/srgb.h"
#include "tests/render/test_scenes.h"

namespace bosquet::render {
namespace {

/// One context and renderer for all tests of this file.
class RendererTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<HeadlessContext> context = HeadlessContext::create();
    ASSERT_TRUE(context) << context.error().message;
    context_.emplace(std::move(*context));
    Result<Renderer> renderer = Renderer::create();
    ASSERT_TRUE(renderer) << renderer.error().message;
    renderer_.emplace(std::move(*renderer));
  }
  static void TearDownTestSuite() { renderer_.reset(), context_.reset(); }

  static Image draw(const scene::Model& model, const View& view) {
    const Result<void> uploaded = renderer_->upload(model);
    EXPECT_TRUE(uploaded);
    Result<Image> image = renderer_->draw(view);
    EXPECT_TRUE(image) << image.error().message;
    return image ? std::move(*image) : Image(view.width, view.height, 4);
  }

  static inline std::optional<HeadlessContext> context_;
  static inline std::optional<Renderer> renderer_;
};

View small_view(const Vec3& eye, const Vec3& target) {
  View view;
  view.camera = look_at_world(eye, target);
  view.width = 160, view.height = 120;
  view.supersample = 1;
  return view;
}

/// The pixel that shows a world point.
IVec2 pixel_of(const View& view, const Vec3& world) {
  const ViewVolume volume = make_view_volume(view, Box3{world - Vec3(1), world + Vec3(1)});
  const Vec4 clip = relative_to_clip(volume, {}) * Vec4(world - volume.eye, 1.0f);
  const Vec2 at = Vec2(clip) / clip.w;
  return {static_cast<int>((at.x + 1) / 2 * static_cast<float>(view.width)),
          static_cast<int>((1 - at.y) / 2 * static_cast<float>(view.height))};
}

Vec3 light_at(const Image& image, IVec2 p) {
  const std::uint8_t* c = image.at(std::clamp(p.x, 0, image.width - 1), std::clamp(p.y, 0, image.height - 1));
  return {linear_of_srgb(c[0]), linear_of_srgb(c[1]), linear_of_srgb(c[2])};
}

bool is_red(const Vec3& c) { return c.r > 2 * c.g && c.r > 2 * c.b; }
bool is_green(const Vec3& c) { return c.g > 1.5f * c.r && c.g > 1.5f * c.b; }
bool is_blue(const Vec3& c) { return c.b > 2 * c.r && c.b > 1.5f * c.g; }

/// Middle of all pixels that fulfil a condition.
template <class Condition>
Vec2 middle_of(const Image& image, const Condition& condition, int* count = nullptr) {
  Vec2 sum(0.0f);
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (condition(light_at(image, {x, y}))) sum += Vec2(x, y), ++n;
  if (count) *count = n;
  return n ? sum / static_cast<float>(n) : Vec2(-1.0f);
}

int largest_difference(const Image& a, const Image& b) {
  int most = a.pixels.size() == b.pixels.size() ? 0 : 255;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
  return most;
}

std::shared_ptr<const Image> leaf_cutout(int size) {
  auto image = std::make_shared<Image>(size, size, 4);
  RandomStream random(5, 6, Purpose::texture);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      std::uint8_t* p = image->at(x, y);
      p[0] = 70, p[1] = 110, p[2] = 40, p[3] = 0;
    }
  for (int k = 0; k < 24; ++k) {
    const float cx = random.uniform() * static_cast<float>(size), cy = random.uniform() * static_cast<float>(size);
    const float turn = random.uniform() * 6.28f, c = std::cos(turn), s = std::sin(turn);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const float dx = (static_cast<float>(x) - cx) / static_cast<float>(size);
        const float dy = (static_cast<float>(y) - cy) / static_cast<float>(size);
        const float u = (dx * c + dy * s) / 0.09f, v = (dy * c - dx * s) / 0.03f;
        if (u * u + v * v <= 1) image->at(x, y)[3] = 255;
      }
  }
  return image;
}

TEST_F(RendererTest, ALitRedCubeIsWhereItShouldBeAndRed) {
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {12, 1, -20}, {2, 2, 2}, {0.6f, 0.03f, 0.03f});
  const View view = small_view({20, 8, 0}, {20, 1, -20});
  const Image image = draw(model, view);
  const Vec3 front = light_at(image, pixel_of(view, {12, 1, -19}));
  EXPECT_TRUE(is_red(front)) << front.r << " " << front.g << " " << front.b;
  EXPECT_GT(front.r, 0.1f);
  EXPECT_FALSE(is_red(light_at(image, pixel_of(view, {14.5f, 1, -19}))));
  EXPECT_FALSE(is_red(light_at(image, pixel_of(view, {12, 3.5f, -20}))));
}

TEST_F(RendererTest, ShadowsFallOnTheSideAwayFromTheSun) {
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {20, 4, -20}, {1.5f, 8, 1.5f}, Vec3(0.5f));
  View view = small_view({20, 40, -20}, {20, 0, -20});
  const struct {
    float azimuth_deg;
    Vec3 away;
  } cases[] = {{180, {0, 0, -1}}, {90, {-1, 0, 0}}, {0, {0, 0, 1}}, {270, {1, 0, 0}}};
  for (const auto& c : cases) {
    view.sun = scene::Sun{c.azimuth_deg, 45};
    const Image image = draw(model, view);
    const Vec3 foot(20, 0, -20);
    const float shade = luminance(light_at(image, pixel_of(view, foot + c.away * 6.0f)));
    const float open = luminance(light_at(image, pixel_of(view, foot - c.away * 6.0f)));
    EXPECT_LT(shade, 0.5f * open) << c.azimuth_deg;
    EXPECT_GT(shade, 0.02f) << "shade is lit by the sky, never black";
    // 45 deg: as long as the box is high.
    const float beyond = luminance(light_at(image, pixel_of(view, foot + c.away * 10.5f)));
    EXPECT_GT(beyond, 0.75f * open) << c.azimuth_deg;
  }
}

TEST_F(RendererTest, LitFlatSurfacesShowNoShadowAcne) {
  // A plate alone in slanting light is even but for the haze; the sun's maps must not speckle it.
  scene::Model model;
  test::add_box(model, {0, 0, 0}, {80, 1, 80}, Vec3(0.4f));
  View view = small_view({0, 12, 30}, {0, 0, 0});
  for (const float elevation : {6.0f, 20.0f, 60.0f}) {
    view.sun = scene::Sun{240, elevation};
    const Image image = draw(model, view);
    float darkest = 1, brightest = 0;
    for (int x = -10; x <= 10; ++x)
      for (int z = -10; z <= 10; ++z) {
        const float l = luminance(light_at(image, pixel_of(view, {x, 0.5f, z})));
        darkest = std::min(darkest, l), brightest = std::max(brightest, l);
      }
    EXPECT_GT(darkest, 0.94f * brightest) << elevation;
  }
}

TEST_F(RendererTest, ACutOutCardKeepsItsCoverAtADistance) {
  const auto image = leaf_cutout(128);
  std::size_t opaque = 0;
  for (std::size_t i = 3; i < image->pixels.size(); i += 4) opaque += image->pixels[i] > 127;
  const float wanted = static_cast<float>(opaque) / (128.0f * 128.0f);
  scene::Model model;
  test::add_card(model, image, Vec3(0), 1.0f);
  for (const float distance : {2.0f, 6.0f, 15.0f, 40.0f}) {
    View view = small_view({0, 0, distance}, {0, 0, 0});
    view.shading = Shading::silhouette;
    view.width = view.height = 300;
    const float side = 150.0f / (distance * std::tan(radians(20.0f)));  // pixels of the whole card
    // By coverage of four samples, and by larger pictures averaged.
    for (const auto& [samples, supersample] : {std::pair{4, 1}, {1, 2}}) {
      view.samples = samples, view.supersample = supersample;
      const Image picture = draw(model, view);
      float dark = 0;
      for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) dark += 1 - light_at(picture, {x, y}).g;
      EXPECT_NEAR(dark / (side * side), wanted, 0.15f * wanted) << distance << " m, samples " << samples;
    }
  }
}

TEST_F(RendererTest, AMirroredSceneWouldBeNoticed) {
  // An L: red at the corner, green to its east, blue to its north.
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {15, 1, -15}, {2, 2, 2}, {0.6f, 0.02f, 0.02f});
  test::add_box(model, {21, 1, -15}, {2, 2, 2}, {0.02f, 0.5f, 0.02f});
  test::add_box(model, {15, 1, -24}, {2, 2, 2}, {0.02f, 0.02f, 0.6f});
  View north = small_view({17, 14, 8}, {17, 0, -18});
  View above = small_view({20, 60, -20}, {20, 0, -20});
  above.orthographic_height_m = 30;
  for (View* view : {&north, &above}) {
    view->shading = Shading::flat;
    const Image image = draw(model, *view);
    int reds = 0, greens = 0, blues = 0;
    const Vec2 red = middle_of(image, is_red, &reds), green = middle_of(image, is_green, &greens),
               blue = middle_of(image, is_blue, &blues);
    ASSERT_GT(reds, 10);
    ASSERT_GT(greens, 10);
    ASSERT_GT(blues, 10);
    EXPECT_GT(green.x, red.x + 10) << "east is to the right";
    EXPECT_LT(std::abs(green.y - red.y), 2) << "east is level";
    EXPECT_LT(blue.y, red.y - 5) << "north is away: higher in the picture";
  }
}

TEST_F(RendererTest, TheSamePictureComesOutTwice) {
  scene::Model model = test::ground_scene(30);
  test::add_box(model, {12, 2, -12}, {3, 4, 3}, {0.4f, 0.3f, 0.2f});
  test::add_card(model, leaf_cutout(64), {18, 2, -12}, 4);
  const View view = small_view({15, 6, 10}, {15, 1, -15});
  const Image first = draw(model, view);
  EXPECT_EQ(largest_difference(first, draw(model, view)), 0);
  Result<Renderer> other = Renderer::create();
  ASSERT_TRUE(other);
  ASSERT_TRUE(other->upload(model));
  const Result<Image> again = other->draw(view);
  ASSERT_TRUE(again);
  EXPECT_EQ(largest_difference(first, *again), 0);
}

TEST_F(RendererTest, TilesJoinToTheWholePicture) {
  scene::Model model = test::ground_scene(30);
  test::add_water(model, {15, -8}, 8, 0.05f);
  test::add_box(model, {12, 2, -16}, {3, 4, 3}, {0.4f, 0.3f, 0.2f});
  const View view = small_view({15, 4, 10}, {15, 1, -15});
  const Image whole = draw(model, view);
  renderer_->set_tile_limit(64);
  const Image tiled = draw(model, view);
  EXPECT_EQ(renderer_->facts().tiles, 6);
  renderer_->set_tile_limit(4096);
  // Rounding differs at edges and where the water samples the mirror picture's own pixels.
  int far_off = 0;
  for (std::size_t i = 0; i < whole.pixels.size(); i += 4)
    far_off += std::abs(whole.pixels[i + 1] - tiled.pixels[i + 1]) > 6;
  EXPECT_LT(far_off, view.width * view.height / 100);
}

TEST_F(RendererTest, SupersamplingAveragesAndDoesNotShift) {
  scene::Model model = test::ground_scene(30);
  test::add_box(model, {12, 2, -12}, {3, 4, 3}, {0.6f, 0.02f, 0.02f});
  View view = small_view({15, 6, 10}, {15, 1, -15});
  view.shading = Shading::flat;  // whole faces of one colour, so that the middle tells a shift of the edges
  const Image plain = draw(model, view);
  view.supersample = 3;
  const Image fine = draw(model, view);
  ASSERT_EQ(fine.width, view.width);
  // Weighted by redness, which averaging keeps.
  const auto middle = [](const Image& image) {
    Vec3 sum(0.0f);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Vec3 light = light_at(image, {x, y});
        sum += Vec3(x, y, 1) * (light.r - light.g);
      }
    return Vec2(sum) / sum.z;
  };
  // Four samples place an edge to a quarter of a pixel; a fine row too much or too few would shift by a third.
  EXPECT_LT(glm::length(middle(plain) - middle(fine)), 0.25f);
}

TEST_F(RendererTest, WithoutSkyTheBackgroundIsTransparent) {
  scene::Model model;
  test::add_box(model, {0, 0, 0}, {2, 2, 2}, Vec3(0.5f));
  View view = small_view({0, 0, 10}, {0, 0, 0});
  view.sky = false;
  view.background = Vec3(1, 0, 0);
  const Image image = draw(model, view);
  EXPECT_EQ(image.at(2, 2)[3], 0);
  EXPECT_EQ(image.at(2, 2)[0], 255);
  EXPECT_EQ(image.at(2, 2)[1], 0);
  EXPECT_EQ(image.at(80, 60)[3], 255);
  view.sky = true;
  EXPECT_EQ(draw(model, view).at(2, 2)[3], 255);
}

TEST_F(RendererTest, LeavesAgainstTheLightShineThrough) {
  // The same card, its back to the sun, with and without translucency; the sun comes from behind it.
  auto solid = std::make_shared<Image>(4, 4, 4);
  for (std::size_t i = 0; i < solid->pixels.size(); i += 4) {
    solid->pixels[i] = 80, solid->pixels[i + 1] = 120, solid->pixels[i + 2] = 40, solid->pixels[i + 3] = 255;
  }
  scene::Model model;
  test::add_card(model, solid, {0, 2, 0}, 2);
  View view = small_view({0, 2, 6}, {0, 2, 0});
  view.sun = scene::Sun{0, 30};
  const IVec2 middle(80, 60);
  model.materials[0].translucency = 0.0f;
  const Vec3 closed = light_at(draw(model, view), middle);
  model.materials[0].translucency = 0.6f;
  const Vec3 shining = light_at(draw(model, view), middle);
  EXPECT_GT(shining.g, 1.5f * closed.g);
  EXPECT_GT(shining.g / shining.b, closed.g / closed.b) << "what comes through is yellower";
}

TEST_F(RendererTest, OneSidedLeavesShowTheirFrontOnly) {
  // As the cards of far trees, whose back would hide the front of the card on the same place.
  auto solid = std::make_shared<Image>(4, 4, 4);
  std::fill(solid->pixels.begin(), solid->pixels.end(), std::uint8_t{255});
  scene::Model model;
  test::add_card(model, solid, Vec3(0), 2);
  const auto dark = [&](float from) {
    View view = small_view({0, 0, from}, {0, 0, 0});
    view.shading = Shading::silhouette;
    int count = 0;
    middle_of(
        draw(model, view), [](const Vec3& c) { return c.g < 0.5f; }, &count);
    return count;
  };
  EXPECT_GT(dark(6), 100);
  EXPECT_GT(dark(-6), 100);
  model.materials[0].double_sided = false;
  EXPECT_GT(dark(6), 100);
  EXPECT_EQ(dark(-6), 0);
}

TEST_F(RendererTest, WaterMirrorsWhatStandsBehindIt) {
  scene::Model model = test::ground_scene(60);
  for (Vec3& p : std::const_pointer_cast<TriangleMesh>(model.nodes[0].parts[0].mesh)->positions) p.y = -3;
  test::add_water(model, {30, -30}, 60, 0);
  View view = small_view({30, 1.2f, 0}, {30, 1.2f, -40});
  view.look.ripples = 0;
  const Image without = draw(model, view);
  test::add_box(model, {30, 3, -30}, {6, 6, 1}, {0.7f, 0.02f, 0.02f});
  const Image with = draw(model, view);
  // The mirror image of the point 2 m up is the point 2 m down.
  const IVec2 mirrored = pixel_of(view, {30, -2, -29.5f});
  EXPECT_GT(light_at(with, mirrored).r / light_at(with, mirrored).b,
            2 * light_at(without, mirrored).r / light_at(without, mirrored).b);
  const IVec2 beside = pixel_of(view, {38, -2, -29.5f});
  EXPECT_FALSE(is_red(light_at(with, beside)));
}

TEST_F(RendererTest, DistantThingsFadeIntoTheHaze) {
  scene::Model model;
  test::add_box(model, {0, 0, 0}, {400, 400, 1}, {0.02f, 0.02f, 0.02f});
  View view = small_view({0, 0, 100}, {0, 0, 0});
  view.look.haze_distance_m = 200;
  const float near = luminance(light_at(draw(model, view), {80, 60}));
  view.camera.eye.z = 500;
  const float far = luminance(light_at(draw(model, view), {80, 60}));
  EXPECT_GT(far, 1.3f * near);
}

TEST_F(RendererTest, ANewModelTakesThePlaceOfTheOld) {
  scene::Model red, green;
  test::add_box(red, {0, 0, 0}, {2, 2, 2}, {0.6f, 0.02f, 0.02f});
  test::add_box(green, {0, 0, 0}, {2, 2, 2}, {0.02f, 0.5f, 0.02f});
  const View view = small_view({0, 0, 8}, {0, 0, 0});
  EXPECT_TRUE(is_red(light_at(draw(red, view), {80, 60})));
  EXPECT_TRUE(is_green(light_at(draw(green, view), {80, 60})));
}

TEST_F(RendererTest, NothingAtAllIsAPictureOfTheSky) {
  View view = small_view({0, 2, 0}, {0, 12, -10});
  const Image image = draw({}, view);
  const Vec3 sky = light_at(image, {80, 30});
  EXPECT_GT(sky.b, sky.r);
  EXPECT_GT(luminance(sky), 0.1f);
}

TEST_F(RendererTest, WhatIsBehindTheCameraIsNotDrawn) {
  scene::Model model;
  for (int i = 0; i < 10; ++i) test::add_box(model, {0, 0, static_cast<float>(20 + 4 * i)}, {2, 2, 2}, Vec3(0.5f));
  test::add_box(model, {0, 0, -10}, {2, 2, 2}, Vec3(0.5f));
  draw(model, small_view({0, 0, 0}, {0, 0, -1}));
  EXPECT_EQ(renderer_->facts().triangles_viewed, 12u);
}

TEST_F(RendererTest, DrawsIntoTheCallersFramebufferWhatItWouldReturn) {
  scene::Model model = test::ground_scene(30);
  test::add_box(model, {12, 2, -12}, {3, 4, 3}, {0.6f, 0.1f, 0.1f});
  const View view = small_view({15, 6, 10}, {15, 1, -15});
  const Image image = draw(model, view);
  // As windows have it: plain bytes without sRGB conversion.
  const GlFramebuffer target = GlFramebuffer::make();
  const GlRenderbuffer colour = GlRenderbuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, target.name());
  glBindRenderbuffer(GL_RENDERBUFFER, colour.name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, view.width, view.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour.name());
  ASSERT_TRUE(renderer_->draw_into(target.name(), view));
  Image read(view.width, view.height, 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
  glReadPixels(0, 0, view.width, view.height, GL_RGBA, GL_UNSIGNED_BYTE, read.pixels.data());
  int most = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < 4 * view.width; ++x)
      most = std::max(most, std::abs(read.at(0, view.height - 1 - y)[x] - image.at(0, y)[x]));
  EXPECT_EQ(most, 0);
}

TEST_F(RendererTest, NodesPutAndRemovedLookAsIfTheyHadBeenUploaded) {
  const View view = small_view({20, 12, 6}, {20, 1, -20});
  const scene::Model ground = test::ground_scene(40);
  scene::Model both = ground, all = ground;
  test::add_box(both, {12, 1, -20}, {2, 2, 2}, {0.6f, 0.03f, 0.03f});
  all = both;
  test::add_box(all, {26, 2, -16}, {3, 4, 3}, {0.03f, 0.5f, 0.03f});
  const Image with_both = draw(both, view), with_all = draw(all, view), with_none = draw(ground, view);
  const Overhead overhead_of_all = make_overhead(all, bounds(all)),
                 overhead_of_ground = make_overhead(ground, bounds(ground));
  const auto differs = [&](const Image& wanted, const Overhead& overhead) {
    EXPECT_TRUE(renderer_->set_overhead(overhead));
    const Result<Image> seen = renderer_->draw(view);
    return seen ? largest_difference(*seen, wanted) : 255;
  };

  ASSERT_TRUE(renderer_->upload(ground));
  const std::vector<scene::Material> added(all.materials.begin() + 1, all.materials.end());
  const Result<std::size_t> first = renderer_->add_materials(make_levels(added));
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, 1u);
  ASSERT_TRUE(renderer_->put(7, all.nodes[1]));
  ASSERT_TRUE(renderer_->put(9, all.nodes[2]));
  EXPECT_EQ(differs(with_all, overhead_of_all), 0);
  // A key means one node: putting it again replaces, removing it takes all of it, and only it.
  ASSERT_TRUE(renderer_->put(9, all.nodes[1]));
  renderer_->remove(7);
  EXPECT_EQ(differs(with_both, make_overhead(both, bounds(both))), 0);
  renderer_->remove(9);
  renderer_->remove(9);
  EXPECT_EQ(differs(with_none, overhead_of_ground), 0);
}

TEST_F(RendererTest, AMeshAtTheAddressOfAnEarlierOneIsNotTakenForIt) {
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {20, 1, -20}, {2, 2, 2}, {0.6f, 0.03f, 0.03f});
  scene::Node node = model.nodes.back();
  model.nodes.pop_back();
  // The same mesh object is filled anew, as a freed one's memory may be.
  auto mesh = std::make_shared<TriangleMesh>(*node.parts[0].mesh);
  node.parts[0].mesh = std::shared_ptr<const TriangleMesh>(mesh.get(), [](const TriangleMesh*) {});
  ASSERT_TRUE(renderer_->upload(model));
  ASSERT_TRUE(renderer_->put(1, node));
  for (Vec3& p : mesh->positions) p *= 4.0f;
  node.parts[0].mesh = std::shared_ptr<const TriangleMesh>(mesh.get(), [](const TriangleMesh*) {});
  ASSERT_TRUE(renderer_->put(2, node));
  const View view = small_view({20, 12, 6}, {20, 1, -20});
  const Result<Image> image = renderer_->draw(view);
  ASSERT_TRUE(image);
  EXPECT_TRUE(is_red(light_at(*image, pixel_of(view, {17.5f, 2, -17}))));
}

TEST_F(RendererTest, ADraftHasTheFullPicturesLightAndShadow) {
  scene::Model model = test::ground_scene(40);
  test::add_box(model, {20, 4, -20}, {1.5f, 8, 1.5f}, Vec3(0.5f));
  View view = small_view({20, 40, -20}, {20, 0, -20});
  view.quality = Quality::draft;
  for (const float azimuth : {180.0f, 90.0f}) {
    view.sun = scene::Sun{azimuth, 45};
    const Image draft = draw(model, view);
    const Result<Image> again = renderer_->draw(view);  // by the map that was kept
    ASSERT_TRUE(again);
    EXPECT_EQ(largest_difference(draft, *again), 0);
    view.quality = Quality::full;
    const Image full = draw(model, view);
    view.quality = Quality::draft;
    for (const Vec3& p : {Vec3(20, 0, -26), Vec3(14, 0, -20), Vec3(10, 0, -10), Vec3(30, 0, -12)})
      EXPECT_NEAR(luminance(light_at(draft, pixel_of(view, p))), luminance(light_at(full, pixel_of(view, p))), 0.02f);
  }
}

/// Even ground of a meadow's colour with grass on it, or without.
class GrassTest : public RendererTest {
 protected:
  static constexpr float kSide = 100.0f;

  static scene::Model bare() {
    scene::Model model = test::ground_scene(kSide);
    model.materials[0].base_factor = Vec4(geometry::kMeadowColour, 1.0f);
    model.materials[0].patchiness = 0.0f;
    model.sun = {230, 45};
    return model;
  }
  static Image draw_with(const scene::GrassSite& site, const View& view) {
    EXPECT_TRUE(renderer_->upload(bare()));
    renderer_->set_grass_season(geometry::Season::summer);
    std::uint64_t key = 0;
    for (const scene::GrassPatch& patch : scene::grass_before(site, view.camera, view.grass_reach))
      renderer_->put_grass(++key, patch);
    Result<Image> image = renderer_->draw(view);
    EXPECT_TRUE(image);
    return std::move(*image);
  }
  static scene::GrassSite meadow() {
    scene::Document document;
    document.terrain = std::make_shared<const terrain::Terrain>(
        terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice(Vec2(kSide)))));
    document.trees = std::make_shared<const scene::Trees>();
    return scene::GrassSite(document, {});
  }
  static View from_eye_height() {
    View view = small_view({50, 1.7f, -10}, {50, 0.9f, -22});
    view.width = 320, view.height = 240, view.supersample = 2;
    return view;
  }
  /// Mean light of some rows, counted as shares of the picture's height from its top.
  static Vec3 mean_of_rows(const Image& image, float from, float to) {
    Vec3 sum(0.0f);
    int n = 0;
    for (int y = static_cast<int>(from * static_cast<float>(image.height));
         y < static_cast<int>(to * static_cast<float>(image.height)); ++y)
      for (int x = 0; x < image.width; ++x, ++n) sum += light_at(image, {x, y});
    return sum / static_cast<float>(n);
  }
};

TEST_F(GrassTest, ItHasTheToneOfTheGroundAtEveryDistance) {
  const scene::GrassSite site = meadow();
  const View view = from_eye_height();
  const Image without = draw(bare(), view), with = draw_with(site, view);
  EXPECT_NE(without.pixels, with.pixels);
  for (const float row : {0.45f, 0.55f, 0.65f, 0.75f, 0.85f}) {
    const Vec3 a = mean_of_rows(without, row, row + 0.1f), b = mean_of_rows(with, row, row + 0.1f);
    EXPECT_NEAR(b.g / a.g, 1.0f, 0.15f) << row;
    EXPECT_NEAR(b.r / b.g, a.r / a.g, 0.12f) << row;
  }
}

TEST_F(GrassTest, ItIsGoneBeforeTheEndOfItsReachWithoutAnEdge) {
  const scene::GrassSite site = meadow();
  View view = from_eye_height();
  draw_with(site, view);
  const std::size_t near = renderer_->facts().triangles_viewed;
  // From farther up there is less of it, and none in plans or from so high that no tuft can be told.
  view.camera = look_at_world({50, 30, 0}, {50, 0, -40});
  draw_with(site, view);
  EXPECT_LT(renderer_->facts().triangles_viewed, near / 4);
  view.camera = look_at_world({50, 90, 0}, {50, 0, -40});
  EXPECT_EQ(draw(bare(), view).pixels, draw_with(site, view).pixels);
  view = from_eye_height();
  view.grass_reach = 0.0f;
  EXPECT_EQ(draw(bare(), view).pixels, draw_with(site, view).pixels);
}

TEST_F(GrassTest, APatchThatIsEmptiedIsGone) {
  const scene::GrassSite site = meadow();
  const View view = from_eye_height();
  draw_with(site, view);
  std::uint64_t key = 0;
  for (const scene::GrassPatch& patch : scene::grass_before(site, view.camera, view.grass_reach))
    renderer_->put_grass(++key, {patch.tile, {}});
  const Result<Image> after = renderer_->draw(view);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->pixels, draw(bare(), view).pixels);
}

TEST_F(RendererTest, ImpossiblePicturesAreRefusedWithTheAllowedRange) {
  const auto message = [](const View& view) {
    const Result<Image> image = renderer_->draw(view);
    EXPECT_FALSE(image);
    return image ? std::string() : image.error().message;
  };
  View view = small_view({0, 0, 8}, {0, 0, 0});
  view.width = 0;
  EXPECT_NE(message(view).find("width is 0, allowed are 1 to 32768"), std::string::npos);
  view.width = 100, view.height = 40000;
  EXPECT_NE(message(view).find("height"), std::string::npos);
  view.height = 100, view.samples = 99;
  EXPECT_NE(message(view).find("samples"), std::string::npos);
  view.samples = 4, view.camera.vertical_fov_deg = std::nanf("");
  EXPECT_NE(message(view).find("field of view"), std::string::npos);
}

TEST(RendererWithoutContext, SaysSoInsteadOfCrashing) {
  const Result<Renderer> renderer = Renderer::create();
  ASSERT_FALSE(renderer);
  EXPECT_NE(renderer.error().message.find("OpenGL 3.3"), std::string::npos);
}

}  // namespace
}  // namespace bosquet::render
