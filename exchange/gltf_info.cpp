#include "exchange/gltf_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace bosquet::exchange {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{1} << 30;
constexpr int kMaxDepth = 64;
constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;

std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
  return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

struct JsonText {
  std::string text;
  std::uint64_t file_bytes = 0;
};

// The JSON chunk of a .glb, or the whole of a .gltf.
Result<JsonText> read_json_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) return Error{fmt::format("there is no file {}", name)};
  if (!std::filesystem::is_regular_file(status))
    return Error{fmt::format("cannot read {}: it is no regular file", name)};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return Error{fmt::format("cannot read {}: {}", name, std::strerror(errno))};

  JsonText out;
  out.file_bytes = std::filesystem::file_size(path, failed);
  if (failed) return Error{fmt::format("cannot read {}: {}", name, failed.message())};
  std::uint32_t header[5] = {};
  const std::size_t words = std::fread(header, 4, 5, file.get());
  std::uint64_t length = out.file_bytes;
  if (words > 0 && header[0] == kGlbMagic) {
    if (words < 5 || header[4] != kJsonChunk) return Error{fmt::format("{} is a .glb without a JSON chunk", name)};
    if (header[1] != 2) return Error{fmt::format("{} is glTF version {}; version 2 is read", name, header[1])};
    if (header[2] > out.file_bytes || header[3] > header[2] - 20)
      return Error{fmt::format("{} is cut short: it says {} bytes and has {}", name, header[2], out.file_bytes)};
    length = header[3];
  } else {
    std::rewind(file.get());
  }
  if (length > kMaxJsonBytes)
    return Error{fmt::format("{}: {} bytes of JSON; at most {} are read", name, length, kMaxJsonBytes)};
  out.text.resize(length);
  if (std::fread(out.text.data(), 1, length, file.get()) != length)
    return Error{fmt::format("cannot read all of {}", name)};
  return out;
}

// How deep brackets nest, strings apart: what parses such text, prints or copies it by recursion.
int nesting(std::string_view json) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (quoted) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

// Reading JSON that may be anything: what is not as it should be is missing.
const Json& member(const Json& object, const char* name) {
  static const Json kNothing;
  if (!object.is_object()) return kNothing;
  const auto it = object.find(name);
  return it == object.end() ? kNothing : *it;
}
const Json& element(const Json& array, const Json& index) {
  static const Json kNothing;
  if (!array.is_array() || !index.is_number_unsigned()) return kNothing;
  const auto i = index.get<std::uint64_t>();
  return i < array.size() ? array[i] : kNothing;
}
std::size_t length(const Json& array) { return array.is_array() ? array.size() : 0; }
std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }
std::uint64_t whole(const Json& value) { return value.is_number_unsigned() ? value.get<std::uint64_t>() : 0; }
std::vector<std::string> texts(const Json& array) {
  std::vector<std::string> out;
  if (array.is_array())
    for (const Json& value : array) out.push_back(text(value));
  return out;
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

}  // namespace

Result<GltfInfo> read_gltf_info(const std::filesystem::path& path) {
  const std::string name = path.string();
  auto json = read_json_text(path);
  if (!json) return json.error();
  if (nesting(json->text) > kMaxDepth)
    return Error{fmt::format("{}: JSON nested deeper than {} levels is not read", name, kMaxDepth)};
  const Json root = Json::parse(json->text, nullptr, false);
  if (root.is_discarded() || !root.is_object())
    return Error{fmt::format("{} is no glTF: its JSON cannot be read", name)};
  const std::string version = text(member(member(root, "asset"), "version"));
  if (version.empty()) return Error{fmt::format("{} is no glTF: it has no asset.version", name)};
  if (version.rfind("2.", 0) != 0) return Error{fmt::format("{} is glTF version {}; version 2 is read", name, version)};

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
  const Json& scene = member(root, "scene");
  info.extras = extras(member(element(member(root, "scenes"), scene.is_null() ? Json(0u) : scene), "extras"));

  // A mesh used by many nodes is counted once.
  const Json &nodes = member(root, "nodes"), &meshes = member(root, "meshes");
  std::vector<std::optional<std::uint64_t>> per_mesh(info.meshes);
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
    info.triangles = plus(info.triangles, node.triangles);
    info.nodes.push_back(std::move(node));
  }
  return info;
}

}  // namespace bosquet::exchange
