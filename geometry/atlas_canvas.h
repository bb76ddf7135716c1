// Atlas canvas: one cell of a leaf atlas being painted, back to front.
//
// Frame     metres: x from the cell's middle to the right, y up from its bottom edge, 0..side
// Model     every stroke and blade is composited over what lies there; a blade first shades what lies under it, so that
//           a card keeps some depth
// Colour    linear, alpha premultiplied; normals of the card: +x right, +y up
#pragma once

#include <vector>

#include "core/vec.h"
#include "geometry/atlas_blade.h"

namespace bosquet::geometry {

/// How a blade is held and coloured.
struct BladePose {
  Vec2 base{0.0f};             ///< metres
  Vec2 direction{0.0f, 1.0f};  ///< unit, base to tip
  float length = 0.1f;         ///< metres, as seen
  float narrow = 1.0f;         ///< width seen / width, by turning about the midrib
  float bend = 0.0f;           ///< the tip's shift to the right, in lengths
  Vec2 tilt{0.0f};             ///< slope of the whole blade, right and up in the cell
  Vec3 colour{0.1f};           ///< of the blade's middle
  Vec3 edge{0.1f};             ///< toward its edge
  Vec3 vein{0.2f};
  float mottle = 0.08f;  ///< strength of blotches
  float shadow = 0.4f;   ///< darkening of what lies under
};

class AtlasCanvas {
 public:
  AtlasCanvas(int pixels, float side_m, std::uint64_t seed);

  float side() const { return side_; }
  float pixel() const { return side_ / static_cast<float>(pixels_); }

  /// A round rod, thinning from radius ra to rb.
  void rod(Vec2 a, Vec2 b, float ra, float rb, const Vec3& colour_a, const Vec3& colour_b);

  /// A needle: a thin leaf-coloured spindle with a lit upper edge.
  void needle(Vec2 base, Vec2 tip, float width, const Vec3& colour, float shade);

  /// A shaded ball, `squash` as high as wide.
  void ball(Vec2 at, float radius, const Vec3& colour, float squash = 1.0f);

  /// A petal or wing from its base, broadest beyond its middle.
  void petal(Vec2 base, Vec2 tip, float width, const Vec3& colour, const Vec3& at_base);

  void blade(const LeafBlade& blade, const BladePose& pose);

  struct Texel {
    Vec3 colour{0.0f};  ///< premultiplied
    float alpha = 0.0f;
    Vec2 lean{0.0f};  ///< of the normal, right and up over toward the viewer; premultiplied
  };
  const Texel& at(int x, int y) const { return texels_[index(x, y)]; }
  int pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels_) + static_cast<std::size_t>(x);
  }
  Vec2 centre(int x, int y) const {
    return {(static_cast<float>(x) + 0.5f) * pixel() - 0.5f * side_, side_ - (static_cast<float>(y) + 0.5f) * pixel()};
  }
  struct Window {
    int x0, y0, x1, y1;
  };
  /// Pixels inside the margin whose centres lie in the box.
  Window window(Box2 box) const;
  void over(int x, int y, const Vec3& colour, float alpha, Vec2 lean);

  int pixels_;
  float side_;
  std::vector<Texel> texels_;
  TileFractal blotches_;
};

}  // namespace bosquet::geometry
