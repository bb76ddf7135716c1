// How much a tree with fewer triangles differs on a picture from the whole one:  lod_table RECIPE [--strip OUT.jpg]
// The recipe's first tree is drawn alone by the renderer, from the side and from 35 degrees above, with all its triangles
// and with those of each budget, at the height on the picture down to which the next finer budget serves in exported
// levels (scene/tree_parts.h): 1080 pixels times the square root of its share of the triangles. Prints a table in Markdown:
// mean absolute difference of the three channels, in percent of full scale, over the tree's box; beside it that of the
// same tree turned by 20 degrees, as a measure of what nobody would notice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "exchange/image_file.h"
#include "exchange/recipe.h"
#include "growth/radii.h"
#include "render/framing.h"
#include "render/headless_context.h"
#include "render/renderer.h"
#include "scene/materials.h"
#include "scene/tree_parts.h"

namespace bosquet {
namespace {

constexpr std::size_t kBudgets[] = {0, 20'000, 8'000, 3'000, 1'000, 400, 300, 160, 60, 10, 4};
constexpr std::size_t kStrip[] = {0, 8'000, 1'000, 160, 60, 10, 4};
constexpr int kMostPixels = 1080;

template <class T>
T must(Result<T> result) {
  if (!result) {
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
  }
  return std::move(*result);
}

struct Subject {
  scene::GrownScene grown;
  std::vector<scene::Material> materials;
  scene::TreeOrder order;
};

// One tree alone, at a budget.
scene::Model model_of(const Subject& subject, std::size_t budget, float turned = 0.0f) {
  scene::TreeOrder order = subject.order;
  order.budget = budget;
  scene::Model model;
  model.materials = subject.materials;
  scene::Node node;
  node.parts = scene::build_tree_parts(std::span(&order, 1), false, model.materials, nullptr).front().parts;
  if (turned != 0.0f) {
    const SinCos a = sin_cos(turned);
    for (scene::Part& part : node.parts) {
      TriangleMesh mesh = *part.mesh;
      for (auto* list : {&mesh.positions, &mesh.normals})
        for (Vec3& p : *list) p = {a.cos * p.x + a.sin * p.z, p.y, a.cos * p.z - a.sin * p.x};
      part.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    }
  }
  model.nodes.push_back(std::move(node));
  model.sun = subject.grown.document.sun;
  return model;
}

std::size_t triangles(const scene::Model& model) {
  std::size_t sum = 0;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) sum += part.mesh->triangles();
  return sum;
}

Image picture(render::Renderer& renderer, const scene::Model& model, const Box3& box, int pixels, bool above) {
  if (auto done = renderer.upload(model); !done) {
    fmt::print(stderr, "{}\n", done.error().message);
    std::exit(1);
  }
  render::View view;
  view.camera = render::frame(box, 1.0f, above ? 35.0f : 3.0f);
  view.width = view.height = std::max(16, pixels);
  view.sky = false;
  view.background = Vec3(0.45f);
  view.look.surroundings = false;
  view.look.haze_distance_m = 1e6f;
  return must(renderer.draw(view));
}

double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) sum += std::abs(a.at(x, y)[c] - b.at(x, y)[c]);
  return 100.0 * sum / (255.0 * 3.0 * a.width * a.height);
}

void write_strip(render::Renderer& renderer, const Subject& subject, const Box3& box, const char* file) {
  constexpr int kSide = 420, kWidth = 330;
  Image strip(kWidth * static_cast<int>(std::size(kStrip)), kSide, 3);
  for (std::size_t k = 0; k < std::size(kStrip); ++k) {
    const Image one = picture(renderer, model_of(subject, kStrip[k]), box, kSide, false);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kWidth; ++x)
        std::copy_n(one.at(x + (kSide - kWidth) / 2, y), 3, strip.at(static_cast<int>(k) * kWidth + x, y));
  }
  if (auto done = exchange::write_image(file, strip); !done) fmt::print(stderr, "{}\n", done.error().message);
}

int run(int argc, char** argv) {
  if (argc != 2 && !(argc == 4 && std::strcmp(argv[2], "--strip") == 0)) {
    fmt::print(stderr, "usage: lod_table RECIPE [--strip OUT.jpg]\n");
    return 1;
  }
  Subject subject;
  const auto recipe = must(exchange::read_recipe(argv[1]));
  const auto built = must(exchange::build_document(recipe));
  subject.grown = must(scene::grow_scene(built.document, {}, nullptr));
  const scene::Document& document = subject.grown.document;
  const scene::GrownTree& tree = subject.grown.trees.at(0);
  const scene::Tree& planted = document.trees->front();
  const scene::Species& species = document.species_of(planted);
  const std::vector<float> radius =
      tree.season < 0 ? tree.skeleton->radius : growth::radii(*tree.skeleton, tree.season);
  subject.materials = scene::make_materials(document, geometry::Season::summer);
  subject.order.input = {tree.skeleton.get(), radius, &species.look, &species.foliage, {}};
  subject.order.input.options.season_of_growth = tree.season;
  subject.order.input.options.seed = document.seed;
  subject.order.input.options.key = planted.key;
  subject.order.species = planted.species;
  subject.order.need = static_cast<std::size_t>(-1);
  subject.order.size = {tree.measures.crown_diameter_m, tree.measures.height_m};

  auto context = must(render::HeadlessContext::create());
  auto renderer = must(render::Renderer::create());
  const scene::Model whole = model_of(subject, 0), turned = model_of(subject, 0, radians(20.0f));
  const Box3 box = render::bounds(whole);
  const auto full = static_cast<double>(triangles(whole));

  fmt::print("| {} | triangles | height, pixels | from the side, % | from above, % | turned by 20 degrees, % |\n",
             species.name);
  fmt::print("|---|--:|--:|--:|--:|--:|\n");
  double finer = full;
  for (const std::size_t budget : kBudgets) {
    const scene::Model model = model_of(subject, budget);
    const auto n = static_cast<double>(triangles(model));
    if (budget > 0 && n >= finer) continue;
    // A level serves from the height at which it has as many triangles for its area as the finest on the whole picture.
    const int pixels = static_cast<int>(std::min(1.0, std::sqrt(n / full)) * kMostPixels);
    double off[3];
    for (int k = 0; k < 3; ++k) {
      const bool above = k == 1;
      off[k] = difference(picture(renderer, k == 2 ? turned : model, box, pixels, above),
                          picture(renderer, whole, box, pixels, above));
    }
    const auto form = budget == 0 ? geometry::TreeForm::mesh : geometry::form_within(budget);
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n",
               geometry::kTreeFormNames[static_cast<std::size_t>(form)], n, pixels, off[0], off[1], off[2]);
    finer = n;
  }
  if (argc == 4) write_strip(renderer, subject, box, argv[3]);
  return 0;
}

}  // namespace
}  // namespace bosquet

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // each line as soon as it is known: the whole tree takes a while
  return bosquet::run(argc, argv);
}
