#include "ui/thumbnails.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/background.h"
#include "core/hash.h"
#include "exchange/image_file.h"
#include "exchange/texture_cache.h"
#include "geometry/tree_mesh.h"
#include "growth/grow.h"
#include "render/headless_context.h"
#include "render/picture_target.h"
#include "render/renderer.h"
#include "scene/document_digest.h"
#include "scene/materials.h"

namespace bosquet::ui {
namespace {

constexpr std::size_t kTriangles = 80'000;
constexpr std::uint64_t kTreeKey = 1;
constexpr float kMargin = 1.04f;
// Raised whenever the same species is drawn differently.
constexpr std::uint64_t kPictureVersion = 2;

exchange::TextureCache cache_of_user() {
  const std::filesystem::path textures = exchange::TextureCache::of_user().folder();
  return exchange::TextureCache(textures.empty() ? textures : textures.parent_path() / "thumbnails");
}

}  // namespace

std::uint64_t thumbnail_key(const std::shared_ptr<const scene::Species>& species) {
  scene::Document document;
  document.trees = std::make_shared<const scene::Trees>();
  document.terrain = std::make_shared<const terrain::Terrain>();
  document.species.push_back(species);
  const scene::Digest128 digest = scene::digest(document)[scene::Section::species];
  return Hasher().add(kPictureVersion).add(kThumbnail_px).add(digest.high).add(digest.low).digest();
}

Result<Image> draw_thumbnail(const scene::Species& species, const Progress* progress) {
  growth::GrowthInput input;
  input.parameters = &species.growth;
  input.max_height_m = species.shape.mature_height_m;
  input.seed = 1, input.key = kTreeKey;
  const growth::Skeleton skeleton = growth::grow(input, progress);
  if (progress && progress->cancelled()) return cannot_finish("cancelled");
  geometry::MeshOptions options;
  options.max_triangles = kTriangles;
  options.seed = 1, options.key = kTreeKey;
  geometry::TreeMesh mesh =
      geometry::build_tree_mesh(skeleton, skeleton.radius, species.look, species.foliage, options);
  Box3 box;
  for (const Vec3& p : mesh.branches.positions) box.add(p);
  for (const Vec3& p : mesh.leaves.positions) box.add(p);
  if (box.empty()) return cannot_finish("the tree has no mesh");

  scene::Model model;
  model.materials = scene::species_materials(species, geometry::Season::summer);
  model.sun = {215.0f, 42.0f};
  scene::Node node;
  const bool mass = mesh.foliage == geometry::FoliageLevel::cards;
  if (!mesh.branches.empty())
    node.parts.push_back({std::make_shared<const TriangleMesh>(std::move(mesh.branches)), scene::kBarkPart});
  if (!mesh.leaves.empty())
    node.parts.push_back(
        {std::make_shared<const TriangleMesh>(std::move(mesh.leaves)), mass ? scene::kMassPart : scene::kLeafPart});
  model.nodes.push_back(std::move(node));

  auto renderer = render::Renderer::create();
  if (!renderer) return renderer.error();
  if (auto uploaded = renderer->upload(model); !uploaded) return uploaded.error();
  render::View view;
  const Vec3 centre = box.centre();
  view.camera.target = centre;
  view.camera.eye = centre + Vec3(0.0f, 12.0f, 80.0f);
  view.orthographic_height_m = kMargin * std::max({box.size().y, box.size().x, box.size().z});
  view.width = view.height = kThumbnail_px;
  view.sky = false;
  view.background = Vec3(0.07f, 0.1f, 0.05f);  // what the edges of leaves are mixed with
  view.look.surroundings = false;
  view.look.exposure_ev = 0.5f;
  auto picture = renderer->draw(view);
  // A driver that draws nothing must not leave its picture on the disk.
  if (picture) {
    bool seen = false;
    for (std::size_t i = 3; i < picture->pixels.size() && !seen; i += 4) seen = picture->pixels[i] > 0;
    if (!seen) return cannot_finish("nothing was drawn");
  }
  return picture;
}

struct Thumbnails::State {
  mutable std::mutex mutex;
  std::condition_variable wake;
  std::deque<std::shared_ptr<const scene::Species>> wanted;
  std::deque<std::pair<std::shared_ptr<const scene::Species>, Image>> done;
  bool working = false, ending = false;
  Progress progress;
  std::thread thread;

