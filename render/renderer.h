// Renderer: draws a model as an architect would want it on a board.
//
// Light     sun and sky from one atmosphere (render/atmosphere.h); the sun through cascaded shadow maps with soft
//           edges, the sky through a blurred map of what stands overhead, so that ground under crowns is dim and
//           never black
// Surfaces  leaves let light through and keep their cover at any distance (alpha to coverage, mips that keep cover);
//           bark, ground and obstacles take normal maps without tangents; water mirrors scene and sky by Fresnel
// Output    sRGB, 4 channels, alpha 255 (0 where `sky` is off and nothing stands)
// Context   everything here needs a current OpenGL context of at least 3.3 core on the calling thread: from
//           render/headless_context.h or from a window; the destructor too
// Errors    no usable context, too little graphics memory, a size the driver cannot draw: Result, kind cannot_finish;
//           a size or sample count outside the ranges of render/view.h: kind input
// Holds     the same model and view give the same picture on one machine and driver; other drivers differ slightly
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.h"
#include "core/result.h"
#include "render/overhead.h"
#include "render/texture_levels.h"
#include "render/view.h"
#include "scene/grass.h"
#include "scene/model.h"

namespace bosquet::render {

/// What the last draw() cost, all passes and tiles together.
struct DrawFacts {
  std::size_t triangles_sent = 0;    ///< after culling, over all passes
  std::size_t triangles_viewed = 0;  ///< of the main pass alone
  int draws = 0, tiles = 0, samples = 0;
};

class Renderer {
 public:
  /// A renderer for the current context.
  static Result<Renderer> create();

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Copies the model to graphics memory, in place of an earlier one; meshes that several nodes share are copied once.
  /// Nothing of `model` is needed afterwards.
  Result<void> upload(const scene::Model& model);

  // For a scene that changes while it is looked at: nodes of its own beside those of the uploaded model. A mesh that
  // several of them share is copied once.

  /// Adds materials (render/texture_levels.h) behind those that are there; the index of the first one.
  Result<std::size_t> add_materials(const MaterialLevels& materials);
  /// Puts the colours of the first of `by` in place of those of a material that has some.
  Result<void> replace_colour(std::size_t material, const MaterialLevels& by);
  /// Sets the node with a key, in place of an earlier one with it; its materials must be there.
  Result<void> put(std::uint64_t key, const scene::Node& node);
  /// Takes the node with a key away, if there is one.
  void remove(std::uint64_t key);
  /// The season that grass is drawn in; before any of it.
  void set_grass_season(geometry::Season season);
  /// Sets a patch of grass with a key of its own, in place of an earlier one; an empty one takes it away.
  void put_grass(std::uint64_t key, const scene::GrassPatch& patch);
  /// Maps of what stands overhead (render/overhead.h), made anew by whoever changed the scene; put() and remove() leave
  /// them as they were.
  Result<void> set_overhead(Overhead overhead);
  /// Around all that is drawn, world.
  Box3 bounds() const;

  /// The picture, first row at the top. Drawn in tiles when it is larger than the driver's or our limit.
  Result<Image> draw(const View& view);

  /// The same picture into the lower left of a framebuffer of the caller (0: the window), as sRGB bytes, whether its
  /// format says so or not; `supersample` is not used. GL state it leaves: that framebuffer bound, depth test on,
  /// blending and culling off, no program.
  Result<void> draw_into(unsigned framebuffer, const View& view);

  /// Longest side of a tile in pixels (default 4096, at least 16); tests draw small tiles.
  void set_tile_limit(int pixels);

  const DrawFacts& facts() const;

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace bosquet::render
