#include "exchange/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "exchange/gltf_format.h"

namespace bosquet::exchange {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr float kNear = 0.1f, kFar = 20'000.0f;  // metres, of cameras

// The shortest text that reads back as this float, not the dozen digits of its double.
double shortest(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double out = 0;
  std::from_chars(text, end, out);
  return out + 0.0;  // no "-0.0"
}
OrderedJson numbers(const Vec3& v) { return {shortest(v.x), shortest(v.y), shortest(v.z)}; }
OrderedJson numbers(const Vec4& v) { return {shortest(v.x), shortest(v.y), shortest(v.z), shortest(v.w)}; }

OrderedJson number(double value) {
  // Whole numbers (ids, seeds, years) without ".0".
  if (value == std::floor(value) && std::abs(value) < 0x1p53) return static_cast<std::int64_t>(value);
  return value;
}

OrderedJson to_json(const scene::Extras& extras) {
  OrderedJson out = OrderedJson::object();
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

std::string dumped(const OrderedJson& json) { return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace); }

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

// A list of the root, kept as text in pieces: a forest's thousands of accessors, meshes and nodes would take some ten times
// as much memory as values.
class TextList {
 public:
  std::size_t size() const { return size_; }
  void push_back(const OrderedJson& item) {
    if (pieces_.empty() || pieces_.back().size() > kPieceBytes) pieces_.emplace_back();
    pieces_.back() += size_++ == 0 ? '[' : ',';
    pieces_.back() += dumped(item);
  }
  std::vector<std::string> take() {
    pieces_.back() += ']';
    return std::move(pieces_);
  }

 private:
  std::vector<std::string> pieces_;
  std::size_t size_ = 0;
};

// The JSON chunk, put together from what was measured and laid out.
class Document {
 public:
  Document(const GltfContent& content, const GltfOptions& options)
      : model_(*content.model),
        stock_(*content.stock),
        layout_(*content.layout),
        images_(*content.images),
        packed_(content.packed),
        options_(options) {}

  std::vector<std::string> json(const GltfFiles& files) {
    image_offset_ = packed_ ? packed_->bytes : layout_.bytes;
    root_["asset"] = {{"version", "2.0"},
                      {"generator", options_.version.empty() ? "Bosquet" : "Bosquet " + options_.version}};
    const std::vector<std::string> used = used_extensions(stock_, model_, options_);
    root_["extensionsUsed"] = used;
    if (const auto required = required_extensions(used, files); !required.empty())
      root_["extensionsRequired"] = required;
    root_["scene"] = 0;
    views_and_accessors();
    materials(files.images);
    nodes();
    add("bufferViews", views_);
    add("accessors", accessors_);
    buffers(files);
    std::vector<std::string> text;
    for (const auto& [key, value] : root_.items()) {
      text.push_back((text.empty() ? "{\"" : ",\"") + key + "\":");
      if (const auto list = lists_.find(key); list == lists_.end())
        text.push_back(dumped(value));
      else
        std::move(list->second.begin(), list->second.end(), std::back_inserter(text));
    }
    text.push_back("}");
    return text;
  }

 private:
  void add(const char* name, OrderedJson& list) {
    if (!list.empty()) root_[name] = std::move(list);
  }
  // Its place among the others is kept.
  void add(const char* name, TextList& list) {
    if (list.size() > 0) root_[name] = nullptr, lists_[name] = list.take();
  }

