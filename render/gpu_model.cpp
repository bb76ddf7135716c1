#include "render/gpu_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "core/parallel.h"
#include "render/alpha_mips.h"
#include "render/framing.h"

namespace bosquet::render {
namespace {

// EXT_texture_filter_anisotropic, in core since OpenGL 4.6; other drivers ignore the unknown name with an error.
constexpr GLenum kMaxAnisotropy = 0x84FE;
constexpr float kAnisotropy = 4.0f;

std::uint32_t pack_normal(const Vec3& n) {
  const auto bits = [](float v) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(v, -1.0f, 1.0f) * 511.0f)) & 1023u;
  };
  return bits(n.x) | bits(n.y) << 10 | bits(n.z) << 20;
}

/// Normals of a mesh without any: of its triangles, weighted by area.
std::vector<Vec3> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3(0.0f));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const Vec3 n = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    normals[a] += n, normals[b] += n, normals[c] += n;
  }
  for (Vec3& n : normals) n = glm::dot(n, n) > 0 ? glm::normalize(n) : kUp;
  return normals;
}

std::vector<GpuVertex> pack(const TriangleMesh& mesh) {
  const std::vector<Vec3> made = mesh.normals.empty() ? smooth_normals(mesh) : std::vector<Vec3>();
  const std::vector<Vec3>& normals = mesh.normals.empty() ? made : mesh.normals;
  std::vector<GpuVertex> vertices(mesh.positions.size());
  constexpr std::size_t kGrain = 16384;
  parallel_for(
      vertices.size(),
      [&](std::size_t i) {
        vertices[i] = {mesh.positions[i], pack_normal(normals[i]), mesh.uvs.empty() ? Vec2(0.0f) : mesh.uvs[i],
                       mesh.colours.empty() ? Rgba8(255) : mesh.colours[i]};
      },
      kGrain);
  return vertices;
}

GpuMesh upload_mesh(const TriangleMesh& mesh) {
  GpuMesh out;
  out.box = mesh.bounds();
  out.count = static_cast<GLsizei>(mesh.indices.size());
  const std::vector<GpuVertex> vertices = pack(mesh);
  out.array = GlVertexArray::make();
  out.vertices = GlBuffer::make();
  out.indices = GlBuffer::make();
  glBindVertexArray(out.array.name());
  glBindBuffer(GL_ARRAY_BUFFER, out.vertices.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(GpuVertex)), vertices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, out.indices.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
               mesh.indices.data(), GL_STATIC_DRAW);
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  constexpr GLsizei kStride = sizeof(GpuVertex);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, at(offsetof(GpuVertex, position)));
  glVertexAttribPointer(1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, kStride, at(offsetof(GpuVertex, normal)));
  glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(GpuVertex, uv)));
  glVertexAttribPointer(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, at(offsetof(GpuVertex, colour)));
  for (GLuint i = 0; i < 4; ++i) glEnableVertexAttribArray(i);
  glBindVertexArray(0);
  return out;
}

GlTexture upload_chain(const std::vector<Image>& chain, bool srgb, bool anisotropic) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t level = 0; level < chain.size(); ++level)
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(level), srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, chain[level].width,
                 chain[level].height, 0, GL_RGBA, GL_UNSIGNED_BYTE, chain[level].pixels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(chain.size()) - 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  // Software takes ten times as long over anisotropic textures.
  if (anisotropic && !drawn_by_software()) {
    glTexParameterf(GL_TEXTURE_2D, kMaxAnisotropy, kAnisotropy);
    glGetError();
  }
  return texture;
}

GlTexture upload_map(GLint format, int width, int height, GLenum channels, const void* data) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, GL_FLOAT, data);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Shader shader_of(const scene::Material& material) {
  if (material.mask || material.surface == scene::Surface::leaf) return Shader::leaf;
  if (material.surface == scene::Surface::ground) return Shader::ground;
  if (material.surface == scene::Surface::water) return Shader::water;
  return Shader::solid;
}

}  // namespace

