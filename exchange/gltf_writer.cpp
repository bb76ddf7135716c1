#include "exchange/gltf_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/parallel.h"
#include "exchange/file_output.h"
#include "exchange/gltf_images.h"
#include "exchange/gltf_meshes.h"

namespace bosquet::exchange {
namespace {

using Json = nlohmann::ordered_json;

// glTF's numbers for things.
constexpr int kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497, kClamp = 33071;
constexpr std::uint32_t kGlbMagic = 0x46546c67, kGlbVersion = 2, kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;

constexpr float kNear = 0.1f, kFar = 20'000.0f;  // metres, of cameras

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) & ~std::uint64_t{3}; }

// The shortest text that reads back as this float, not the dozen digits of its double.
double shortest(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double out = 0;
  std::from_chars(text, end, out);
  return out + 0.0;  // no "-0.0"
}
Json numbers(const Vec3& v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }
Json numbers(const Vec4& v) { return {shortest(v.x), shortest(v.y), shortest(v.z), shortest(v.w)}; }

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Json number(double value) {
  // Whole numbers (ids, seeds, years) without ".0".
  if (value == std::floor(value) && std::abs(value) < 0x1p53) return static_cast<std::int64_t>(value);
  return value;
}

Json to_json(const scene::Extras& extras) {
  Json out = Json::object();
  for (const auto& [name, value] : extras) {
    if (const auto* text = std::get_if<std::string>(&value))
      out[name] = *text;
    else if (const double v = std::get<double>(value); std::isfinite(v))  // JSON has no other numbers
      out[name] = number(v);
  }
  return out;
}

struct HalfAngle {
  double sin, cos;
};

// Of the angle in (-pi, pi] with this sine and cosine; nothing is divided by a small number.
HalfAngle half(double sine, double cosine) {
  if (cosine >= 0) {
    const double c = std::sqrt((1 + cosine) / 2);
    return {sine / (2 * c), c};
  }
  const double s = std::copysign(std::sqrt((1 - cosine) / 2), sine);
  return {s, sine / (2 * s)};
}

// The unit quaternion that turns local +Z to `z` with local +X level: first pitch about X, then yaw about Y. Straight
// down the picture's upper edge is north.
Vec4 facing(DVec3 z) {
  z = glm::normalize(z);
  const double level = std::sqrt(z.x * z.x + z.z * z.z);
  const HalfAngle pitch = half(-z.y, level), yaw = level > 1e-9 ? half(z.x / level, z.z / level) : HalfAngle{0, 1};
  return Vec4(yaw.cos * pitch.sin, yaw.sin * pitch.cos, -yaw.sin * pitch.sin, yaw.cos * pitch.cos);
}

// A URI is ASCII: anything else in a file's name is written as %XX.
std::string uri(const std::string& name) {
  std::string out;
  for (unsigned char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '_' || c == '.' || c == '~';
    if (plain)
      out += static_cast<char>(c);
    else
      out += fmt::format("%{:02X}", c);
  }
  return out;
}

bool drawable(const scene::Part& part) { return part.mesh && !part.mesh->empty(); }

bool coloured(const scene::Material& material) { return material.base_colour && !material.base_colour->empty(); }

bool textured(const scene::Material& material, const GltfOptions& options) {
  return coloured(material) || uses_normal_map(material, options.leaf_normal_maps);
}

// What of the model is used, each once, in order of first use.
struct Stock {
  std::vector<MeshFacts> meshes;
  std::vector<std::string> mesh_owners;  ///< first node of each, for messages
  std::unordered_map<const TriangleMesh*, std::size_t> mesh_index;
  std::vector<std::size_t> materials;
  std::vector<int> material_index;  ///< by the model's number; -1: unused
};

