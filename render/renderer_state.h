// Renderer state: what a Renderer keeps between pictures, and the steps that a picture is drawn in.
//
// Sources   renderer.cpp scene, tiles and pictures; light_pass.cpp air, shadows and mirror image; scene_pass.cpp the parts
//           themselves
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/atmosphere.h"
#include "render/gpu_grass.h"
#include "render/gpu_model.h"
#include "render/lens.h"
#include "render/render_target.h"
#include "render/renderer.h"
#include "render/shaders.h"

namespace bosquet::render {

inline constexpr int kTileLimit = 4096;

/// Which parts of the scene a pass draws.
struct Pass {
  bool mirrored = false;
  float water_level = 0;
  float grass_reach = 0;  ///< 0: none
};

inline Box3 relative(const Box3& box, const Vec3& eye) { return {box.low - eye, box.high - eye}; }

struct Renderer::State {
  Programs programs;
  GpuModel model;
  GpuGrass grass;
  DrawFacts facts;
  int tile_limit = kTileLimit;
  GLint most_samples = 1, largest_target = 4096;

  TileTarget tile;
  MirrorTarget mirror;
  ShadowTarget shadow, draft_shadow;
  GLuint shadow_map = 0;  ///< of the one that the present picture reads
  GlBuffer frame;
  GlVertexArray nothing;  ///< the sky's triangle has no vertex data
  GlTexture sky;

  // Counts what was put and removed, and for which count and sun the draft's shadow map was drawn.
  std::uint64_t scene_count = 1, draft_shadow_count = 0;
  Vec3 draft_shadow_sun{0.0f};
  std::vector<Cascade> draft_cascade;

  // The last atmosphere and what it was made for.
  Atmosphere air;
  Vec4 air_key{-1.0f};

  Result<void> draw(const View& view, const std::function<void(int x, int y, int w, int h)>& take_tile);

 private:
  FrameBlock light_block(const View& view, const ViewVolume& volume);
  void use_atmosphere(const scene::Sun& sun, float turbidity);
  static void aim(FrameBlock& block, const ViewVolume& volume, const ClipWindow& window);
  std::optional<float> mirror_level(const FrameBlock& block, const ViewVolume& volume) const;
  Result<void> draw_mirror(FrameBlock& block, const ViewVolume& volume, const View& view);
  Result<void> shade(FrameBlock& block, const ViewVolume& volume, const View& view);
  void draw_shadows(const ShadowTarget& map, const std::vector<Cascade>& cascades);
  void draw_scene(const FrameBlock& block, const ViewVolume& volume, const Pass& pass, bool sky_drawn);
  void draw_parts(const Program& program, Shader shader, const std::vector<const Drawable*>& parts, const Vec3& eye);
  void set_frame(const FrameBlock& block);
};

}  // namespace bosquet::render
