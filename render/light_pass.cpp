#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/frustum.h"
#include "render/gl.h"
#include "render/renderer_state.h"

namespace bosquet::render {
namespace {

constexpr int kCascades = 3;
constexpr int kSmallestShadow = 512, kLargestShadow = 4096;  ///< texels a side; as many as the picture has pixels
constexpr float kLargestMirror = 2048;

/// Exposure puts a surface of 0.18 / kBrightness that lies open to the sky at the middle of the tone curve: plants
/// reflect about a tenth.
constexpr float kBrightness = 2.1f;

/// How far the eye adapts to the colour of the light.
constexpr float kWhiteBalance = 0.6f;

/// Woods around the site are at least this far away.
constexpr float kWoodsM = 700.0f;

/// Texels a side of the one shadow map of drafts.
constexpr int kDraftShadow = 2048;

/// Lottes 2016, "Advanced techniques and optimization of HDR color pipelines": contrast, shoulder, and the curve
/// through (middle grey, middle out) and (brightest, 1).
Vec4 tone_curve() {
  constexpr float contrast = 1.28f, shoulder = 0.975f, grey = 0.18f, grey_out = 0.20f, brightest = 9.0f;
  const float grey_a = std::pow(grey, contrast), bright_a = std::pow(brightest, contrast);
  const float grey_ad = std::pow(grey, contrast * shoulder), bright_ad = std::pow(brightest, contrast * shoulder);
  const float b = (-grey_a + bright_a * grey_out) / ((bright_ad - grey_ad) * grey_out);
  const float c = (bright_ad * grey_a - bright_a * grey_ad * grey_out) / ((bright_ad - grey_ad) * grey_out);
  return {contrast, shoulder, b, c};
}

/// Looks straight down at all of a box.
ViewVolume volume_from_above(const Box3& box) {
  const Vec3 half = 0.5f * box.size();
  return {.eye = box.centre(),
          .right = {1, 0, 0},
          .up = {0, 0, -1},
          .forward = -kUp,
          .half_width = half.x,
          .half_height = half.z,
          .orthographic = true,
          .near = -half.y,
          .far = half.y};
}

}  // namespace

void Renderer::State::use_atmosphere(const scene::Sun& sun, float turbidity) {
  const Vec4 key(sun.azimuth_deg, sun.elevation_deg, turbidity, luminance(model.overhead.ground_albedo));
  if (sky && key == air_key) return;
  air_key = key;
  air = make_atmosphere(sun, turbidity, model.overhead.ground_albedo);
  sky = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, sky.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, Atmosphere::kColumns, Atmosphere::kRows, 0, GL_RGB, GL_FLOAT,
               air.radiance.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// All of the block that is the same for every tile and pass.
FrameBlock Renderer::State::light_block(const View& view, const ViewVolume& volume) {
  const scene::Sun sun = view.sun.value_or(model.sun);
  use_atmosphere(sun, view.look.turbidity);
  const Vec3 to_sun = air.to_sun;

  // Level ground and what faces the sun share in setting the exposure, so that a low sun does not bleach what it meets.
  const float falling = luminance(air.sun_irradiance) * std::max(to_sun.y, 0.5f) + luminance(air.sky_irradiance);
  const float exposure = kBrightness * kPi / std::max(falling, 1e-4f) * std::exp2(view.look.exposure_ev);

  // White balance: most of the way to where level ground in the open is white, so that evenings stay warm.
  const Vec3 level = air.sun_irradiance * std::max(to_sun.y, 0.25f) + air.sky_irradiance;
  const Vec3 gain = exposure * glm::pow(glm::max(Vec3(luminance(level)) / glm::max(level, Vec3(1e-5f)), Vec3(0.2f)),
                                        Vec3(kWhiteBalance));

  FrameBlock block{};
  block.cascade_far.w = to_sun.y > 0.02f && !model.drawables.empty() ? static_cast<float>(kCascades) : 0.0f;
  block.eye = Vec4(volume.eye, 1);
  block.forward = Vec4(volume.forward, 0);
  block.to_sun = Vec4(to_sun, 0);
  block.gain = Vec4(gain, 0);
  block.sun_light = Vec4(air.sun_irradiance * gain, 0);
  block.sky_light = Vec4(air.sky_irradiance * gain, 0);
  for (std::size_t i = 0; i < 9; ++i) block.ambient[i] = Vec4(air.ambient[i] * gain, 0);
  block.air = Vec4(1 / view.look.haze_distance_m, view.look.clouds, view.look.ripples, 1);
  block.tone = tone_curve();
  const Overhead& over = model.overhead;
  block.over_area = Vec4(over.low, 1.0f / over.size());
  block.over_height = Vec4(over.base, 1 / over.scale, over.land_height, view.look.surroundings ? 1 : 0);
  const float site = glm::length(over.size());
  block.land = Vec4(over.land_tint, std::max(kWoodsM, 1.2f * site));
  block.ground_box = Vec4(over.ground_box.low, over.ground_box.high);
  block.water = Vec4(over.water_level_m.value_or(0.0f), over.water_flows_on ? 1 : 0, 0, 0);
  block.lens = Vec4(volume.half_width, volume.half_height, 0, 0);
  block.clip = Vec4(0, 0, 0, 1);
  block.shading = Vec4(static_cast<float>(view.shading), static_cast<float>(facts.samples), 0, 0);
  return block;
}

/// The part of the block that belongs to a window of the picture.
void Renderer::State::aim(FrameBlock& block, const ViewVolume& volume, const ClipWindow& window) {
  const Rays seen = rays(volume, window);
  block.relative_to_clip = relative_to_clip(volume, window);
  block.ray_right = Vec4(seen.right, 0), block.ray_up = Vec4(seen.up, 0), block.ray_forward = Vec4(seen.forward, 0);
  block.view_point = Vec4(seen.origin, volume.orthographic ? 1.0f : 0.0f);
}

/// The level whose water fills most of the view, by area, slant and distance; none when no water can be seen.
std::optional<float> Renderer::State::mirror_level(const FrameBlock& block, const ViewVolume& volume) const {
  std::optional<float> level;
  float most = 0;
  for (const WaterSurface& water : model.overhead.waters) {
    const Box3 box{{water.box.low.x, water.level_m, water.box.low.y},
                   {water.box.high.x, water.level_m, water.box.high.y}};
    if (volume.eye.y <= water.level_m || !may_be_seen(block.relative_to_clip, relative(box, volume.eye))) continue;
    const Vec3 away = glm::clamp(volume.eye, box.low, box.high) - volume.eye;
    const float distance = glm::length(away) + 1.0f;
    const float size = std::min(water.area_m2, distance * distance) * (volume.eye.y - water.level_m) /
                       (distance * distance * distance);
    if (size > most) most = size, level = water.level_m;
  }
  return level;
}

/// The scene upside down for the water, when water can be seen: the whole picture at half its size. Says so in `block`.
Result<void> Renderer::State::draw_mirror(FrameBlock& block, const ViewVolume& volume, const View& view) {
  if (volume.orthographic) return {};
  FrameBlock flipped = block;
  aim(flipped, volume, {});
  const std::optional<float> level = mirror_level(flipped, volume);
  if (!level) return {};

  // Looked at from below the surface, as far down as the eye is above it.
  const float lift = 2 * (*level - volume.eye.y);
  Mat4 upside_down(1.0f);
  upside_down[1][1] = -1;
  upside_down[3][1] = lift;
  flipped.relative_to_clip = flipped.relative_to_clip * upside_down;
  for (Vec4* axis : {&flipped.ray_right, &flipped.ray_up, &flipped.ray_forward, &flipped.forward}) axis->y *= -1;
  flipped.view_point = Vec4(0, lift, 0, 0);
  flipped.forward.w = 1;
  flipped.air.w = 0;
  flipped.shading.y = 1;
  flipped.clip = Vec4(0, 1, 0, volume.eye.y - *level);
  const float shrink = std::min(0.5f, kLargestMirror / static_cast<float>(std::max(view.width, view.height)));
  const int w = std::max(1, static_cast<int>(shrink * static_cast<float>(view.width)));
  const int h = std::max(1, static_cast<int>(shrink * static_cast<float>(view.height)));
  flipped.target = Vec4(w, h, 0, 0);
  if (!mirror.fit(w, h)) return cannot_finish("the graphics driver refuses a mirror picture for the water");
  glBindFramebuffer(GL_FRAMEBUFFER, mirror.framebuffer());
  glViewport(0, 0, w, h);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  draw_scene(flipped, volume, {.mirrored = true, .water_level = *level}, true);
  block.water.z = 1;
  block.water.w = *level;
  return {};
}

/// Draws the shadow maps, unless the draft's can be kept, and tells the block of them.
Result<void> Renderer::State::shade(FrameBlock& block, const ViewVolume& volume, const View& view) {
  const bool draft = view.quality == Quality::draft;
  const Vec3 to_sun(block.to_sun);
  int size = draft ? kDraftShadow : kSmallestShadow;
  while (!draft && size < kLargestShadow && size < std::max(view.width, view.height)) size *= 2;
  size = std::min<int>(size, largest_target);
  const int count = draft ? 1 : kCascades;
  const bool kept = draft && draft_shadow_count == scene_count && draft_shadow_sun == to_sun;
  ShadowTarget& map = draft ? draft_shadow : shadow;
  std::vector<Cascade> cascades = draft_cascade;
  if (!kept) {
    if (!map.fit(size, count))
      return cannot_finish("the graphics driver refuses shadow maps of " + std::to_string(size) + " x " +
                           std::to_string(size) + " texels");
    const ViewVolume seen = draft ? volume_from_above(model.box) : volume;
    cascades = fit_cascades(seen, model.box, to_sun, count, map.size());
    draw_shadows(map, cascades);
    if (draft) draft_cascade = cascades, draft_shadow_count = scene_count, draft_shadow_sun = to_sun;
  }
  shadow_map = map.texture();
  block.cascade_far.w = static_cast<float>(count);
  for (int c = 0; c < count; ++c) {
    const Cascade& cascade = cascades[static_cast<std::size_t>(c)];
    Mat4 from_eye(1.0f);
    from_eye[3] = Vec4(volume.eye, 1.0f);
    block.relative_to_shadow[c] = cascade.world_to_clip * from_eye;
    block.cascade_far[c] = cascade.far_depth;
    block.cascade_texel[c] = cascade.texel_m;
    block.cascade_depth[c] = cascade.depth_range_m;
  }
  return {};
}

void Renderer::State::draw_shadows(const ShadowTarget& map, const std::vector<Cascade>& cascades) {
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
  glDisable(GL_CULL_FACE);
  for (std::size_t c = 0; c < cascades.size(); ++c) {
    map.bind(static_cast<int>(c));
    glViewport(0, 0, map.size(), map.size());
    glClear(GL_DEPTH_BUFFER_BIT);
    const Mat4& to_clip = cascades[c].world_to_clip;
    for (const bool leaves : {false, true}) {
      const Program& program = leaves ? programs.shadow_leaf : programs.shadow_solid;
      glUseProgram(program.name());
      glUniformMatrix4fv(program.uniform("to_map"), 1, GL_FALSE, &to_clip[0][0]);
      std::vector<const Drawable*> parts;
      for (const Drawable& d : model.drawables) {
        const GpuMaterial& m = model.materials[d.material];
        if (m.shader == Shader::water || (m.shader == Shader::leaf && m.cutoff > 0) != leaves) continue;
        if (may_be_seen(to_clip, d.box, true)) parts.push_back(&d);
      }
      std::sort(parts.begin(), parts.end(), [](const Drawable* a, const Drawable* b) {
        return std::pair(a->material, a) < std::pair(b->material, b);
      });
      draw_parts(program, leaves ? Shader::leaf : Shader::solid, parts, Vec3(0.0f));
    }
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace bosquet::render