Stock take_stock(const scene::Model& model, const GltfOptions& options) {
  Stock stock;
  stock.material_index.assign(model.materials.size(), -1);
  for (const scene::Node& node : model.nodes) {
    for (const scene::Part& part : node.parts) {
      if (!drawable(part)) continue;
      assert(part.material < model.materials.size());
      const auto [it, fresh] = stock.mesh_index.try_emplace(part.mesh.get(), stock.meshes.size());
      if (fresh) {
        stock.meshes.emplace_back().mesh = part.mesh.get();
        stock.mesh_owners.push_back(node.name);
      }
      const scene::Material& material = model.materials[part.material];
      stock.meshes[it->second].textured |= textured(material, options);
      stock.meshes[it->second].bumpy |= uses_normal_map(material, options.leaf_normal_maps);
      if (stock.material_index[part.material] < 0) {
        stock.material_index[part.material] = static_cast<int>(stock.materials.size());
        stock.materials.push_back(part.material);
      }
    }
  }
  return stock;
}

// The JSON chunk, put together from what was measured and laid out.
class Document {
 public:
  Document(const scene::Model& model, const Stock& stock, const MeshLayout& layout,
           const std::vector<GltfImage>& images, const GltfOptions& options)
      : model_(model), stock_(stock), layout_(layout), images_(images), options_(options) {}

