// Level raster: a small software rasteriser, to look at a tree from afar without a graphics card.
//
// Who       impostors are painted by it; crown shells and impostors are held to the area and colour that it measures
// Model     parallel projection, one sample a pixel, nearest surface wins. A textured surface covers a sample with the
//           probability of its alpha test there (a hash of sample and triangle), so that coverage is right on average
//           however small the texture is on the picture
// Colour    base colour times vertex colour, linear, no light
// Frame     the view's right and up axes; pixel (0, 0) is the upper left
// Holds     + - * / and sqrt alone: the same bits on every machine
// Cost      some 30 ns a triangle and 5 ns a sample
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/triangle_mesh.h"

namespace bosquet::geometry {

/// A texture as the rasteriser reads it: averages over ever larger squares.
class RasterSkin {
 public:
  RasterSkin();  ///< white
  /// sRGB with 3 or 4 channels; texels with alpha below `cutoff` are holes. An empty image is white.
  explicit RasterSkin(const Image& image, float cutoff = 0.0f);

  struct Texel {
    Vec3 colour{1.0f};  ///< linear, of what is covered
    float cover = 1.0f;
  };
  /// `texels` is how many texels of the whole image a sample spans; coordinates repeat.
  Texel at(Vec2 uv, float texels) const;
  int side() const { return side_; }  ///< of the finest level

 private:
  int side_ = 1;
  std::vector<std::vector<Texel>> levels_;
};

struct RasterSurface {
  const TriangleMesh* mesh = nullptr;
  const RasterSkin* skin = nullptr;
  bool one_sided = false;  ///< back faces are not drawn
};

struct RasterView {
  Vec3 right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};  ///< unit, at right angles; `toward` the viewer
  Vec2 low{-1.0f}, high{1.0f};                        ///< what the picture shows, along right and up

  /// Level view of what lies in `low`..`high` from this azimuth (0: from +z, then toward +x).
  static RasterView level(float azimuth);
  static RasterView from_above();
  Vec2 project(const Vec3& p) const { return {glm::dot(p, right), glm::dot(p, up)}; }
};

struct RasterPicture {
  int width = 0, height = 0;
  std::vector<Vec3> colour;         ///< linear
  std::vector<float> depth;         ///< along `toward`
  std::vector<std::uint8_t> drawn;  ///< whether something covers the sample

  RasterPicture(int w, int h);
};

void rasterize(std::span<const RasterSurface> surfaces, const RasterView& view, RasterPicture& picture);

/// Silhouette area (m2) and mean colour, over a picture of `side` samples across `box`.
struct Appearance {
  float area = 0.0f;
  Vec3 colour{0.0f};
};
Appearance appearance(std::span<const RasterSurface> surfaces, RasterView view, const Box3& box, int side);

/// The extent of a box in a view, widened by a share of its size on each side.
void frame(RasterView& view, const Box3& box, float margin);

}  // namespace bosquet::geometry
