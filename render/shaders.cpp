#include "render/shaders.h"

#include <array>

#include "render/shader_texts.h"

namespace bosquet::render {
namespace {

GLuint compile(GLenum kind, const std::string& source, std::string& log) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  std::array<char, 2048> buffer{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(buffer.size()), nullptr, buffer.data());
  log = buffer.data();
  glDeleteShader(shader);
  return 0;
}

}  // namespace

Result<Program> Program::make(const std::string& name, const std::string& vertex, const std::string& fragment) {
  std::string log;
  const auto fail = [&](const char* what) {
    return cannot_finish("the graphics driver (" +
                         std::string(reinterpret_cast<const char*>(glGetString(GL_RENDERER))) + ") does not " + what +
                         " the shader \"" + name + "\": " + log);
  };
  const GLuint v = compile(GL_VERTEX_SHADER, vertex, log);
  if (!v) return fail("compile");
  const GLuint f = compile(GL_FRAGMENT_SHADER, fragment, log);
  if (!f) {
    glDeleteShader(v);
    return fail("compile");
  }
  Program program;
  program.name_ = glCreateProgram();
  glAttachShader(program.name_, v);
  glAttachShader(program.name_, f);
  glLinkProgram(program.name_);
  glDeleteShader(v);
  glDeleteShader(f);
  GLint good = 0;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &good);
  if (!good) {
    std::array<char, 2048> buffer{};
    glGetProgramInfoLog(program.name_, static_cast<GLsizei>(buffer.size()), nullptr, buffer.data());
    log = buffer.data();
    return fail("link");
  }

  // Block and texture units never change.
  const GLuint block = glGetUniformBlockIndex(program.name_, "Frame");
  if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.name_, block, 0);
  glUseProgram(program.name_);
  const std::pair<const char*, GLint> units[] = {
      {"colour_map", kUnitColour}, {"normal_map", kUnitNormal}, {"shadow_map", kUnitShadow}, {"sky_map", kUnitSky},
      {"cover_map", kUnitCover},   {"ground_map", kUnitGround}, {"mirror_map", kUnitMirror}};
  for (const auto& [sampler, unit] : units)
    if (const GLint at = program.uniform(sampler); at >= 0) glUniform1i(at, unit);
  glUseProgram(0);
  return program;
}

Result<Programs> Programs::make() {
  const std::string frame = kFrame, shared = frame + kNoise + kGroundPatches + kGround + kLight;
  const std::string vertex = frame + kMeshVertex, fragment = shared + kMeshFragment;
  const std::string shadow = std::string("#version 330 core\n") + kShadowVertex;
  Programs programs;
  struct Source {
    Program Programs::*program;
    const char* name;
    std::string vertex, fragment;
  };
  const Source sources[] = {
      {&Programs::solid, "solid", vertex, fragment + kSolid + kSurfaceMain},
      {&Programs::leaf_cover, "leaf cover", vertex, frame + kLeafCover},
      {&Programs::leaf, "leaf", vertex, fragment + kLeaf + kSurfaceMain},
      {&Programs::ground, "ground", vertex, fragment + kGroundMain},
      {&Programs::grass, "grass", frame + "#define SHADOW_TAPS 4\n" + kNoise + kGroundPatches + kLight + kGrassVertex,
       kGrassFragment},
      {&Programs::water, "water", vertex, fragment + kWater + kWaterMain},
      {&Programs::sky, "sky", frame + kSkyVertex, shared + kWater + kSkyFragment},
      {&Programs::shadow_solid, "shadow", shadow, kShadowSolid},
      {&Programs::shadow_leaf, "leaf shadow", shadow, kShadowLeaf}};
  for (const Source& source : sources) {
    Result<Program> made = Program::make(source.name, source.vertex, source.fragment);
    if (!made) return made.error();
    programs.*source.program = std::move(*made);
  }
  return programs;
}

}  // namespace bosquet::render
