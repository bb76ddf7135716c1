#include "scene/tree_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "scene/materials.h"

namespace bosquet::scene {
namespace {

using geometry::TreeForm;

constexpr int kFineBlock = 256, kBlock = 128;  // pixels of a tree's pictures; fine where few trees have any
constexpr std::size_t kFewPictures = 64;
constexpr std::size_t kCoarser = 5;  // times fewer triangles from mesh to mesh
constexpr std::size_t kMeshLevels = 2;
constexpr std::size_t kShellTriangles = 120;
constexpr float kImpostorTranslucency = 0.25f;

struct Picture {
  std::size_t tree = 0;  ///< that is painted
  std::size_t page = 0;
  geometry::ImpostorBlock block;
  geometry::ImpostorFrame frame;
};

// Which trees are painted, and whose picture each tree that wants one shows.
struct Album {
  std::vector<Picture> pictures;
  std::vector<std::size_t> of_tree;  ///< index in `pictures`
};

Album choose_pictures(std::span<const TreeOrder> trees, const std::vector<std::size_t>& wanted) {
  Album album;
  album.of_tree.assign(trees.size(), 0);
  // Alike ones side by side: by species, then by how slender.
  std::vector<std::size_t> order = wanted;
  const auto slender = [&](std::size_t i) { return trees[i].size.y / std::max(trees[i].size.x, 1e-3f); };
  if (wanted.size() > kMostPictures)
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (trees[a].species != trees[b].species) return trees[a].species < trees[b].species;
      return slender(a) != slender(b) ? slender(a) < slender(b) : a < b;
    });
  const std::size_t n = order.size(), most = std::min(n, kMostPictures);
  for (std::size_t begin = 0; begin < n;) {
    // Even shares of the list, cut where the species changes.
    const std::size_t share = most == n ? 1 : (n + most - 1) / most + 1;
    std::size_t end = begin + 1;
    while (end < n && end < begin + share && trees[order[end]].species == trees[order[begin]].species) ++end;
    for (std::size_t k = begin; k < end; ++k) album.of_tree[order[k]] = album.pictures.size();
    album.pictures.push_back({order[begin + (end - begin) / 2], 0, {}, {}});
    begin = end;
  }
  return album;
}

int power_of_two(int n) {
  int p = 1;
  while (p < n) p *= 2;
  return p;
}

// Gives each picture its place on a page; pages as large as they need to be.
std::vector<Image> make_pages(Album& album) {
  const std::size_t n = album.pictures.size(), per_page = std::size_t{kPageBlocks} * kPageBlocks;
  const int side = n <= kFewPictures ? kFineBlock : kBlock;
  std::vector<Image> pages;
  for (std::size_t first = 0; first < n; first += per_page) {
    const auto here = static_cast<int>(std::min(per_page, n - first));
    const int columns = power_of_two(static_cast<int>(std::sqrt(static_cast<float>(here)) + 0.999f));
    const int rows = power_of_two((here + columns - 1) / columns);
    for (int k = 0; k < here; ++k) {
      Picture& picture = album.pictures[first + static_cast<std::size_t>(k)];
      picture.page = pages.size();
      picture.block = {(k % columns) * side, (k / columns) * side, side};
    }
    pages.emplace_back(columns * side, rows * side, 4);
  }
  return pages;
}

std::vector<geometry::TreeSkins> make_skins(std::span<const TreeOrder> trees, const std::vector<std::size_t>& wanted,
                                            const std::vector<Material>& materials) {
  std::size_t species = 0;
  for (const TreeOrder& tree : trees) species = std::max(species, tree.species + 1);
  std::vector<std::uint8_t> used(species, 0);
  for (std::size_t i : wanted) used[trees[i].species] = 1;
  std::vector<geometry::TreeSkins> skins(species);
  parallel_for(species, [&](std::size_t s) {
    if (!used[s]) return;
    const auto skin = [&](SpeciesPart part) {
      const Material& material = materials[material_of(s, part)];
      return material.base_colour
                 ? geometry::RasterSkin(*material.base_colour, material.mask ? material.alpha_cutoff : 0)
                 : geometry::RasterSkin();
    };
    skins[s] = {skin(kBarkPart), skin(kLeafPart), skin(kMassPart)};
  });
  return skins;
}

