#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "render/atmosphere.h"
#include "render/frustum.h"
#include "render/gl.h"
#include "render/gpu_model.h"
#include "render/lens.h"
#include "render/render_target.h"
#include "render/shaders.h"
#include "render/srgb.h"

namespace bosquet::render {
namespace {

constexpr int kCascades = 3;
constexpr int kSmallestShadow = 512, kLargestShadow = 4096;  ///< texels a side; as many as the picture has pixels
constexpr int kLargestPicture = 32768;
constexpr int kTileLimit = 4096;
constexpr int kSamples = 4;
constexpr float kLargestMirror = 2048;

/// Exposure puts a surface of 0.18 / kBrightness that lies open to the sky at the middle of the tone curve: plants
/// reflect about a tenth.
constexpr float kBrightness = 2.1f;

/// How far the eye adapts to the colour of the light.
constexpr float kWhiteBalance = 0.6f;

/// Woods around the site are at least this far away.
constexpr float kWoodsM = 700.0f;

/// The land around bears the ground's texture at this many metres a tile.
constexpr float kLandTileM = 3.0f;

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

/// Texels a side of the one shadow map of drafts.
constexpr int kDraftShadow = 2048;

/// Which parts of the scene a pass draws.
struct Pass {
  bool mirrored = false;
  float water_level = 0;
};

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

Box3 relative(const Box3& box, const Vec3& eye) { return {box.low - eye, box.high - eye}; }

Error check(const View& view) {
  const auto range = [](const char* what, int found, int low, int high) {
    return std::string("picture: ") + what + " is " + std::to_string(found) + ", allowed are " + std::to_string(low) +
           " to " + std::to_string(high);
  };
  if (view.width < 1 || view.width > kLargestPicture) return {range("width", view.width, 1, kLargestPicture)};
  if (view.height < 1 || view.height > kLargestPicture) return {range("height", view.height, 1, kLargestPicture)};
  if (view.samples < 0 || view.samples > 16) return {range("samples", view.samples, 0, 16)};
  if (view.supersample < 1 || view.supersample > 4) return {range("supersample", view.supersample, 1, 4)};
  const float fov = view.camera.vertical_fov_deg;
  if (!(view.orthographic_height_m > 0) && !(fov >= 1 && fov <= 170))
    return {"camera \"" + view.camera.name + "\": vertical field of view is " + std::to_string(fov) +
            " degrees, allowed are 1 to 170"};
  return {};
}

}  // namespace

struct Renderer::State {
  Programs programs;
  GpuModel model;
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

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create() {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major < 3 || (major == 3 && minor < 3))
    return cannot_finish("pictures need OpenGL 3.3, this context has " +
                         (major ? std::to_string(major) + "." + std::to_string(minor) : std::string("none")));
  auto state = std::make_unique<State>();
  Result<Programs> programs = Programs::make();
  if (!programs) return programs.error();
  state->programs = std::move(*programs);
  GLint largest_store = 0, viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_SAMPLES, &state->most_samples);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest_store);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &state->largest_target);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  state->largest_target = std::min({state->largest_target, largest_store, viewport[0], viewport[1]});
  state->frame = GlBuffer::make();
  state->nothing = GlVertexArray::make();
  Result<GpuModel> empty = GpuModel::make({});
  if (!empty) return empty.error();
  state->model = std::move(*empty);
  return Renderer(std::move(state));
}

Result<void> Renderer::upload(const scene::Model& model) {
  // What is there goes first: there may not be memory for both.
  state_->model = GpuModel();
  ++state_->scene_count;
  Result<GpuModel> made = GpuModel::make(model);
  if (!made) return made.error();
  state_->model = std::move(*made);
  return {};
}

Result<std::size_t> Renderer::add_materials(const MaterialLevels& materials) {
  return state_->model.add_materials(materials);
}

Result<void> Renderer::replace_colour(std::size_t material, const MaterialLevels& by) {
  ++state_->scene_count;
  return state_->model.replace_colour(material, by);
}

Result<void> Renderer::put(std::uint64_t key, const scene::Node& node) {
  ++state_->scene_count;
  return state_->model.put(key, node);
}

void Renderer::remove(std::uint64_t key) {
  ++state_->scene_count;
  state_->model.remove(key);
}

Result<void> Renderer::set_overhead(Overhead overhead) { return state_->model.set_overhead(std::move(overhead)); }

Box3 Renderer::bounds() const { return state_->model.box; }

void Renderer::set_tile_limit(int pixels) { state_->tile_limit = std::max(16, pixels); }
const DrawFacts& Renderer::facts() const { return state_->facts; }

// ---- one picture --------------------------------------------------------------------------------------------------

