#include "exchange/gltf_stock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>

#include "core/parallel.h"
#include "exchange/gltf_format.h"
#include "exchange/gltf_images.h"

namespace bosquet::exchange {
namespace {

// A millimetre and a half is enough for wood and leaves, if the mesh is not small itself.
constexpr float kPackedStep_m = 1.5e-3f, kLeastPackedQuanta = 2000.0f;

// Parts of all shown levels, with the node that shows them.
template <class Visit>
void each_part(const scene::Model& model, const GltfOptions& options, const Visit& visit) {
  for (const scene::Node& node : model.nodes)
    for (const auto* parts : shown_levels(node, options))
      for (const scene::Part& part : *parts)
        if (drawable(part)) visit(node, part);
}

// The cards of each leaf mesh, found in parallel, then shared in order.
void find_cards(const scene::Model& model, const GltfOptions& options, GltfStock& stock) {
  std::vector<const TriangleMesh*> leafy;
  std::unordered_map<const TriangleMesh*, bool> seen;
  each_part(model, options, [&](const scene::Node&, const scene::Part& part) {
    const scene::Material& material = model.materials[part.material];
    if ((material.mask || material.surface == scene::Surface::grass) && seen.try_emplace(part.mesh.get(), true).second)
      leafy.push_back(part.mesh.get());
  });
  std::vector<std::optional<std::vector<InstancedCard>>> found(leafy.size());
  parallel_for(leafy.size(), [&](std::size_t i) { found[i] = find_instances(*leafy[i]); });
  CardStock shared;
  for (std::size_t i = 0; i < leafy.size(); ++i) {
    if (!found[i]) continue;
    shared.share(*found[i]);
    stock.owned.push_back(std::make_unique<const std::vector<InstancedCard>>(*std::move(found[i])));
    stock.cards[leafy[i]];
  }
}

// Meshes that some node draws together get one centre and step.
class Quantizer {
 public:
  explicit Quantizer(std::size_t meshes) : parent_(meshes) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  std::size_t root(std::size_t m) {
    while (parent_[m] != m) m = parent_[m] = parent_[parent_[m]];
    return m;
  }
  void join(std::size_t a, std::size_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<std::size_t> parent_;
};

void quantize(const scene::Model& model, const GltfOptions& options, GltfStock& stock) {
  Quantizer groups(stock.meshes.size());
  std::vector<std::uint8_t> placed(stock.meshes.size(), 0);
  for (const scene::Node& node : model.nodes)
    for (const auto* parts : shown_levels(node, options)) {
      std::optional<std::size_t> first;
      for (const scene::Part& part : *parts) {
        if (!drawable(part) || stock.instanced(part)) continue;
        const std::size_t m = stock.mesh_index.at(part.mesh.get());
        placed[m] |= node.translation != Vec3(0.0f);
        groups.join(first.value_or(m), m);
        first = m;
      }
    }
  std::vector<Box3> box(stock.meshes.size());
  for (std::size_t m = 0; m < stock.meshes.size(); ++m) {
    if (!stock.meshes[m].mesh) continue;
    box[groups.root(m)].add(stock.meshes[m].bounds);
    placed[groups.root(m)] |= placed[m];
  }
  for (std::size_t m = 0; m < stock.meshes.size(); ++m) {
    MeshFacts& facts = stock.meshes[m];
    if (facts.instances) facts.quantized = true;
    if (!facts.mesh || !facts.quantized) continue;
    const Box3& own = box[groups.root(m)];
    facts.centre = placed[groups.root(m)] ? Vec3(0.0f) : own.centre();
    const Vec3 reach = glm::max(glm::abs(own.low - facts.centre), glm::abs(own.high - facts.centre));
    const float most = std::max({reach.x, reach.y, reach.z, 1e-6f});
    facts.step = most / kMostQuanta;
    // Packed data shrink with every bit less.
    if (options.compression == Compression::meshopt)
      facts.step = std::max(facts.step, std::min(kPackedStep_m, most / kLeastPackedQuanta));
  }
}

}  // namespace

bool textured(const scene::Material& material, const GltfOptions& options) {
  return (material.base_colour && !material.base_colour->empty()) ||
         uses_normal_map(material, options.leaf_normal_maps);
}

std::vector<const std::vector<scene::Part>*> shown_levels(const scene::Node& node, const GltfOptions& options) {
  std::vector<const std::vector<scene::Part>*> levels{&node.parts};
  if (options.lod != LodFiles::none)
    for (const scene::Level& level : node.coarser) levels.push_back(&level.parts);
  return levels;
}

Result<GltfStock> take_stock(const scene::Model& model, const GltfOptions& options) {
  GltfStock stock;
  stock.material_index.assign(model.materials.size(), -1);
  if (options.instancing) find_cards(model, options, stock);

  const bool small = options.compression != Compression::none;
  const auto add_mesh = [&](const TriangleMesh* mesh, const scene::Node& node, bool quantized) {
    const auto [it, fresh] = stock.mesh_index.try_emplace(mesh, stock.meshes.size());
    if (fresh) {
      MeshFacts& facts = stock.meshes.emplace_back();
      facts.mesh = mesh;
      facts.quantized = quantized;
      facts.coarse_uv = options.compression == Compression::meshopt;
      stock.owners.push_back(node.name);
    }
    return it->second;
  };
  std::size_t next_cards = 0;
  each_part(model, options, [&](const scene::Node& node, const scene::Part& part) {
    assert(part.material < model.materials.size());
    const scene::Material& material = model.materials[part.material];
    const auto uses = [&](std::size_t m) {
      stock.meshes[m].textured |= textured(material, options);
      stock.meshes[m].bumpy |= uses_normal_map(material, options.leaf_normal_maps);
      stock.meshes[m].coarse_uv &= material.surface == scene::Surface::leaf;
    };
    if (const auto instanced = stock.cards.find(part.mesh.get()); instanced != stock.cards.end()) {
      if (instanced->second.empty()) {
        for (const InstancedCard& found : *stock.owned[next_cards]) {
          const std::size_t card = add_mesh(found.card.get(), node, false);
          instanced->second.push_back({card, stock.meshes.size()});
          MeshFacts& facts = stock.meshes.emplace_back();
          facts.instances = &found.instances;
          facts.coloured = std::any_of(found.instances.begin(), found.instances.end(),
                                       [](const Instance& i) { return i.colour != Rgba8(255); });
          stock.owners.push_back(node.name);
        }
        ++next_cards;
      }
      for (const GltfStock::Card& card : instanced->second) uses(card.mesh);
    } else {
      uses(add_mesh(part.mesh.get(), node, small));
    }
    if (stock.material_index[part.material] < 0) {
      stock.material_index[part.material] = static_cast<int>(stock.materials.size());
      stock.materials.push_back(part.material);
    }
  });

  std::vector<std::string> faults(stock.meshes.size());
  parallel_for(stock.meshes.size(), [&](std::size_t m) {
    if (!stock.meshes[m].mesh) return;
    if (const auto measured = measure(stock.meshes[m]); !measured) faults[m] = measured.error().message;
  });
  for (std::size_t m = 0; m < faults.size(); ++m)
    if (!faults[m].empty())
      return cannot_finish(fmt::format("glTF: the mesh of node {}: {}", stock.owners[m], faults[m]));
  if (small) quantize(model, options, stock);
  return stock;
}

}  // namespace bosquet::exchange
