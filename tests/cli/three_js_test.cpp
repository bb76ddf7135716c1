// The river bank as three.js sees it: the same outline as our own picture from the same camera.
#include "exchange/gltf_writer.h"
#include "exchange/image_file.h"
#include "exchange/recipe.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "scene/model_builder.h"
#include "tests/cli/program.h"

namespace bosquet {
namespace {

constexpr int kWidth = 960, kHeight = 540;

class ThreeJs : public ProgramTest {};

// Share of the pixels that either picture covers which both cover. Ours draws black on white, three.js white on black.
double overlap(const Image& ours, const Image& theirs) {
  std::size_t both = 0, either = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool a = ours.at(x, y)[0] < 128, b = theirs.at(x, y)[0] >= 128;
      both += a && b, either += a || b;
    }
  return static_cast<double>(both) / static_cast<double>(either);
}

TEST_F(ThreeJs, ShowsTheRiverBankWithTheOutlineOfOurOwnPicture) {
  auto recipe = exchange::read_recipe(source("examples/riverbank.toml"));
  ASSERT_TRUE(recipe);
  auto document = exchange::build_document(*recipe);
  ASSERT_TRUE(document);
  auto grown = scene::grow_scene(document->document, {}, nullptr);
  ASSERT_TRUE(grown);
  auto built = scene::build_model(*grown, {.max_triangles = recipe->document.max_triangles}, nullptr);
  ASSERT_TRUE(built);
  ASSERT_TRUE(exchange::write_gltf(built->model, folder_ / "riverbank.glb"));

  auto context = render::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().message;
  auto renderer = render::Renderer::create();
  ASSERT_TRUE(renderer);
  ASSERT_TRUE(renderer->upload(built->model));
  render::View view;
  view.camera = built->model.cameras.front();
  view.width = kWidth, view.height = kHeight;
  view.shading = render::Shading::silhouette;
  view.look.surroundings = false;
  auto ours = renderer->draw(view);
  ASSERT_TRUE(ours);
  ASSERT_TRUE(exchange::write_image(folder_ / "ours.png", *ours));

  const Ran ran = shell("node '" + source("tests/web/view.mjs") + "' riverbank.glb theirs.png --silhouette --size " +
                        std::to_string(kWidth) + "x" + std::to_string(kHeight) + " --camera " + view.camera.name);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out)["triangles"], built->triangles);
  auto theirs = exchange::read_image(folder_ / "theirs.png");
  ASSERT_TRUE(theirs);
  EXPECT_GE(overlap(*ours, *theirs), 0.9);
}

}  // namespace
}  // namespace bosquet
