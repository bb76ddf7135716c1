#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "render/frustum.h"
#include "render/gl.h"
#include "render/renderer_state.h"

namespace bosquet::render {
namespace {

/// The land around bears the ground's texture at this many metres a tile.
constexpr float kLandTileM = 3.0f;

}  // namespace

void Renderer::State::set_frame(const FrameBlock& block) {
  glBindBuffer(GL_UNIFORM_BUFFER, frame.name());
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame.name());
}

/// Draws parts with a program in use; materials and textures change only where they differ from the part before.
void Renderer::State::draw_parts(const Program& program, Shader shader, const std::vector<const Drawable*>& parts,
                                 const Vec3& eye) {
  const GLint offset = program.uniform("offset"), base_factor = program.uniform("base_factor");
  const GLint material_at = program.uniform("material"), maps = program.uniform("maps");
  std::size_t current = static_cast<std::size_t>(-1);
  for (const Drawable* d : parts) {
    if (d->material != current) {
      current = d->material;
      const GpuMaterial& m = model.materials[current];
      glActiveTexture(GL_TEXTURE0 + kUnitColour);
      glBindTexture(GL_TEXTURE_2D, m.base_colour);
      glActiveTexture(GL_TEXTURE0 + kUnitNormal);
      glBindTexture(GL_TEXTURE_2D, m.normal);
      if (base_factor >= 0) glUniform4fv(base_factor, 1, &m.base_factor[0]);
      // Without a texture only the factor's alpha is left to cut by.
      const float cutoff = m.base_colour ? m.cutoff : 0.0f;
      const bool of_ground = shader == Shader::ground;
      const bool flag = shader == Shader::leaf ? m.whole_trees : of_ground ? m.laid : m.double_sided;
      const float amount = of_ground ? m.patchiness : m.translucency;
      if (material_at >= 0) glUniform4f(material_at, m.roughness, cutoff, amount, flag ? 1.0f : 0.0f);
      if (maps >= 0) glUniform2f(maps, m.base_colour ? 1.0f : 0.0f, m.normal ? 1.0f : 0.0f);
    }
    const GpuMaterial& m = model.materials[current];
    if (shader != Shader::water && !m.double_sided)
      glEnable(GL_CULL_FACE);
    else
      glDisable(GL_CULL_FACE);
    const GpuMesh& mesh = model.meshes[d->mesh];
    const Vec3 from_eye = d->translation - eye;
    glUniform3fv(offset, 1, &from_eye[0]);
    glBindVertexArray(mesh.array.name());
    glDrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
    facts.triangles_sent += static_cast<std::size_t>(mesh.count) / 3;
    ++facts.draws;
  }
}

void Renderer::State::draw_scene(const FrameBlock& block, const ViewVolume& volume, const Pass& pass, bool sky_drawn) {
  set_frame(block);
  const std::pair<GLint, std::pair<GLenum, GLuint>> bound[] = {
      {kUnitShadow, {GL_TEXTURE_2D_ARRAY, shadow_map}},
      {kUnitSky, {GL_TEXTURE_2D, sky.name()}},
      {kUnitCover, {GL_TEXTURE_2D, model.cover.name()}},
      {kUnitGround, {GL_TEXTURE_2D, model.ground.name()}},
      {kUnitMirror, {GL_TEXTURE_2D, block.water.z > 0 ? mirror.texture() : 0}}};
  for (const auto& [unit, texture] : bound) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(texture.first, texture.second);
  }
  glFrontFace(pass.mirrored ? GL_CW : GL_CCW);
  if (pass.mirrored) glEnable(GL_CLIP_DISTANCE0);

  // What can be seen, by shader, then material, then from near to far.
  std::array<std::vector<std::pair<float, const Drawable*>>, 4> seen;
  for (const Drawable& d : model.drawables) {
    if (pass.mirrored && d.box.high.y < pass.water_level) continue;
    if (!may_be_seen(block.relative_to_clip, relative(d.box, volume.eye))) continue;
    const float depth = glm::dot(d.box.centre() - volume.eye, volume.forward);
    seen[static_cast<std::size_t>(model.materials[d.material].shader)].emplace_back(depth, &d);
  }
  const auto sorted = [&](Shader shader) {
    auto& list = seen[static_cast<std::size_t>(shader)];
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.second->material, a.first, a.second) < std::tuple(b.second->material, b.first, b.second);
    });
    std::vector<const Drawable*> parts;
    for (const auto& [depth, d] : list) {
      parts.push_back(d);
      if (!pass.mirrored) facts.triangles_viewed += static_cast<std::size_t>(model.meshes[d->mesh].count) / 3;
    }
    return parts;
  };
  const auto draw_all = [&](const Program& program, Shader shader) {
    glUseProgram(program.name());
    draw_parts(program, shader, sorted(shader), volume.eye);
  };

  draw_all(programs.solid, Shader::solid);
  const std::vector<const Drawable*> leaves = sorted(Shader::leaf);
  if (!pass.mirrored && facts.samples > 1) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glUseProgram(programs.leaf_cover.name());
  draw_parts(programs.leaf_cover, Shader::leaf, leaves, volume.eye);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  glUseProgram(programs.leaf.name());
  draw_parts(programs.leaf, Shader::leaf, leaves, volume.eye);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  if (pass.grass_reach > 0 && !grass.empty()) {
    // Before the ground, so that what it hides is not shaded.
    glUseProgram(programs.grass.name());
    glDisable(GL_CULL_FACE);
    const GpuGrass::Drawn drawn = grass.draw(programs.grass, block.relative_to_clip, volume.eye, pass.grass_reach);
    facts.triangles_sent += drawn.triangles, facts.triangles_viewed += drawn.triangles, facts.draws += drawn.draws;
  }
  draw_all(programs.ground, Shader::ground);
  glDisable(GL_CULL_FACE);
  if (sky_drawn) {
    glUseProgram(programs.sky.name());
    const GLuint texture = model.ground_material ? model.materials[*model.ground_material].base_colour : 0;
    glActiveTexture(GL_TEXTURE0 + kUnitColour);
    glBindTexture(GL_TEXTURE_2D, texture);
    glUniform2f(programs.sky.uniform("maps"), texture ? 1.0f : 0.0f, 1 / kLandTileM);
    glBindVertexArray(nothing.name());
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
    ++facts.draws;
  }
  // Water lets what lies under it shine through, and mirrors nothing of itself.
  if (!pass.mirrored) {
    const bool through = block.shading.x == 0.0f;
    if (through) {
      glEnable(GL_BLEND);
      glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      glDepthMask(GL_FALSE);
    }
    draw_all(programs.water, Shader::water);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
  }
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_CULL_FACE);
  glFrontFace(GL_CCW);
}

}  // namespace bosquet::render