  void work() {
    std::optional<render::HeadlessContext> context;
    bool no_context = false;
    const exchange::TextureCache cache = cache_of_user();
    for (;;) {
      std::shared_ptr<const scene::Species> species;
      {
        std::unique_lock lock(mutex);
        working = false;
        wake.wait(lock, [&] { return ending || !wanted.empty(); });
        if (ending) return;
        species = std::move(wanted.front());
        wanted.pop_front();
        working = true;
      }
      const std::uint64_t key = thumbnail_key(species);
      std::optional<Image> picture;
      if (const auto bytes = cache.find(key, exchange::ImageFormat::png))
        if (auto image = exchange::decode_image(*bytes, "thumbnail")) picture = std::move(*image);
      if (!picture && !no_context) {
        if (!context) {
          auto made = render::HeadlessContext::create();
          if (made)
            context.emplace(std::move(*made));
          else
            no_context = true;
        }
        if (context)
          if (auto image = draw_thumbnail(*species, &progress)) {
            cache.store(key, exchange::ImageFormat::png, exchange::encode_png(*image));
            picture = std::move(*image);
          }
      }
      if (picture) {
        const std::scoped_lock lock(mutex);
        done.emplace_back(std::move(species), std::move(*picture));
      }
    }
  }
};

Thumbnails::Thumbnails() : state_(std::make_unique<State>()) {
  state_->thread = std::thread([state = state_.get()] { run_in_background(1, [state] { state->work(); }); });
}

Thumbnails::~Thumbnails() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ending = true;
  }
  state_->progress.cancel();
  state_->wake.notify_all();
  state_->thread.join();
  for (const auto& [species, entry] : entries_)
    if (entry.texture != 0) render::delete_texture(entry.texture);
}

unsigned Thumbnails::of(const std::shared_ptr<const scene::Species>& species) {
  const auto [found, fresh] = entries_.try_emplace(species.get(), Entry{species, 0});
  if (fresh) {
    const std::scoped_lock lock(state_->mutex);
    state_->wanted.push_back(species);
    state_->wake.notify_all();
  }
  return found->second.texture;
}

void Thumbnails::keep(const std::vector<std::shared_ptr<const scene::Species>>& species) {
  const auto unwanted = [&](const std::shared_ptr<const scene::Species>& one) {
    return std::find(species.begin(), species.end(), one) == species.end();
  };
  const std::size_t dropped = std::erase_if(entries_, [&](const auto& item) {
    if (!unwanted(item.second.species)) return false;
    if (item.second.texture != 0) render::delete_texture(item.second.texture);
    return true;
  });
  if (dropped == 0) return;
  const std::scoped_lock lock(state_->mutex);
  std::erase_if(state_->wanted, unwanted);
}

void Thumbnails::collect() {
  std::optional<std::pair<std::shared_ptr<const scene::Species>, Image>> one;
  {
    const std::scoped_lock lock(state_->mutex);
    if (state_->done.empty()) return;
    one = std::move(state_->done.front());
    state_->done.pop_front();
  }
  // One that was dropped and asked for again may come twice.
  if (const auto found = entries_.find(one->first.get()); found != entries_.end() && found->second.texture == 0)
    found->second.texture = render::make_texture(one->second);
}

bool Thumbnails::settled() const {
  const std::scoped_lock lock(state_->mutex);
  return !state_->working && state_->wanted.empty() && state_->done.empty();
}

}  // namespace bosquet::ui