std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

std::vector<Part> parts_of(geometry::TreeMesh mesh, std::size_t species) {
  std::vector<Part> parts;
  const SpeciesPart leaves = mesh.foliage == geometry::FoliageLevel::cards ? kMassPart : kLeafPart;
  if (!mesh.branches.empty()) parts.push_back({shared(std::move(mesh.branches)), material_of(species, kBarkPart)});
  if (!mesh.leaves.empty()) parts.push_back({shared(std::move(mesh.leaves)), material_of(species, leaves)});
  return parts;
}

std::size_t triangles(const std::vector<Part>& parts) {
  std::size_t sum = 0;
  for (const Part& part : parts) sum += part.mesh->triangles();
  return sum;
}

// Makes the parts of single trees.
class Builder {
 public:
  Builder(std::span<const TreeOrder> trees, const Album& album, const std::vector<geometry::TreeSkins>& skins,
          const std::vector<Image>& pages, std::size_t first_page_material)
      : trees_(trees), album_(album), skins_(skins), pages_(pages), first_page_material_(first_page_material) {}

  std::vector<Part> mesh(std::size_t i, std::size_t budget, TreeParts* finest = nullptr) const {
    const geometry::TreeInput& in = trees_[i].input;
    geometry::MeshOptions options = in.options;
    options.max_triangles = budget;
    geometry::TreeMesh made = geometry::build_tree_mesh(*in.skeleton, in.radius, *in.look, *in.foliage, options);
    if (finest) {
      finest->leaf_cards = made.leaves.triangles() /
                           std::max<std::size_t>(1, geometry::triangles_per_site(*in.foliage, in.options.foliage));
      finest->wind_m = made.wind_m;
    }
    return parts_of(std::move(made), trees_[i].species);
  }

  std::vector<Part> shell(std::size_t i, std::size_t budget, TreeParts* finest = nullptr) const {
    geometry::TreeInput in = trees_[i].input;
    in.options.max_triangles = budget;
    geometry::TreeMesh made = geometry::build_shell(in, geometry::source_mesh(in), skins_[trees_[i].species]);
    if (finest) finest->wind_m = made.wind_m;
    return parts_of(std::move(made), trees_[i].species);
  }

  std::vector<Part> cards(std::size_t i, std::size_t budget, TreeParts* finest = nullptr) const {
    const Picture& picture = album_.pictures[album_.of_tree[i]];
    const std::size_t count =
        budget >= geometry::kFourCardTriangles ? geometry::kFourCardTriangles : geometry::kTwoCardTriangles;
    const Vec2 painted = trees_[picture.tree].size;
    const Vec2 stretch = picture.tree == i ? Vec2(1.0f) : trees_[i].size / glm::max(painted, Vec2(1e-3f));
    const Image& page = pages_[picture.page];
    TriangleMesh made = geometry::impostor_cards(picture.frame, picture.block, page.width, page.height, count, stretch);
    if (trees_[i].input.options.wind) {
      const geometry::TreeWind wind = geometry::tree_wind(trees_[i].input);
      geometry::lean_with_height(made, wind);
      if (finest) finest->wind_m = wind.longest_m;
    }
    return {
        {shared(std::move(made)), first_page_material_ + 2 * picture.page + (count == geometry::kTwoCardTriangles)}};
  }

 private:
  std::span<const TreeOrder> trees_;
  const Album& album_;
  const std::vector<geometry::TreeSkins>& skins_;
  const std::vector<Image>& pages_;
  std::size_t first_page_material_;
};

