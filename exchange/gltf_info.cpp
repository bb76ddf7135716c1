#include "exchange/gltf_info.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "exchange/gltf_json.h"

namespace bosquet::exchange {
namespace {

using Json = nlohmann::json;

constexpr int kMostGenerations = 8;  // from a mesh up to the node that bears a tree's name

std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
  return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b ? std::numeric_limits<std::uint64_t>::max()
                                                                     : a * b;
}

const Json& array(const Json& value) {
  static const Json kNothing = Json::array();
  return value.is_array() ? value : kNothing;
}

scene::Extras extras(const Json& object) {
  scene::Extras out;
  if (!object.is_object()) return out;
  for (const auto& [name, value] : object.items()) {
    if (value.is_number())
      out.emplace_back(name, value.get<double>());
    else if (value.is_string())
      out.emplace_back(name, value.get<std::string>());
    else
      out.emplace_back(name, value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  return out;
}

std::uint64_t triangles(const Json& root, const Json& mesh) {
  constexpr std::uint64_t kTriangles = 4, kStrip = 5, kFan = 6;
  std::uint64_t sum = 0;
  const Json &primitives = member(mesh, "primitives"), &accessors = member(root, "accessors");
  if (!primitives.is_array()) return 0;
  for (const Json& primitive : primitives) {
    const Json& mode = member(primitive, "mode");
    const std::uint64_t kind = mode.is_null() ? kTriangles : whole(mode);
    const Json& indices = member(primitive, "indices");
    const Json& counted = indices.is_null() ? member(member(primitive, "attributes"), "POSITION") : indices;
    const std::uint64_t corners = whole(member(element(accessors, counted), "count"));
    if (kind == kTriangles) sum = plus(sum, corners / 3);
    if ((kind == kStrip || kind == kFan) && corners > 2) sum = plus(sum, corners - 2);
  }
  return sum;
}

// Position accessors of all meshes, each once.
std::uint64_t stored_vertices(const Json& root) {
  const Json &meshes = member(root, "meshes"), &accessors = member(root, "accessors");
  std::vector<bool> seen(length(accessors), false);
  std::uint64_t sum = 0;
  if (!meshes.is_array()) return 0;
  for (const Json& mesh : meshes) {
    const Json& primitives = member(mesh, "primitives");
    if (!primitives.is_array()) continue;
    for (const Json& primitive : primitives) {
      const Json& position = member(member(primitive, "attributes"), "POSITION");
      const Json& accessor = element(accessors, position);
      if (accessor.is_null() || seen[position.get<std::size_t>()]) continue;
      seen[position.get<std::size_t>()] = true;
      sum = plus(sum, whole(member(accessor, "count")));
    }
  }
  return sum;
}

// Meshes some part of which says how it gives way to the wind.
std::size_t meshes_with_wind(const Json& root) {
  const auto windy = [](const Json& primitive) { return !member(member(primitive, "attributes"), "_WIND").is_null(); };
  std::size_t n = 0;
  for (const Json& mesh : array(member(root, "meshes"))) {
    const Json& primitives = array(member(mesh, "primitives"));
    n += std::any_of(primitives.begin(), primitives.end(), windy);
  }
  return n;
}

}  // namespace

Result<GltfInfo> read_gltf_info(const std::filesystem::path& path) {
  const auto json = read_gltf_json(path);
  if (!json) return json.error();
  const Json& root = json->root;

  GltfInfo info;
  info.file_bytes = json->file_bytes;
  info.generator = text(member(member(root, "asset"), "generator"));
  info.extensions_used = texts(member(root, "extensionsUsed"));
  info.extensions_required = texts(member(root, "extensionsRequired"));
  info.meshes = length(member(root, "meshes"));
  info.materials = length(member(root, "materials"));
  info.images = length(member(root, "images"));
  info.cameras = length(member(root, "cameras"));
  info.lights = length(member(member(member(root, "extensions"), "KHR_lights_punctual"), "lights"));
  info.vertices = stored_vertices(root);
  info.wind_meshes = meshes_with_wind(root);
  const Json& scene = member(root, "scene");
  info.extras = extras(member(element(member(root, "scenes"), scene.is_null() ? Json(0u) : scene), "extras"));

  // Meshes used by many nodes are counted once, instances all; coarser levels are not drawn beside the finest: those of
  // MSFT_lod, and children NAME_LOD1, NAME_LOD2 ... of a node NAME.
  const Json &nodes = member(root, "nodes"), &meshes = member(root, "meshes");
  std::vector<std::optional<std::uint64_t>> per_mesh(info.meshes);
  std::vector<bool> coarser(length(nodes), false);
  for (const Json& node : array(nodes))
    for (const Json& id : array(member(member(member(node, "extensions"), "MSFT_lod"), "ids")))
      if (id.is_number_unsigned() && id.get<std::uint64_t>() < coarser.size()) coarser[id.get<std::size_t>()] = true;
  for (std::size_t i = 0; i < length(nodes); ++i) {
    const Json& from = nodes[i];
    GltfNode node;
    node.name = text(member(from, "name"));
    node.extras = extras(member(from, "extras"));
    const Json& move = member(from, "translation");
    if (length(move) == 3)
      for (int k = 0; k < 3; ++k)
        if (move[static_cast<std::size_t>(k)].is_number())
          node.translation[k] = move[static_cast<std::size_t>(k)].get<double>();
    const Json& mesh = member(from, "mesh");
    if (!element(meshes, mesh).is_null()) {
      auto& count = per_mesh[mesh.get<std::size_t>()];
      if (!count) count = triangles(root, element(meshes, mesh));
      node.triangles = *count;
    }
    const Json& instances = member(member(member(from, "extensions"), "EXT_mesh_gpu_instancing"), "attributes");
    if (instances.is_object() && !instances.empty())
      node.triangles =
          times(node.triangles, whole(member(element(member(root, "accessors"), *instances.begin()), "count")));
    info.nodes.push_back(std::move(node));
  }

  // A tree's triangles may hang below its node.
  std::vector<std::size_t> parent(info.nodes.size(), info.nodes.size());
  for (std::size_t i = 0; i < info.nodes.size(); ++i)
    for (const Json& child : array(member(nodes[i], "children")))
      if (child.is_number_unsigned() && child.get<std::uint64_t>() < parent.size()) {
        const auto c = child.get<std::size_t>();
        parent[c] = i;
        const std::string level = info.nodes[i].name + "_LOD";
        if (info.nodes[c].name.starts_with(level) && info.nodes[c].name != level + "0") coarser[c] = true;
      }
  std::vector<std::uint64_t> own;
  for (const GltfNode& node : info.nodes) own.push_back(node.triangles);
  for (std::size_t i = 0; i < own.size(); ++i) {
    bool drawn = !coarser[i];
    std::size_t above = parent[i];
    for (int step = 0; drawn && above < own.size() && step < kMostGenerations; ++step, above = parent[above]) {
      info.nodes[above].triangles = plus(info.nodes[above].triangles, own[i]);
      drawn = !coarser[above];
    }
    if (drawn) info.triangles = plus(info.triangles, own[i]);
  }
  return info;
}

}  // namespace bosquet::exchange
