#include "gltf_read_back.h"

#include <tiny_gltf.h>

#include <cstring>
#include <stdexcept>

namespace bosquet::exchange {
namespace {

// All components of an accessor as doubles, normalized ones in 0..1.
std::vector<double> components(const tinygltf::Model& model, std::size_t index) {
  const auto& accessor = model.accessors.at(index);
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const auto& bytes = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  const auto type = static_cast<std::uint32_t>(accessor.componentType);
  const auto per_element =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  const auto size = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(type));
  const auto stride = static_cast<std::size_t>(accessor.ByteStride(view));
  std::vector<double> out;
  for (std::size_t i = 0; i < accessor.count; ++i)
    for (std::size_t c = 0; c < per_element; ++c) {
      const unsigned char* at =
          &bytes.at(view.byteOffset + accessor.byteOffset + i * stride + c * size + size - 1) - (size - 1);
      switch (type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT: {
          float v;
          std::memcpy(&v, at, 4);
          out.push_back(static_cast<double>(v));
          break;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
          std::uint16_t v;
          std::memcpy(&v, at, 2);
          out.push_back(accessor.normalized ? v / 65535.0 : v);
          break;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
          out.push_back(accessor.normalized ? *at / 255.0 : *at);
          break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
          std::uint32_t v;
          std::memcpy(&v, at, 4);
          out.push_back(v);
          break;
        }
        default:
          throw std::runtime_error("component type");
      }
    }
  return out;
}

template <class V>
std::vector<V> vectors(const std::vector<double>& flat) {
  std::vector<V> out(flat.size() / static_cast<std::size_t>(V::length()));
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int c = 0; c < V::length(); ++c)
      out[i][c] = static_cast<float>(flat[i * static_cast<std::size_t>(V::length()) + static_cast<std::size_t>(c)]);
  return out;
}

ReadPrimitive read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& from) {
  ReadPrimitive out;
  const auto attribute = [&](const char* name) -> std::vector<double> {
    const auto it = from.attributes.find(name);
    return it == from.attributes.end() ? std::vector<double>()
                                       : components(model, static_cast<std::size_t>(it->second));
  };
  out.positions = vectors<Vec3>(attribute("POSITION"));
  out.normals = vectors<Vec3>(attribute("NORMAL"));
  out.tangents = vectors<Vec4>(attribute("TANGENT"));
  out.colours = vectors<Vec4>(attribute("COLOR_0"));
  out.wind = vectors<Vec4>(attribute("_WIND"));
  out.uvs = vectors<Vec2>(attribute("TEXCOORD_0"));
  for (double i : components(model, static_cast<std::size_t>(from.indices)))
    out.indices.push_back(static_cast<std::uint32_t>(i));
  const auto is_short = [&](int accessor) {
    return model.accessors[static_cast<std::size_t>(accessor)].componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  };
  out.short_indices = is_short(from.indices);
  if (from.attributes.count("TEXCOORD_0")) out.short_uvs = is_short(from.attributes.at("TEXCOORD_0"));
  out.position_accessor = static_cast<std::size_t>(from.attributes.at("POSITION"));
  const auto& position = model.accessors[out.position_accessor];
  for (int c = 0; c < 3; ++c) {
    out.low[c] = position.minValues.at(static_cast<std::size_t>(c));
    out.high[c] = position.maxValues.at(static_cast<std::size_t>(c));
  }
  out.material = from.material;
  return out;
}

ReadMaterial read_material(const tinygltf::Model& model, const tinygltf::Material& from) {
  ReadMaterial out;
  out.name = from.name;
  out.alpha_mode = from.alphaMode;
  out.alpha_cutoff = from.alphaCutoff;
  out.double_sided = from.doubleSided;
  out.roughness = from.pbrMetallicRoughness.roughnessFactor;
  out.metallic = from.pbrMetallicRoughness.metallicFactor;
  out.has_normal = from.normalTexture.index >= 0;
  if (const int t = from.pbrMetallicRoughness.baseColorTexture.index; t >= 0) {
    const auto& texture = model.textures.at(static_cast<std::size_t>(t));
    const auto& image = model.images.at(static_cast<std::size_t>(texture.source));
    out.has_colour = true;
    out.colour_mime = image.mimeType;
    out.colour_width = image.width;
    out.colour_wrap = model.samplers.at(static_cast<std::size_t>(texture.sampler)).wrapS;
  }
  return out;
}

}  // namespace

ReadBack read_back(const std::filesystem::path& path) {
  ReadBack out;
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  const bool good = path.extension() == ".glb"
                        ? reader.LoadBinaryFromFile(&model, &out.error, &out.warning, path.string())
                        : reader.LoadASCIIFromFile(&model, &out.error, &out.warning, path.string());
  if (!good && out.error.empty()) out.error = "not read";
  if (!out.error.empty()) return out;
  out.generator = model.asset.generator;
  for (const auto& mesh : model.meshes) {
    auto& primitives = out.meshes.emplace_back();
    for (const auto& primitive : mesh.primitives) primitives.push_back(read_primitive(model, primitive));
  }
  for (const auto& material : model.materials) out.materials.push_back(read_material(model, material));
  for (const auto& camera : model.cameras) out.camera_fov.push_back(camera.perspective.yfov);
  out.images = model.images.size();
  const auto& scene = model.scenes.at(static_cast<std::size_t>(model.defaultScene));
  out.scene_nodes = scene.nodes.size();
  if (scene.extras.Has("seed")) out.scene_seed = std::to_string(scene.extras.Get("seed").GetNumberAsInt());
  for (const auto& from : model.nodes) {
    ReadNode node;
    node.name = from.name;
    if (from.translation.size() == 3)
      node.translation = {from.translation[0], from.translation[1], from.translation[2]};
    if (from.rotation.size() == 4)
      node.rotation = {from.rotation[0], from.rotation[1], from.rotation[2], from.rotation[3]};
    node.mesh = from.mesh;
    node.camera = from.camera;
    node.light = from.extensions.count("KHR_lights_punctual") > 0;
    if (from.extras.Has("species")) node.species = from.extras.Get("species").Get<std::string>();
    if (from.extras.Has("height_m")) node.height_m = from.extras.Get("height_m").GetNumberAsDouble();
    if (from.extras.Has("id")) node.id = from.extras.Get("id").GetNumberAsDouble();
    out.nodes.push_back(std::move(node));
  }
  return out;
}

}  // namespace bosquet::exchange
