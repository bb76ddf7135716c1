#include "render/gpu_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/parallel.h"
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
  if (material.mask || material.surface == scene::Surface::leaf || material.surface == scene::Surface::grass)
    return Shader::leaf;
  if (material.surface == scene::Surface::ground) return Shader::ground;
  if (material.surface == scene::Surface::water) return Shader::water;
  return Shader::solid;
}

void forget_gl_errors() {
  while (glGetError() != GL_NO_ERROR) {
  }
}

Result<void> check_memory() {
  if (glGetError() == GL_OUT_OF_MEMORY)
    return cannot_finish(
        "the scene does not fit into graphics memory; export or draw it with a smaller triangle budget");
  return {};
}

}  // namespace

Result<GpuModel> GpuModel::make(const scene::Model& model) {
  GpuModel out;
  out.sun = model.sun;
  out.box = bounds(model);
  if (auto added = out.add_materials(make_levels(model.materials)); !added) return added.error();
  for (const scene::Node& node : model.nodes) out.add(node, 0);
  if (auto set = out.set_overhead(make_overhead(model, out.box)); !set) return set.error();
  return out;
}

Result<std::size_t> GpuModel::add_materials(const MaterialLevels& added) {
  forget_gl_errors();
  std::vector<GLuint> names;
  for (std::size_t i = 0; i < added.uses.size(); ++i) {
    const TextureUse& use = added.uses[i];
    textures.push_back(upload_chain(added.chains[i], use.kind == TextureKind::colour, use.anisotropic));
    names.push_back(textures.back().name());
  }
  const auto name = [&](const TextureUse& use) -> GLuint {
    const auto found = std::find(added.uses.begin(), added.uses.end(), use);
    return found == added.uses.end() ? 0 : names[static_cast<std::size_t>(found - added.uses.begin())];
  };
  const std::size_t first = materials.size();
  for (const scene::Material& m : added.materials) {
    GpuMaterial& out = materials.emplace_back();
    out.shader = shader_of(m);
    out.base_colour = name(colour_use(m));
    out.normal = name(normal_use(m));
    out.base_factor = m.base_factor;
    out.roughness = std::clamp(m.roughness, 0.05f, 1.0f);
    out.cutoff = m.mask ? std::clamp(m.alpha_cutoff, 0.01f, 0.99f) : 0.0f;
    out.translucency = std::clamp(m.translucency, 0.0f, 1.0f);
    out.double_sided = m.double_sided;
    out.whole_trees = m.whole_trees;
    out.patchiness = std::clamp(m.patchiness, 0.0f, 1.0f);
    out.laid = m.laid;
    if (out.shader == Shader::ground && !ground_material) ground_material = materials.size() - 1;
  }
  if (auto fits = check_memory(); !fits) return fits.error();
  return first;
}

Result<void> GpuModel::replace_colour(std::size_t material, const MaterialLevels& by) {
  const TextureUse wanted = colour_use(by.materials.front());
  const auto use = std::find(by.uses.begin(), by.uses.end(), wanted);
  GLuint& name = materials[material].base_colour;
  const auto old = std::find_if(textures.begin(), textures.end(), [&](const GlTexture& t) { return t.name() == name; });
  if (use == by.uses.end() || old == textures.end()) return Error{"no picture to replace"};
  forget_gl_errors();
  *old = upload_chain(by.chains[static_cast<std::size_t>(use - by.uses.begin())], use->kind == TextureKind::colour,
                      use->anisotropic);
  name = old->name();
  return check_memory();
}

// The place of a mesh, copied unless it is there.
std::size_t GpuModel::mesh_of(const std::shared_ptr<const TriangleMesh>& mesh) {
  const auto found = mesh_index_.find(mesh.get());
  if (found != mesh_index_.end() && meshes[found->second].source.lock() == mesh) return found->second;
  std::size_t place = meshes.size();
  if (free_meshes_.empty()) {
    meshes.emplace_back();
  } else {
    place = free_meshes_.back();
    free_meshes_.pop_back();
  }
  meshes[place] = upload_mesh(*mesh);
  meshes[place].address = mesh.get();
  meshes[place].source = mesh;
  mesh_index_[mesh.get()] = place;
  return place;
}

void GpuModel::add(const scene::Node& node, std::uint64_t key) {
  for (const scene::Part& part : node.parts) {
    if (!part.mesh || part.mesh->empty()) continue;
    assert(part.material < materials.size());
    const std::size_t mesh = mesh_of(part.mesh);
    ++meshes[mesh].uses;
    const Box3& own = meshes[mesh].box;
    drawables.push_back(
        {mesh, part.material, node.translation, {own.low + node.translation, own.high + node.translation}, key});
    if (key) ++drawables_of_[key];
  }
}

Result<void> GpuModel::put(std::uint64_t key, const scene::Node& node) {
  assert(key > 0);
  forget_gl_errors();
  remove(key);
  const std::size_t first = drawables.size();
  add(node, key);
  for (std::size_t d = first; d < drawables.size(); ++d) {
    box.add(drawables[d].box.low);
    box.add(drawables[d].box.high);
  }
  return check_memory();
}

void GpuModel::remove(std::uint64_t key) {
  const auto own = drawables_of_.find(key);
  if (own == drawables_of_.end()) return;
  std::size_t left = own->second;
  drawables_of_.erase(own);
  // Order means nothing here, drawing sorts: the last one takes the place of one that goes.
  for (std::size_t d = drawables.size(); d-- > 0 && left > 0;) {
    if (drawables[d].node != key) continue;
    const std::size_t mesh = drawables[d].mesh;
    if (--meshes[mesh].uses == 0) {
      const auto found = mesh_index_.find(meshes[mesh].address);
      if (found != mesh_index_.end() && found->second == mesh) mesh_index_.erase(found);
      meshes[mesh] = {};
      free_meshes_.push_back(mesh);
    }
    drawables[d] = drawables.back();
    drawables.pop_back();
    --left;
  }
  box = {};
  for (const Drawable& d : drawables) {
    box.add(d.box.low);
    box.add(d.box.high);
  }
}

Result<void> GpuModel::set_overhead(Overhead map) {
  forget_gl_errors();
  overhead = std::move(map);
  cover = upload_map(GL_RGBA32F, overhead.columns, overhead.rows, GL_RGBA, overhead.cover.data());
  ground = upload_map(GL_R32F, overhead.columns, overhead.rows, GL_RED, overhead.ground.data());
  overhead.cover = {}, overhead.ground = {};
  return check_memory();
}

}  // namespace bosquet::render
