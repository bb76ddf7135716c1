#include "exchange/mesh_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/letters.h"
#include "exchange/gltf_info.h"

namespace bosquet::exchange {
namespace {

constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{1} << 31;
constexpr std::size_t kMostTriangles = 20'000'000;
constexpr int kMostNodeDepth = 64;

// A corner of each triangle; faces get their normals at the end.
struct Soup {
  std::vector<Vec3> corners;

  Result<TriangleMesh> mesh(const std::string& name) const {
    TriangleMesh out;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
      const Vec3 normal = glm::cross(corners[t + 1] - corners[t], corners[t + 2] - corners[t]);
      const float length = glm::length(normal);
      if (!std::isfinite(length)) return Error{fmt::format("{}: a vertex is not a number or absurdly far", name)};
      if (length == 0.0f) continue;
      for (std::size_t c = t; c < t + 3; ++c) {
        out.indices.push_back(static_cast<std::uint32_t>(out.positions.size()));
        out.positions.push_back(corners[c]);
        out.normals.push_back(normal / length);
      }
    }
    if (out.empty()) return Error{fmt::format("{} has no triangles", name)};
    return out;
  }
};

class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& path) : path_(path), name_(path.string()) {}

  Result<TriangleMesh> read() {
    std::ifstream file(path_, std::ios::binary);
    if (!file) return Error{fmt::format("cannot read {}", name_)};
    std::string line;
    for (line_ = 1; std::getline(file, line); ++line_)
      if (auto fine = take(line); !fine) return fine.error();
    return soup_.mesh(name_);
  }

 private:
  Result<void> take(std::string_view line) {
    const std::string_view word = next(line);
    if (word == "v") {
      Vec3 p;
      for (int a = 0; a < 3; ++a) {
        const std::string_view text = next(line);
        float v = 0;
        const auto [end, ok] = std::from_chars(text.data(), text.data() + text.size(), v);
        if (ok != std::errc() || end != text.data() + text.size() || !std::isfinite(v))
          return wrong(fmt::format("'{}' is no coordinate", text));
        p[a] = v;
      }
      vertices_.push_back(p);
    } else if (word == "f") {
      std::vector<Vec3> face;
      for (std::string_view text = next(line); !text.empty(); text = next(line)) {
        // "7", "7/1", "7//3", "7/1/3"; below 0 it counts from the last vertex.
        text = text.substr(0, text.find('/'));
        std::int64_t n = 0;
        const auto [end, ok] = std::from_chars(text.data(), text.data() + text.size(), n);
        const auto count = static_cast<std::int64_t>(vertices_.size());
        const std::int64_t at = n < 0 ? count + n : n - 1;
        if (ok != std::errc() || end != text.data() + text.size() || n == 0 || at < 0 || at >= count)
          return wrong(fmt::format("'{}' is none of the {} vertices before it", text, count));
        face.push_back(vertices_[static_cast<std::size_t>(at)]);
      }
      if (face.size() < 3) return wrong("a face needs three vertices");
      for (std::size_t n = 2; n < face.size(); ++n)
        soup_.corners.insert(soup_.corners.end(), {face[0], face[n - 1], face[n]});
      if (soup_.corners.size() > 3 * kMostTriangles)
        return wrong(fmt::format("more than {} triangles are no obstacle", kMostTriangles));
    }
    return {};
  }
  static std::string_view next(std::string_view& line) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t from = std::min(line.find_first_not_of(kBlank), line.size());
    const std::size_t to = std::min(line.find_first_of(kBlank, from), line.size());
    const std::string_view word = line.substr(from, to - from);
    line.remove_prefix(to);
    return word;
  }
  Error wrong(const std::string& what) const { return {fmt::format("{}:{}: {}", name_, line_, what)}; }

  std::filesystem::path path_;
  std::string name_;
  int line_ = 0;
  std::vector<Vec3> vertices_;
  Soup soup_;
};

class GltfReader {
 public:
  explicit GltfReader(const std::filesystem::path& path) : path_(path), name_(path.string()) {}