Result<Image> Renderer::draw(const View& view) {
  if (Error problem = check(view); !problem.message.empty()) return problem;
  View large = view;
  const int n = view.supersample;
  large.width *= n, large.height *= n;
  Image picture(view.width, view.height, 4);
  std::vector<std::uint8_t> pixels;
  const auto take = [&](int x, int y, int w, int h) {
    pixels.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    // Rows come from the bottom up; n x n pixels are averaged in linear light.
    parallel_for(static_cast<std::size_t>(h / n), [&](std::size_t row) {
      const int below = static_cast<int>(row) * n;
      const int to_y = (large.height - y - below) / n - 1;
      const float share = 1.0f / static_cast<float>(n * n);
      for (int column = 0; column < w / n; ++column) {
        std::uint8_t* out = picture.at(x / n + column, to_y);
        if (n == 1) {
          const std::uint8_t* in = pixels.data() + 4 * (static_cast<std::size_t>(below) * static_cast<std::size_t>(w) +
                                                        static_cast<std::size_t>(column));
          std::copy(in, in + 4, out);
          continue;
        }
        Vec4 sum(0.0f);
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const std::uint8_t* in =
                pixels.data() + 4 * (static_cast<std::size_t>(below + j) * static_cast<std::size_t>(w) +
                                     static_cast<std::size_t>(column * n + i));
            sum += Vec4(linear_of_srgb(in[0]), linear_of_srgb(in[1]), linear_of_srgb(in[2]), static_cast<float>(in[3]));
          }
        for (int c = 0; c < 3; ++c) out[c] = srgb_of_linear(sum[c] * share);
        out[3] = static_cast<std::uint8_t>(sum.a * share + 0.5f);
      }
    });
  };
  if (Result<void> drawn = state_->draw(large, take); !drawn) return drawn.error();
  return picture;
}

Result<void> Renderer::draw_into(unsigned framebuffer, const View& view) {
  if (Error problem = check(view); !problem.message.empty()) return problem;
  View plain = view;
  plain.supersample = 1;
  return state_->draw(plain, [&](int x, int y, int w, int h) {
    // Without conversion: the bytes are sRGB already.
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glBlitFramebuffer(0, 0, w, h, x, y, x + w, y + h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  });
}

/// Draws the picture tile by tile; take_tile finds each one bound for reading, its lower left corner at (x, y) of the
/// picture counted from its lower left.
Result<void> Renderer::State::draw(const View& view, const std::function<void(int x, int y, int w, int h)>& take_tile) {
  facts = {};
  shadow_map = 0;
  const int asked = view.samples > 0 ? view.samples : drawn_by_software() && view.supersample > 1 ? 1 : kSamples;
  facts.samples = std::min<int>(asked, most_samples);
  const bool natural = view.shading == Shading::natural;
  const ViewVolume volume = make_view_volume(view, model.box);
  FrameBlock block = light_block(view, volume);

  // Shadows and the mirror picture serve all tiles.
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (natural && block.cascade_far.w > 0)
    if (Result<void> shaded = shade(block, volume, view); !shaded) return shaded;

  const int supersample = std::max(1, view.supersample);
  const int limit = std::max(supersample, std::min<int>(tile_limit, largest_target) / supersample * supersample);
  const int tile_width = std::min(limit, view.width), tile_height = std::min(limit, view.height);
  if (!tile.fit(tile_width, tile_height, facts.samples))
    return cannot_finish("the graphics driver refuses a picture of " + std::to_string(tile_width) + " x " +
                         std::to_string(tile_height) + " pixels with " + std::to_string(facts.samples) + " samples");

  if (natural && view.quality == Quality::full)
    if (Result<void> drawn = draw_mirror(block, volume, view); !drawn) return drawn;

  for (int y = 0; y < view.height; y += tile_height)
    for (int x = 0; x < view.width; x += tile_width) {
      const int w = std::min(tile_width, view.width - x), h = std::min(tile_height, view.height - y);
      const Vec2 size(view.width, view.height);
      aim(block, volume, {Vec2(x, y) / size * 2.0f - 1.0f, Vec2(x + w, y + h) / size * 2.0f - 1.0f});
      block.target = Vec4(view.width, view.height, x, y);

      glBindFramebuffer(GL_FRAMEBUFFER, tile.drawn());
      glViewport(0, 0, w, h);
      glEnable(GL_FRAMEBUFFER_SRGB);
      const bool sky_drawn = view.sky && natural;
      const Vec3 back = view.shading == Shading::silhouette ? Vec3(1.0f) : view.background;
      glClearColor(back.r, back.g, back.b, view.sky || view.shading == Shading::silhouette ? 1.0f : 0.0f);
      glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      if (facts.samples > 1) glEnable(GL_MULTISAMPLE);
      draw_scene(block, volume, {}, sky_drawn);
      glDisable(GL_FRAMEBUFFER_SRGB);
      tile.resolve(w, h);
      glDisable(GL_FRAMEBUFFER_SRGB);
      take_tile(x, y, w, h);
      ++facts.tiles;
    }

  glUseProgram(0);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
  if (const GLenum problem = glGetError(); problem == GL_OUT_OF_MEMORY)
    return cannot_finish("the graphics driver ran out of memory while drawing");
  return {};
}

// ---- light --------------------------------------------------------------------------------------------------------

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
  draw_scene(flipped, volume, {true, *level}, true);
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

// ---- drawing ------------------------------------------------------------------------------------------------------

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
      const bool flag = shader == Shader::leaf ? m.whole_trees : m.double_sided;
      if (material_at >= 0) glUniform4f(material_at, m.roughness, cutoff, m.translucency, flag ? 1.0f : 0.0f);
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