// Adds the coarser levels and says down to which coverage each level serves.
void add_levels(const Builder& build, std::size_t i, TreeForm form, TreeParts& out) {
  const auto finest = static_cast<float>(std::max<std::size_t>(1, triangles(out.parts)));
  std::size_t last = triangles(out.parts);
  float* coverage = &out.coverage;
  const auto add = [&](std::vector<Part> parts) {
    const std::size_t n = triangles(parts);
    if (n == 0 || 2 * n > last) return;
    *coverage = std::sqrt(static_cast<float>(n) / finest);
    out.coarser.push_back({std::move(parts), 0.0f});
    coverage = &out.coarser.back().coverage;
    last = n;
  };
  out.coarser.reserve(kMeshLevels + 2);  // `coverage` points into it
  if (form == TreeForm::mesh)
    for (std::size_t k = 0; k < kMeshLevels && last / kCoarser >= geometry::kLeastMeshTriangles; ++k)
      add(build.mesh(i, last / kCoarser));
  if (form == TreeForm::mesh && last >= 2 * kShellTriangles) add(build.shell(i, kShellTriangles));
  if (form != TreeForm::four_cards && form != TreeForm::two_cards) add(build.cards(i, geometry::kFourCardTriangles));
}

}  // namespace

std::vector<TreeParts> build_tree_parts(std::span<const TreeOrder> trees, bool levels, std::vector<Material>& materials,
                                        Progress* progress, const std::function<void(std::size_t)>& done) {
  std::vector<TreeParts> out(trees.size());
  std::vector<std::size_t> pictured, skinned;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const TreeOrder& tree = trees[i];
    TreeForm& form = out[i].form;
    form = tree.budget == 0 || tree.budget >= tree.need
               ? TreeForm::mesh
               : geometry::form_within(tree.budget,
                                       geometry::stems(*tree.input.skeleton, tree.input.options.season_of_growth));
    const bool cards = form == TreeForm::four_cards || form == TreeForm::two_cards;
    if (cards || levels) pictured.push_back(i);
    if (cards || levels || form == TreeForm::shell) skinned.push_back(i);
  }

  const std::vector<geometry::TreeSkins> skins = make_skins(trees, skinned, materials);
  Album album = choose_pictures(trees, pictured);
  std::vector<Image> pages = make_pages(album);
  parallel_for(album.pictures.size(), [&](std::size_t k) {
    if (progress && progress->cancelled()) return;
    Picture& picture = album.pictures[k];
    const TreeOrder& tree = trees[picture.tree];
    picture.frame = geometry::build_picture(geometry::source_mesh(tree.input), skins[tree.species],
                                            {&pages[picture.page], picture.block});
  });

  const std::size_t first_page_material = materials.size();
  const Builder build(trees, album, skins, pages, first_page_material);
  std::vector<float> costs(trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i)
    costs[i] = static_cast<float>(trees[i].budget == 0 ? trees[i].need : std::min(trees[i].budget, trees[i].need));
  parallel_dearest_first(costs, [&](std::size_t i) {
    if (progress && progress->cancelled()) return;
    TreeParts& own = out[i];
    switch (own.form) {
      case TreeForm::mesh:
        own.parts = build.mesh(i, trees[i].budget, &own);
        break;
      case TreeForm::shell:
        own.parts = build.shell(i, trees[i].budget, &own);
        break;
      case TreeForm::four_cards:
      case TreeForm::two_cards:
        own.parts = build.cards(i, trees[i].budget, &own);
        break;
    }
    if (levels) add_levels(build, i, own.form, own);
    if (done) done(i);
    if (progress) progress->advance();
  });

  for (std::size_t p = 0; p < pages.size(); ++p) {
    const auto image = std::make_shared<const Image>(std::move(pages[p]));
    for (const bool both_sides : {false, true}) {
      Material material;
      material.name = fmt::format("impostors-{}{}", p + 1, both_sides ? "-two-sided" : "");
      material.surface = Surface::leaf;
      material.base_colour = image;
      material.roughness = 0.8f;
      material.alpha_cutoff = geometry::kImpostorCutoff;
      material.translucency = kImpostorTranslucency;
      material.mask = material.whole_trees = true;
      material.double_sided = both_sides;
      materials.push_back(std::move(material));
    }
  }
  return out;
}

}  // namespace bosquet::scene