  Result<TriangleMesh> read() {
    // Our own reader refuses what is too large or too deep, and indices that do not exist.
    if (auto info = read_gltf_info(path_); !info) return info.error();
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                             void*) { return true; },
                          nullptr);
    std::string error, warning;
    const bool good = folded_letters(path_.extension().string()) == ".glb"
                          ? reader.LoadBinaryFromFile(&model_, &error, &warning, name_)
                          : reader.LoadASCIIFromFile(&model_, &error, &warning, name_);
    if (!good) {
      while (!error.empty() && error.back() == '\n') error.pop_back();
      return Error{fmt::format("cannot read {}: {}", name_, error.empty() ? "it is damaged" : error)};
    }
    std::vector<int> roots;
    if (!model_.scenes.empty()) {
      const int scene = std::clamp(model_.defaultScene, 0, static_cast<int>(model_.scenes.size()) - 1);
      roots = model_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    for (int root : roots)
      if (auto fine = visit(root, glm::dmat4(1.0), 0); !fine) return fine.error();
    return soup_.mesh(name_);
  }

 private:
  Result<void> visit(int index, const glm::dmat4& above, int depth) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size()) return damaged("a node that is not there");
    if (depth > kMostNodeDepth) return damaged("nodes nested too deep, or in a ring");
    if (visited_.empty()) visited_.resize(model_.nodes.size());
    if (visited_[static_cast<std::size_t>(index)]) return damaged("a node with two parents");
    visited_[static_cast<std::size_t>(index)] = true;
    const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
    const glm::dmat4 here = above * matrix(node);
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) return damaged("a mesh that is not there");
      for (const tinygltf::Primitive& p : model_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        if (auto fine = take(p, here); !fine) return fine;
    }
    for (int child : node.children)
      if (auto fine = visit(child, here, depth + 1); !fine) return fine;
    return {};
  }

  static glm::dmat4 matrix(const tinygltf::Node& node) {
    glm::dmat4 m(1.0);
    if (node.matrix.size() == 16) {
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) m[c][r] = node.matrix[static_cast<std::size_t>(4 * c + r)];
      return m;
    }
    if (node.rotation.size() == 4) {
      const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
      m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
      m[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
      m[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
    }
    if (node.scale.size() == 3)
      for (int c = 0; c < 3; ++c) m[c] *= node.scale[static_cast<std::size_t>(c)];
    if (node.translation.size() == 3) m[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    return m;
  }

  Result<void> take(const tinygltf::Primitive& p, const glm::dmat4& to_scene) {
    if (p.mode != TINYGLTF_MODE_TRIANGLES && p.mode != -1) return {};
    const auto found = p.attributes.find("POSITION");
    if (found == p.attributes.end()) return {};
    const auto positions = elements(found->second, TINYGLTF_TYPE_VEC3);
    if (!positions) return damaged("positions outside their buffer (compressed meshes are not read)");
    if (positions->component != TINYGLTF_COMPONENT_TYPE_FLOAT) return damaged("positions that are no floats");
    std::optional<Elements> indices;
    if (p.indices >= 0 && !(indices = elements(p.indices, TINYGLTF_TYPE_SCALAR)))
      return damaged("indices outside their buffer");
    const std::size_t n = indices ? indices->count : positions->count;
    if (soup_.corners.size() + n > 3 * kMostTriangles)
      return Error{fmt::format("{}: more than {} triangles are no obstacle", name_, kMostTriangles)};
    for (std::size_t i = 0; i + 2 < n; i += 3)
      for (std::size_t c = i; c < i + 3; ++c) {
        const std::size_t v = indices ? index(*indices, c) : c;
        if (v >= positions->count) return damaged("an index beyond its vertices");
        float xyz[3];
        std::memcpy(xyz, positions->data + v * positions->stride, sizeof xyz);
        const glm::dvec4 at = to_scene * glm::dvec4(xyz[0], xyz[1], xyz[2], 1.0);
        soup_.corners.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z));
      }
    return {};
  }

  struct Elements {
    const unsigned char* data = nullptr;
    std::size_t count = 0, stride = 0;
    int component = 0;
  };
  // Where an accessor's elements lie; nothing when any of it lies outside.
  std::optional<Elements> elements(int accessor, int type) const {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size()) return {};
    const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
    if (a.type != type || a.sparse.isSparse || a.bufferView < 0 ||
        static_cast<std::size_t>(a.bufferView) >= model_.bufferViews.size())
      return {};
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(a.bufferView)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size()) return {};
    const std::vector<unsigned char>& bytes = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    const int component = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    const int stride = a.ByteStride(view);
    if (component <= 0 || stride <= 0) return {};
    const std::size_t size = static_cast<std::size_t>(component) * (type == TINYGLTF_TYPE_VEC3 ? 3 : 1);
    const std::size_t from = view.byteOffset + a.byteOffset, step = static_cast<std::size_t>(stride);
    if (from > bytes.size() || a.count == 0 || size > bytes.size() - from) return {};
    if ((bytes.size() - from - size) / step < a.count - 1) return {};
    return Elements{bytes.data() + from, a.count, step, a.componentType};
  }
  static std::size_t index(const Elements& e, std::size_t n) {
    const unsigned char* at = e.data + n * e.stride;
    if (e.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *at;
    if (e.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
      std::uint16_t v;
      std::memcpy(&v, at, sizeof v);
      return v;
    }
    std::uint32_t v = 0xffffffffu;
    if (e.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) std::memcpy(&v, at, sizeof v);
    return v;
  }
  Error damaged(const std::string& by) const { return {fmt::format("{} is damaged: {}", name_, by)}; }

  std::filesystem::path path_;
  std::string name_;
  tinygltf::Model model_;
  std::vector<bool> visited_;  ///< by node
  Soup soup_;
};

}  // namespace

Result<TriangleMesh> read_mesh(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::exists(path, failed)) return Error{fmt::format("there is no file {}", path.string())};
  if (!std::filesystem::is_regular_file(path, failed))
    return Error{fmt::format("cannot read {}: it is no regular file", path.string())};
  if (std::filesystem::file_size(path, failed) > kMostMeshBytes)
    return Error{fmt::format("{} is larger than {} GiB", path.string(), kMostMeshBytes >> 30)};
  const std::string ending = folded_letters(path.extension().string());
  if (ending == ".obj") return ObjReader(path).read();
  if (ending == ".glb" || ending == ".gltf") return GltfReader(path).read();
  return Error{
      fmt::format("{}: unknown kind of mesh '{}'; known: .glb .gltf .obj", path.string(), path.extension().string())};
}

}  // namespace bosquet::exchange
