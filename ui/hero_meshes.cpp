#include "ui/hero_meshes.h"

#include <algorithm>
#include <chrono>

#include "geometry/tree_mesh.h"

namespace bosquet::ui {
namespace {

constexpr std::size_t kHeroTriangles = 150'000;

std::shared_ptr<const scene::TreeMeshes> mesh_of(const growth::Skeleton& skeleton, const scene::Species& species,
                                                 std::uint64_t seed, std::uint64_t key) {
  geometry::MeshOptions options;
  options.max_triangles = kHeroTriangles;
  options.seed = seed, options.key = key;
  geometry::TreeMesh mesh =
      geometry::build_tree_mesh(skeleton, skeleton.radius, species.look, species.foliage, options);
  auto both = std::make_shared<scene::TreeMeshes>();
  both->foliage = mesh.foliage;
  both->branches = std::move(mesh.branches);
  both->leaves = std::move(mesh.leaves);
  return both;
}

}  // namespace

std::shared_ptr<const scene::TreeMeshes> HeroMeshes::of(const scene::Document& document, const scene::HeroTree& hero) {
  Made& made = made_[hero.skeleton.get()];
  const std::shared_ptr<const scene::Species> species = document.species[hero.species];
  if (made.species != species && !made.coming.valid()) {
    made.skeleton = hero.skeleton;
    made.species = species;
    made.meshes.reset();
    made.coming = std::async(std::launch::async, [skeleton = hero.skeleton, species, seed = document.seed,
                                                  key = hero.key] { return mesh_of(*skeleton, *species, seed, key); });
  }
  if (made.coming.valid() && made.coming.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    made.meshes = made.coming.get();
  return made.meshes;
}

void HeroMeshes::keep(const scene::Document& document) {
  std::erase_if(made_, [&](const auto& entry) {
    const bool wanted = std::any_of(document.heroes.begin(), document.heroes.end(),
                                    [&](const scene::HeroTree& h) { return h.skeleton.get() == entry.first; });
    const Made& made = entry.second;
    const bool busy = made.coming.valid() && made.coming.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    return !wanted && !busy;  // giving up one that is being made would wait for it
  });
}

bool HeroMeshes::making() const {
  return std::any_of(made_.begin(), made_.end(), [](const auto& entry) { return entry.second.coming.valid(); });
}

}  // namespace bosquet::ui