  // Buffer 0 holds what is in the file; with packed views buffer 1 is what they unpack to, in a file of its own or
  // nowhere.
  void buffers(const GltfFiles& files) {
    OrderedJson list = OrderedJson::array();
    const std::uint64_t bytes = (packed_ ? packed_->bytes : layout_.bytes) + (files.separate ? 0 : image_bytes());
    if (bytes > 0) {
      OrderedJson& buffer = list.emplace_back(OrderedJson::object());
      if (files.separate) buffer["uri"] = uri(files.data);
      buffer["byteLength"] = bytes;
    }
    if (packed_ && layout_.bytes > 0) {
      OrderedJson& buffer = list.emplace_back(OrderedJson::object());
      if (!files.fallback.empty()) buffer["uri"] = uri(files.fallback);
      buffer["byteLength"] = layout_.bytes;
      buffer["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
    }
    add("buffers", list);
  }

  std::uint64_t image_bytes() const {
    std::uint64_t sum = 0;
    for (const GltfImage& image : images_) sum += padded(image.bytes.size());
    return sum;
  }

  OrderedJson view(const MeshGroup& group, std::size_t g, std::size_t s) const {
    const auto stream = static_cast<Stream>(s);
    const std::uint64_t offset = group.views[s].offset, length = group.views[s].length, size = element_bytes(stream);
    OrderedJson v{{"buffer", packed_ ? 1 : 0}, {"byteOffset", offset}, {"byteLength", length}};
    if (!is_of_instances(stream)) {
      if (!is_index(stream)) v["byteStride"] = size;
      v["target"] = is_index(stream) ? kIndexBuffer : kVertexBuffer;
    }
    if (packed_) {
      const PackedViews::View& packed = packed_->views[g][s];
      v["extensions"]["EXT_meshopt_compression"] = {
          {"buffer", 0},        {"byteOffset", packed.offset}, {"byteLength", packed.data.size()},
          {"byteStride", size}, {"count", length / size},      {"mode", is_index(stream) ? "TRIANGLES" : "ATTRIBUTES"}};
      if (is_octahedral(stream)) v["extensions"]["EXT_meshopt_compression"]["filter"] = "OCTAHEDRAL";
    }
    return v;
  }

  void views_and_accessors() {
    accessor_of_.resize(stock_.meshes.size());
    for (std::size_t g = 0; g < layout_.groups.size(); ++g) {
      const MeshGroup& group = layout_.groups[g];
      std::array<std::size_t, kStreams> number{};
      for (std::size_t s = 0; s < kStreams; ++s) {
        if (group.views[s].length == 0) continue;
        number[s] = views_.size();
        views_.push_back(view(group, g, s));
      }
      for (std::size_t m = group.first; m < group.last; ++m) {
        for (std::size_t s = 0; s < kStreams; ++s) {
          const auto stream = static_cast<Stream>(s);
          if (!stock_.meshes[m].has(stream)) continue;
          accessor_of_[m][s] = static_cast<int>(accessors_.size());
          accessors_.push_back(accessor(stock_.meshes[m], stream, number[s], layout_.offsets[m][s]));
        }
      }
    }
  }

  static OrderedJson accessor(const MeshFacts& facts, Stream stream, std::size_t view, std::uint64_t offset) {
    OrderedJson a{{"bufferView", view}};
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
      case Stream::position_short: {
        type(kSignedShort, "VEC3", false);
        const IVec3 low = facts.quantum(facts.bounds.low), high = facts.quantum(facts.bounds.high);
        a["min"] = {low.x, low.y, low.z};
        a["max"] = {high.x, high.y, high.z};
        break;
      }
      case Stream::normal:
      case Stream::instance_place:
      case Stream::instance_size:
        type(kFloat, "VEC3", false);
        break;
      case Stream::normal_byte:
        type(kSignedByte, "VEC3", true);
        break;
      case Stream::tangent:
      case Stream::instance_turn:
        type(kFloat, "VEC4", false);
        break;
      case Stream::tangent_byte:
        type(kSignedByte, "VEC4", true);
        break;
      case Stream::instance_turn_short:
        type(kSignedShort, "VEC4", true);
        break;
      case Stream::uv_float:
        type(kFloat, "VEC2", false);
        break;
      case Stream::uv_short:
        type(kShort, "VEC2", true);
        break;
      case Stream::colour:
      case Stream::wind:
      case Stream::instance_colour:
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

  /// `files` names the images; empty: they are in the buffer.
  void materials(const std::vector<std::string>& files) {
    OrderedJson images = OrderedJson::array(), list = OrderedJson::array();
    for (std::size_t i = 0; i < images_.size(); ++i) {
      OrderedJson image{{"name", images_[i].name}, {"mimeType", images_[i].mime_type()}};
      if (files.empty()) {
        image["bufferView"] = views_.size();
        views_.push_back({{"buffer", 0}, {"byteOffset", image_offset_}, {"byteLength", images_[i].bytes.size()}});
        image_offset_ += padded(images_[i].bytes.size());
      } else {
        image["uri"] = uri(files[i]);
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
    const auto leaves_square = [&](const TriangleMesh* mesh) {
      return !stock_.meshes[stock_.mesh_index.at(mesh)].uv_in_unit_square;
    };
    for (const scene::Node& node : model_.nodes)
      for (const auto* parts : shown_levels(node, options_))
        for (const scene::Part& part : *parts) {
          if (part.material != material || !drawable(part)) continue;
          if (const auto cards = stock_.cards.find(part.mesh.get()); cards != stock_.cards.end()) {
            for (const GltfStock::Card& card : cards->second)
              if (!stock_.meshes[card.mesh].uv_in_unit_square) return false;
          } else if (leaves_square(part.mesh.get())) {
            return false;
          }
        }
    return true;
  }

  OrderedJson material(const scene::Material& from, bool clamp) {
    const auto unit = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
    OrderedJson out;
    if (!from.name.empty()) out["name"] = from.name;
    OrderedJson& pbr = out["pbrMetallicRoughness"];
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

  // What a glTF mesh draws: numbers in the stock, and of materials.
  using MeshKey = std::vector<std::pair<std::size_t, int>>;
  MeshKey baked(const std::vector<scene::Part>& parts) const {
    MeshKey key;
    for (const scene::Part& part : parts)
      if (drawable(part) && !stock_.instanced(part))
        key.emplace_back(stock_.mesh_index.at(part.mesh.get()), stock_.material_index[part.material]);
    return key;
  }

  std::size_t mesh_of(const MeshKey& key, const std::string& name) {
    const auto [it, fresh] = gltf_mesh_index_.try_emplace(key, meshes_.size());
    if (!fresh) return it->second;
    OrderedJson primitives = OrderedJson::array();
    for (const auto& [m, material] : key) primitives.push_back(primitive(m, material));
    OrderedJson mesh;
    if (!name.empty()) mesh["name"] = name;
    mesh["primitives"] = std::move(primitives);
    meshes_.push_back(std::move(mesh));
    return it->second;
  }

  OrderedJson primitive(std::size_t m, int material) const {
    const MeshFacts& facts = stock_.meshes[m];
    OrderedJson attributes;
    const auto add_stream = [&](const char* name, Stream stream) {
      if (facts.has(stream)) attributes[name] = accessor_of_[m][static_cast<std::size_t>(stream)];
    };
    add_stream("POSITION", Stream::position);
    add_stream("POSITION", Stream::position_short);
    add_stream("NORMAL", Stream::normal);
    add_stream("NORMAL", Stream::normal_byte);
    // A mesh may be drawn with a texture here and without there.
    const scene::Material& look = model_.materials[stock_.materials[static_cast<std::size_t>(material)]];
    if (uses_normal_map(look, options_.leaf_normal_maps)) {
      add_stream("TANGENT", Stream::tangent);
      add_stream("TANGENT", Stream::tangent_byte);
    }
    if (textured(look, options_)) {
      add_stream("TEXCOORD_0", Stream::uv_float);
      add_stream("TEXCOORD_0", Stream::uv_short);
    }
    add_stream("COLOR_0", Stream::colour);
    add_stream("_WIND", Stream::wind);
    const Stream indices = facts.has(Stream::index_short) ? Stream::index_short : Stream::index_int;
    return {{"attributes", std::move(attributes)},
            {"indices", accessor_of_[m][static_cast<std::size_t>(indices)]},
            {"material", material}};
  }

  // Puts a mesh on a node that stands at `translation`, with what unpacks its positions.
  void draw(OrderedJson& node, const MeshKey& key, const std::string& name, Vec3 translation) {
    node["mesh"] = mesh_of(key, name);
    const MeshFacts& facts = stock_.meshes[key.front().first];
    if (facts.quantized) translation += facts.centre;
    if (translation != Vec3(0.0f)) node["translation"] = numbers(translation);
    if (facts.quantized) node["scale"] = numbers(Vec3(facts.step));
  }

  std::size_t add_node(OrderedJson node) {
    nodes_.push_back(node.is_null() ? OrderedJson::object() : std::move(node));
    return nodes_.size() - 1;
  }

  // One level of a node at `translation`. Leaves that are instanced hang below it, beside a node for the rest.
  OrderedJson level(const std::vector<scene::Part>& parts, const std::string& name, const Vec3& translation) {
    OrderedJson node;
    if (!name.empty()) node["name"] = name;
    const MeshKey key = baked(parts);
    OrderedJson children = OrderedJson::array();
    for (const scene::Part& part : parts) {
      if (!drawable(part) || !stock_.instanced(part)) continue;
      for (const GltfStock::Card& card : stock_.cards.at(part.mesh.get()))
        children.push_back(add_node(instances(card, stock_.material_index[part.material])));
    }
    if (children.empty()) {
      if (!key.empty())
        draw(node, key, name, translation);
      else if (translation != Vec3(0.0f))
        node["translation"] = numbers(translation);
      return node;
    }
    if (!key.empty()) {
      OrderedJson rest;
      draw(rest, key, name, Vec3(0.0f));
      children.insert(children.begin(), add_node(std::move(rest)));
    }
    if (translation != Vec3(0.0f)) node["translation"] = numbers(translation);
    node["children"] = std::move(children);
    return node;
  }

  OrderedJson instances(const GltfStock::Card& card, int material) {
    OrderedJson node;
    node["mesh"] = mesh_of({{card.mesh, material}},
                           model_.materials[stock_.materials[static_cast<std::size_t>(material)]].name + "-card");
    OrderedJson attributes;
    const auto add_stream = [&](const char* name, Stream stream) {
      if (stock_.meshes[card.instances].has(stream))
        attributes[name] = accessor_of_[card.instances][static_cast<std::size_t>(stream)];
    };
    add_stream("TRANSLATION", Stream::instance_place);
    add_stream("ROTATION", Stream::instance_turn);
    add_stream("ROTATION", Stream::instance_turn_short);
    add_stream("SCALE", Stream::instance_size);
    add_stream("_COLOR_0", Stream::instance_colour);
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = std::move(attributes);
    return node;
  }

  // A node of the model with the levels that are asked for: as children, or by MSFT_lod.
  OrderedJson with_levels(const scene::Node& from) {
    const auto levels = shown_levels(from, options_);
    const auto numbered = [&](std::size_t k) { return fmt::format("{}_LOD{}", from.name, k); };
    if (levels.size() == 1) return level(from.parts, from.name, from.translation);
    if (options_.lod == LodFiles::nodes) {
      OrderedJson node, children = OrderedJson::array();
      if (!from.name.empty()) node["name"] = from.name;
      if (from.translation != Vec3(0.0f)) node["translation"] = numbers(from.translation);
      for (std::size_t k = 0; k < levels.size(); ++k)
        children.push_back(add_node(level(*levels[k], numbered(k), Vec3(0.0f))));
      node["children"] = std::move(children);
      return node;
    }
    OrderedJson node = level(from.parts, from.name, from.translation), ids = OrderedJson::array(),
                coverage = OrderedJson::array({shortest(from.coverage)});
    for (std::size_t k = 1; k < levels.size(); ++k) {
      ids.push_back(add_node(level(*levels[k], numbered(k), from.translation)));
      coverage.push_back(shortest(from.coarser[k - 1].coverage));
    }
    node["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
    node["extras"]["MSFT_screencoverage"] = std::move(coverage);
    return node;
  }

  void nodes() {
    OrderedJson roots = OrderedJson::array(), cameras = OrderedJson::array();
    for (const scene::Node& node : model_.nodes) {
      OrderedJson out = with_levels(node);
      if (OrderedJson extras = to_json(node.extras); !extras.empty()) {
        if (out.contains("extras")) extras.update(out["extras"]);
        out["extras"] = std::move(extras);
      }
      roots.push_back(add_node(std::move(out)));
    }
    for (const scene::Camera& camera : model_.cameras) {
      OrderedJson out;
      if (!camera.name.empty()) out["name"] = camera.name;
      out["camera"] = cameras.size();
      if (camera.eye != Vec3(0.0f)) out["translation"] = numbers(camera.eye);
      const DVec3 back = DVec3(camera.eye) - DVec3(camera.target);
      out["rotation"] = numbers(facing(back == DVec3(0.0) ? DVec3(0, 0, 1) : back));
      roots.push_back(add_node(std::move(out)));
      cameras.push_back({{"type", "perspective"},
                         {"perspective",
                          {{"yfov", shortest(radians(camera.vertical_fov_deg))},
                           {"znear", shortest(kNear)},
                           {"zfar", shortest(kFar)}}}});
    }
    // A directional light shines along its node's -Z.
    roots.push_back(add_node({{"name", "sun"},
                              {"rotation", numbers(facing(DVec3(model_.sun.direction())))},
                              {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}));
    root_["extensions"]["KHR_lights_punctual"]["lights"] = OrderedJson::array(
        {{{"name", "sun"}, {"type", "directional"}, {"intensity", shortest(options_.sun_intensity)}}});
    OrderedJson scene{{"nodes", std::move(roots)}};
    if (OrderedJson extras = to_json(model_.extras); !extras.empty()) scene["extras"] = std::move(extras);
    root_["scenes"] = OrderedJson::array({std::move(scene)});
    add("nodes", nodes_);
    add("meshes", meshes_);
    add("cameras", cameras);
  }

 private:
  const scene::Model& model_;
  const GltfStock& stock_;
  const MeshLayout& layout_;
  const std::vector<GltfImage>& images_;
  const PackedViews* packed_;
  const GltfOptions& options_;
  std::uint64_t image_offset_ = 0;  ///< of the next image of a .glb in the buffer

  OrderedJson root_, textures_ = OrderedJson::array(), samplers_ = OrderedJson::array();
  TextList views_, accessors_, meshes_, nodes_;
  std::map<std::string, std::vector<std::string>> lists_;  ///< of the root, by name
  std::vector<std::array<int, kStreams>> accessor_of_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> texture_index_;
  std::optional<std::size_t> sampler_index_[2];
  std::map<MeshKey, std::size_t> gltf_mesh_index_;
};

}  // namespace

std::vector<std::string> used_extensions(const GltfStock& stock, const scene::Model& model,
                                         const GltfOptions& options) {
  std::vector<std::string> used{"KHR_lights_punctual"};
  const auto any = [&](const auto& fits) { return std::any_of(stock.meshes.begin(), stock.meshes.end(), fits); };
  if (any([](const MeshFacts& m) { return m.instances != nullptr; })) used.push_back("EXT_mesh_gpu_instancing");
  if (any([](const MeshFacts& m) { return m.mesh && m.quantized; })) used.push_back("KHR_mesh_quantization");
  if (options.compression == Compression::meshopt && !stock.meshes.empty()) used.push_back("EXT_meshopt_compression");
  if (options.lod == LodFiles::msft &&
      std::any_of(model.nodes.begin(), model.nodes.end(), [](const scene::Node& n) { return !n.coarser.empty(); }))
    used.push_back("MSFT_lod");
  return used;
}

std::vector<std::string> required_extensions(const std::vector<std::string>& used, const GltfFiles& files) {
  std::vector<std::string> required;
  for (const std::string& name : used)
    if (name == "EXT_mesh_gpu_instancing" || name == "KHR_mesh_quantization" ||
        (name == "EXT_meshopt_compression" && files.fallback.empty()))
      required.push_back(name);
  return required;
}

std::vector<std::string> gltf_json(const GltfContent& content, const GltfFiles& files, const GltfOptions& options) {
  return Document(content, options).json(files);
}

}  // namespace bosquet::exchange
