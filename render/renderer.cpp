#include "render/renderer.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "render/gl.h"
#include "render/renderer_state.h"
#include "render/srgb.h"

namespace bosquet::render {
namespace {

constexpr int kLargestPicture = 32768;
constexpr int kSamples = 4;

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
  state_->grass.clear();
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

void Renderer::set_grass_season(geometry::Season season) { state_->grass.set_season(season); }

void Renderer::put_grass(std::uint64_t key, const scene::GrassPatch& patch) { state_->grass.put(key, patch); }

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
      draw_scene(block, volume, {.grass_reach = view.orthographic_height_m > 0 ? 0.0f : view.grass_reach}, sky_drawn);
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

}  // namespace bosquet::render