  /// `files` names the .bin, then the images; nothing for a .glb.
  std::string json(std::uint64_t bin_bytes, const std::vector<std::string>& files) {
    root_["asset"] = {{"version", "2.0"},
                      {"generator", options_.version.empty() ? "Bosquet" : "Bosquet " + options_.version}};
    root_["extensionsUsed"] = {"KHR_lights_punctual"};
    root_["scene"] = 0;
    views_and_accessors();
    materials(files);
    nodes();
    add("bufferViews", views_);
    add("accessors", accessors_);
    if (bin_bytes > 0) {
      Json buffer;
      if (!files.empty()) buffer["uri"] = uri(files[0]);
      buffer["byteLength"] = bin_bytes;
      root_["buffers"] = Json::array({buffer});
    }
    return root_.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

 private:
  void add(const char* name, Json& list) {
    if (!list.empty()) root_[name] = std::move(list);
  }

  void views_and_accessors() {
    accessor_of_.resize(stock_.meshes.size());
    for (const MeshGroup& group : layout_.groups) {
      std::array<std::size_t, kStreams> view{};
      for (std::size_t s = 0; s < kStreams; ++s) {
        if (group.views[s].length == 0) continue;
        const auto stream = static_cast<Stream>(s);
        const bool indices = stream == Stream::index_short || stream == Stream::index_int;
        Json v{{"buffer", 0}, {"byteOffset", group.views[s].offset}, {"byteLength", group.views[s].length}};
        if (!indices) v["byteStride"] = element_bytes(stream);
        v["target"] = indices ? kIndexBuffer : kVertexBuffer;
        view[s] = views_.size();
        views_.push_back(std::move(v));
      }
      for (std::size_t m = group.first; m < group.last; ++m) {
        for (std::size_t s = 0; s < kStreams; ++s) {
          const auto stream = static_cast<Stream>(s);
          if (!stock_.meshes[m].has(stream)) continue;
          accessor_of_[m][s] = static_cast<int>(accessors_.size());
          accessors_.push_back(accessor(stock_.meshes[m], stream, view[s], layout_.offsets[m][s]));
        }
      }
    }
  }

  static Json accessor(const MeshFacts& facts, Stream stream, std::size_t view, std::uint64_t offset) {
    Json a{{"bufferView", view}};
    if (offset > 0) a["byteOffset"] = offset;
    const auto type = [&](int component, const char* shape, bool normalized) {
      a["componentType"] = component;
      if (normalized) a["normalized"] = true;
      a["count"] = facts.count(stream);
      a["type"] = shape;
    };
    switch (stream) {
      case Stream::position:
        type(kFloat, "VEC3", false);
        a["min"] = numbers(facts.bounds.low);
        a["max"] = numbers(facts.bounds.high);
        break;
      case Stream::normal:
        type(kFloat, "VEC3", false);
        break;
      case Stream::tangent:
        type(kFloat, "VEC4", false);
        break;
      case Stream::uv_float:
        type(kFloat, "VEC2", false);
        break;
      case Stream::uv_short:
        type(kShort, "VEC2", true);
        break;
      case Stream::colour:
        type(kByte, "VEC4", true);
        break;
      case Stream::index_short:
        type(kShort, "SCALAR", false);
        break;
      case Stream::index_int:
        type(kInt, "SCALAR", false);
        break;
    }
    return a;
  }

  void materials(const std::vector<std::string>& files) {
    Json images = Json::array(), list = Json::array();
    for (std::size_t i = 0; i < images_.size(); ++i) {
      Json image{{"name", images_[i].name}, {"mimeType", images_[i].mime_type()}};
      if (files.empty()) {
        image["bufferView"] = views_.size();
        views_.push_back({{"buffer", 0}, {"byteOffset", image_offset_}, {"byteLength", images_[i].bytes.size()}});
        image_offset_ += padded(images_[i].bytes.size());
      } else {
        image["uri"] = uri(files[i + 1]);
      }
      images.push_back(std::move(image));
    }
    for (std::size_t m : stock_.materials) list.push_back(material(model_.materials[m], cards_only(m)));
    add("images", images);
    add("textures", textures_);
    add("samplers", samplers_);
    add("materials", list);
  }

  // Cut-out cards that stay on their image must not fetch texels from its far side.
  bool cards_only(std::size_t material) const {
    if (!model_.materials[material].mask) return false;
    for (const scene::Node& node : model_.nodes)
      for (const scene::Part& part : node.parts)
        if (part.material == material && drawable(part) &&
            !stock_.meshes[stock_.mesh_index.at(part.mesh.get())].uv_in_unit_square)
          return false;
    return true;
  }

  Json material(const scene::Material& from, bool clamp) {
    const auto unit = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    Json out;
    if (!from.name.empty()) out["name"] = from.name;
    Json& pbr = out["pbrMetallicRoughness"];
    const Vec4 factor = glm::clamp(from.base_factor, 0.0f, 1.0f);
    if (factor != Vec4(1.0f)) pbr["baseColorFactor"] = numbers(factor);
    if (const auto t = texture(from.base_colour.get(), colour_use(from), clamp)) pbr["baseColorTexture"]["index"] = *t;
    pbr["metallicFactor"] = 0;
    pbr["roughnessFactor"] = shortest(unit(from.roughness));
    if (uses_normal_map(from, options_.leaf_normal_maps))
      out["normalTexture"]["index"] = *texture(from.normal.get(), ImageUse::normal, clamp);
    if (from.mask) {
      out["alphaMode"] = "MASK";
      out["alphaCutoff"] = shortest(unit(from.alpha_cutoff));
    } else if (factor.a < 1.0f) {
      out["alphaMode"] = "BLEND";
    }
    if (from.double_sided) out["doubleSided"] = true;
    if (from.translucency > 0) out["extras"]["translucency"] = shortest(from.translucency);
    return out;
  }

  std::optional<std::size_t> texture(const Image* image, ImageUse use, bool clamp) {
    if (!image || image->empty()) return std::nullopt;
    const auto source = std::find_if(images_.begin(), images_.end(),
                                     [&](const GltfImage& i) { return i.image == image && i.use == use; });
    assert(source != images_.end());
    const std::size_t sampler = sampler_for(clamp);
    const std::pair key{static_cast<std::size_t>(source - images_.begin()), sampler};
    const auto [it, fresh] = texture_index_.try_emplace(key, textures_.size());
    if (fresh) textures_.push_back({{"sampler", sampler}, {"source", key.first}});
    return it->second;
  }

  std::size_t sampler_for(bool clamp) {
    auto& known = sampler_index_[clamp];
    if (!known) {
      known = samplers_.size();
      const int wrap = clamp ? kClamp : kRepeat;
      samplers_.push_back(
          {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", wrap}, {"wrapT", wrap}});
    }
    return *known;
  }

  // The number of the glTF mesh that draws these parts.
  std::size_t mesh_of(const scene::Node& node) {
    std::vector<std::pair<std::size_t, int>> key;
    for (const scene::Part& part : node.parts)
      if (drawable(part)) key.emplace_back(stock_.mesh_index.at(part.mesh.get()), stock_.material_index[part.material]);
    const auto [it, fresh] = gltf_mesh_index_.try_emplace(key, meshes_.size());
    if (!fresh) return it->second;
    Json primitives = Json::array();
    for (const auto& [m, material] : key) primitives.push_back(primitive(m, material));
    Json mesh;
    if (!node.name.empty()) mesh["name"] = node.name;
    mesh["primitives"] = std::move(primitives);
    meshes_.push_back(std::move(mesh));
    return it->second;
  }

  Json primitive(std::size_t m, int material) const {
    const MeshFacts& facts = stock_.meshes[m];
    Json attributes;
    const auto add_stream = [&](const char* name, Stream stream) {
      if (facts.has(stream)) attributes[name] = accessor_of_[m][static_cast<std::size_t>(stream)];
    };
    add_stream("POSITION", Stream::position);
    add_stream("NORMAL", Stream::normal);
    // A mesh may be drawn with a texture here and without there.
    const scene::Material& look = model_.materials[stock_.materials[static_cast<std::size_t>(material)]];
    if (uses_normal_map(look, options_.leaf_normal_maps)) add_stream("TANGENT", Stream::tangent);
    if (textured(look, options_)) {
      add_stream("TEXCOORD_0", Stream::uv_float);
      add_stream("TEXCOORD_0", Stream::uv_short);
    }
    add_stream("COLOR_0", Stream::colour);
    const Stream indices = facts.has(Stream::index_short) ? Stream::index_short : Stream::index_int;
    return {{"attributes", std::move(attributes)},
            {"indices", accessor_of_[m][static_cast<std::size_t>(indices)]},
            {"material", material}};
  }

  void nodes() {
    Json list = Json::array(), cameras = Json::array();
    for (const scene::Node& node : model_.nodes) {
      Json out;
      if (!node.name.empty()) out["name"] = node.name;
      if (std::any_of(node.parts.begin(), node.parts.end(), drawable)) out["mesh"] = mesh_of(node);
      if (node.translation != Vec3(0.0f)) out["translation"] = numbers(node.translation);
      if (Json extras = to_json(node.extras); !extras.empty()) out["extras"] = std::move(extras);
      list.push_back(out.is_null() ? Json::object() : std::move(out));
    }
    for (const scene::Camera& camera : model_.cameras) {
      Json out;
      if (!camera.name.empty()) out["name"] = camera.name;
      out["camera"] = cameras.size();
      if (camera.eye != Vec3(0.0f)) out["translation"] = numbers(camera.eye);
      const DVec3 back = DVec3(camera.eye) - DVec3(camera.target);
      out["rotation"] = numbers(facing(back == DVec3(0.0) ? DVec3(0, 0, 1) : back));
      list.push_back(std::move(out));
      cameras.push_back({{"type", "perspective"},
                         {"perspective",
                          {{"yfov", shortest(radians(camera.vertical_fov_deg))},
                           {"znear", shortest(kNear)},
                           {"zfar", shortest(kFar)}}}});
    }
    // A directional light shines along its node's -Z.
    list.push_back({{"name", "sun"},
                    {"rotation", numbers(facing(DVec3(model_.sun.direction())))},
                    {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    root_["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"name", "sun"}, {"type", "directional"}, {"intensity", shortest(options_.sun_intensity)}}});
    Json scene{{"nodes", Json::array()}};
    for (std::size_t i = 0; i < list.size(); ++i) scene["nodes"].push_back(i);
    if (Json extras = to_json(model_.extras); !extras.empty()) scene["extras"] = std::move(extras);
    root_["scenes"] = Json::array({std::move(scene)});
    add("nodes", list);
    add("meshes", meshes_);
    add("cameras", cameras);
  }

 public:
  std::uint64_t image_offset_ = 0;  ///< where the images of a .glb begin in the buffer

 private:
  const scene::Model& model_;
  const Stock& stock_;
  const MeshLayout& layout_;
  const std::vector<GltfImage>& images_;
  const GltfOptions& options_;

  Json root_, views_ = Json::array(), accessors_ = Json::array(), textures_ = Json::array(), samplers_ = Json::array(),
              meshes_ = Json::array();
  std::vector<std::array<int, kStreams>> accessor_of_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> texture_index_;
  std::optional<std::size_t> sampler_index_[2];
  std::map<std::vector<std::pair<std::size_t, int>>, std::size_t> gltf_mesh_index_;
};

Result<void> check_numbers(const scene::Model& model) {
  for (const scene::Node& node : model.nodes)
    if (!finite(node.translation))
      return cannot_finish(fmt::format("glTF: the place of node {} is not finite", node.name));
  for (const scene::Camera& camera : model.cameras) {
    if (!finite(camera.eye) || !finite(camera.target))
      return cannot_finish(fmt::format("glTF: the place of camera {} is not finite", camera.name));
    if (!(camera.vertical_fov_deg > 0.0f && camera.vertical_fov_deg < 180.0f))
      return Error{fmt::format("camera {}: a field of view of {} degrees; it lies between 0 and 180", camera.name,
                               camera.vertical_fov_deg)};
  }
  return {};
}

Result<void> measure_all(Stock& stock) {
  std::vector<std::string> faults(stock.meshes.size());
  parallel_for(stock.meshes.size(), [&](std::size_t m) {
    if (const auto measured = measure(stock.meshes[m]); !measured) faults[m] = measured.error().message;
  });
  for (std::size_t m = 0; m < faults.size(); ++m)
    if (!faults[m].empty())
      return cannot_finish(fmt::format("glTF: the mesh of node {}: {}", stock.mesh_owners[m], faults[m]));
  return {};
}

std::string in_gigabytes(std::uint64_t bytes) {
  return bytes < 1'000'000'000 ? fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6)
                               : fmt::format("{:.2f} GB", static_cast<double>(bytes) / 1e9);
}

const Error kCancelled = cannot_finish("cancelled while writing glTF");

// The vertex data, group by group; false when cancelled.
bool stream_meshes(FileOutput& file, const Stock& stock, const MeshLayout& layout, const GltfOptions& options) {
  std::vector<std::byte> bytes;
  for (const MeshGroup& group : layout.groups) {
    if (options.progress && options.progress->cancelled()) return false;
    if (file.failed()) return true;  // commit() will say why
    encode_group(stock.meshes, layout, group, options.reorder, bytes);
    file.write(bytes);
    if (options.progress) options.progress->advance(group.last - group.first);
  }
  return true;
}

void pad(FileOutput& file, std::uint64_t bytes, char with) { file.write(std::string(padded(bytes) - bytes, with)); }

template <class... Words>
void write_words(FileOutput& file, Words... words) {
  const std::uint32_t all[] = {static_cast<std::uint32_t>(words)...};
  file.write(std::as_bytes(std::span(all)));
}

Result<std::uint64_t> write_glb(const std::filesystem::path& path, const scene::Model& model, const Stock& stock,
                                const MeshLayout& layout, const std::vector<GltfImage>& images,
                                const GltfOptions& options) {
  std::uint64_t bin_bytes = layout.bytes;
  for (const GltfImage& image : images) bin_bytes += padded(image.bytes.size());
  Document document(model, stock, layout, images, options);
  document.image_offset_ = layout.bytes;
  const std::string json = document.json(bin_bytes, {});

  const std::uint64_t total = 12 + 8 + padded(json.size()) + (bin_bytes > 0 ? 8 + bin_bytes : 0);
  if (total > options.max_glb_bytes)
    return Error{fmt::format(
        "{} would have {} ({} triangles), but a .glb ends at {}: set a smaller --max-triangles or --detail, or write a "
        ".gltf, whose .bin may be larger",
        path.string(), in_gigabytes(total), count(model).triangles, in_gigabytes(options.max_glb_bytes))};

  auto file = FileOutput::create(path);
  if (!file) return file.error();
  write_words(*file, kGlbMagic, kGlbVersion, total);
  write_words(*file, padded(json.size()), kJsonChunk);
  file->write(json);
  pad(*file, json.size(), ' ');
  if (bin_bytes > 0) {
    write_words(*file, bin_bytes, kBinChunk);
    if (!stream_meshes(*file, stock, layout, options)) return kCancelled;
    for (const GltfImage& image : images) {
      file->write(image.bytes);
      pad(*file, image.bytes.size(), '\0');
    }
  }
  assert(file->failed() || file->bytes() == total);
  return file->commit();
}

Result<std::uint64_t> write_separate(const std::filesystem::path& path, const scene::Model& model, const Stock& stock,
                                     const MeshLayout& layout, const std::vector<GltfImage>& images,
                                     const GltfOptions& options) {
  const std::string stem = path.stem().string();
  std::vector<std::string> names{stem + ".bin"};
  for (const GltfImage& image : images) names.push_back(stem + "-" + image.name + image.ending());
  const std::string json = Document(model, stock, layout, images, options).json(layout.bytes, names);

  // All files are written before the first appears, and the .gltf that names the others appears last.
  std::vector<FileOutput> files;
  const auto open = [&](const std::filesystem::path& target) -> Result<void> {
    auto file = FileOutput::create(target);
    if (!file) return file.error();
    files.push_back(*std::move(file));
    return {};
  };
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (auto opened = open(path.parent_path() / names[i + 1]); !opened) return opened.error();
    files.back().write(images[i].bytes);
  }
  if (layout.bytes > 0) {
    if (auto opened = open(path.parent_path() / names[0]); !opened) return opened.error();
    if (!stream_meshes(files.back(), stock, layout, options)) return kCancelled;
  }
  if (auto opened = open(path); !opened) return opened.error();
  files.back().write(json);

  std::uint64_t total = 0;
  for (FileOutput& file : files) {
    const auto written = file.commit();
    if (!written) return written.error();
    total += *written;
  }
  return total;
}

}  // namespace

ModelCount count(const scene::Model& model) {
  ModelCount out;
  std::unordered_map<const TriangleMesh*, bool> seen;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!drawable(part)) continue;
      out.triangles += part.mesh->triangles();
      if (seen.try_emplace(part.mesh.get(), true).second) out.vertices += part.mesh->positions.size();
    }
  return out;
}

Result<std::uint64_t> write_gltf(const scene::Model& model, const std::filesystem::path& path,
                                 const GltfOptions& options) {
  const std::string ending = path.extension().string();
  if (ending != ".glb" && ending != ".gltf")
    return Error{fmt::format("{}: a glTF file ends in .glb or .gltf", path.string())};
  if (auto checked = check_numbers(model); !checked) return checked.error();
  Stock stock = take_stock(model, options);
  if (options.progress) options.progress->begin("export", stock.meshes.size());
  if (auto measured = measure_all(stock); !measured) return measured.error();
  const MeshLayout layout = lay_out(stock.meshes);
  const auto images = encode_images(model.materials, stock.materials, options.leaf_normal_maps, options.textures);
  if (options.progress && options.progress->cancelled()) return kCancelled;
  return ending == ".glb" ? write_glb(path, model, stock, layout, images, options)
                          : write_separate(path, model, stock, layout, images, options);
}

}  // namespace bosquet::exchange