Result<GpuModel> GpuModel::make(const scene::Model& model) {
  GpuModel out;
  out.sun = model.sun;
  out.box = bounds(model);
  while (glGetError() != GL_NO_ERROR) {
  }

  // Textures, each image once per use; their levels are made in parallel, then uploaded.
  using Use = std::tuple<const Image*, TextureKind, float, bool>;
  std::map<Use, std::size_t> index_of;
  std::vector<Use> uses;
  const auto want = [&](const std::shared_ptr<const Image>& image, TextureKind kind, float cutoff, bool anisotropic) {
    if (!image || image->empty()) return;
    const Use use{image.get(), kind, cutoff, anisotropic};
    if (index_of.try_emplace(use, uses.size()).second) uses.push_back(use);
  };
  const auto cutoff_of = [](const scene::Material& m) { return m.mask ? m.alpha_cutoff : 0.0f; };
  const auto grazed = [](const scene::Material& m) { return !m.mask; };
  for (const scene::Material& m : model.materials) {
    want(m.base_colour, TextureKind::colour, cutoff_of(m), grazed(m));
    want(m.normal, TextureKind::normal, 0.0f, grazed(m));
  }
  std::vector<std::vector<Image>> chains(uses.size());
  parallel_for(uses.size(), [&](std::size_t i) {
    const auto& [image, kind, cutoff, anisotropic] = uses[i];
    chains[i] = mip_chain(*image, kind, cutoff);
  });
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto& [image, kind, cutoff, anisotropic] = uses[i];
    out.textures.push_back(upload_chain(chains[i], kind == TextureKind::colour, anisotropic));
    chains[i] = {};
  }
  const auto texture = [&](const std::shared_ptr<const Image>& image, TextureKind kind, float cutoff,
                           bool anisotropic) -> GLuint {
    if (!image || image->empty()) return 0;
    return out.textures[index_of.at({image.get(), kind, cutoff, anisotropic})].name();
  };
  for (const scene::Material& m : model.materials) {
    GpuMaterial material;
    material.shader = shader_of(m);
    material.base_colour = texture(m.base_colour, TextureKind::colour, cutoff_of(m), grazed(m));
    material.normal = texture(m.normal, TextureKind::normal, 0.0f, grazed(m));
    material.base_factor = m.base_factor;
    material.roughness = std::clamp(m.roughness, 0.05f, 1.0f);
    material.cutoff = m.mask ? std::clamp(m.alpha_cutoff, 0.01f, 0.99f) : 0.0f;
    material.translucency = std::clamp(m.translucency, 0.0f, 1.0f);
    material.double_sided = m.double_sided;
    if (material.shader == Shader::ground && !out.ground_material) out.ground_material = out.materials.size();
    out.materials.push_back(material);
  }

  // Meshes, each once.
  std::map<const TriangleMesh*, std::size_t> mesh_index;
  for (const scene::Node& node : model.nodes)
    for (const scene::Part& part : node.parts) {
      if (!part.mesh || part.mesh->empty()) continue;
      assert(part.material < model.materials.size());
      const auto [found, is_new] = mesh_index.try_emplace(part.mesh.get(), out.meshes.size());
      if (is_new) out.meshes.push_back(upload_mesh(*part.mesh));
      const Box3& own = out.meshes[found->second].box;
      out.drawables.push_back(
          {found->second, part.material, node.translation, {own.low + node.translation, own.high + node.translation}});
    }

  out.overhead = make_overhead(model, out.box);
  Overhead& map = out.overhead;
  out.cover = upload_map(GL_RGBA32F, map.columns, map.rows, GL_RGBA, map.cover.data());
  out.ground = upload_map(GL_R32F, map.columns, map.rows, GL_RED, map.ground.data());
  map.cover = {}, map.ground = {};

  if (glGetError() == GL_OUT_OF_MEMORY)
    return cannot_finish(
        "the scene does not fit into graphics memory; export or draw it with a smaller triangle budget");
  return out;
}

}  // namespace bosquet::render
