// Shaders: the GLSL of the renderer and the block of values that all of them read.
//
// Frame     "relative" positions are world minus the eye of the picture, so that far sites keep their precision
// Units     metres; light already multiplied by the exposure
#pragma once

#include <string>

#include "core/result.h"
#include "core/vec.h"
#include "render/gl.h"

namespace bosquet::render {

inline constexpr int kMostCascades = 3;

/// Uniform block `Frame`, std140: one per pass.
struct FrameBlock {
  Mat4 relative_to_clip;
  Mat4 relative_to_shadow[kMostCascades];
  Vec4 cascade_far;    ///< depths where each cascade ends; w: their number, 0 without shadows
  Vec4 cascade_texel;  ///< metres
  Vec4 cascade_depth;  ///< metres between the near and far end of each
  Vec4 eye;            ///< world
  Vec4 view_point;     ///< relative; where it is looked from (0, or the eye's mirror image); w: 1 if orthographic
  Vec4 forward;        ///< of the view; w: 1 in the mirrored pass
  Vec4 ray_right, ray_up, ray_forward;  ///< a pixel looks along forward + x right + y up, x and y in -1..1
  Vec4 to_sun;
  Vec4 gain;         ///< exposure and white balance, in all light but the sky's table
  Vec4 sun_light;    ///< irradiance
  Vec4 sky_light;    ///< irradiance on level ground
  Vec4 ambient[9];   ///< spherical harmonics of irradiance
  Vec4 air;          ///< 1 / haze distance, clouds, ripples, encode (0 linear light, 1 for the screen)
  Vec4 tone;         ///< contrast, shoulder, b, c of the tone curve
  Vec4 over_area;    ///< low x, low z, 1 / size x, 1 / size z of the overhead maps
  Vec4 over_height;  ///< base, 1 / scale, height of the land around, 1 if that land is drawn
  Vec4 land;         ///< tint of plain land around the site, metres to the woods around
  Vec4 ground_box;   ///< world low x, low z, high x, high z of the ground
  Vec4 water;        ///< level, 1 if it flows on beyond the ground, 1 if `mirror` holds the scene mirrored at level w
  Vec4 target;       ///< width and height of the whole picture in pixels, then where this tile begins in it
  Vec4 lens;         ///< half width and half height of the whole picture at depth 1
  Vec4 shading;      ///< x: 0 natural, 1 flat, 2 silhouette; y: samples
  Vec4 clip;         ///< plane, relative: keeps dot(plane, (p, 1)) >= 0
};

/// A linked program that owns itself.
class Program {
 public:
  /// Compiles; an error names the shader and quotes the driver's log.
  static Result<Program> make(const std::string& name, const std::string& vertex, const std::string& fragment);

  Program() = default;
  Program(Program&& o) noexcept : name_(std::exchange(o.name_, 0)) {}
  Program& operator=(Program&& o) noexcept {
    std::swap(name_, o.name_);
    return *this;
  }
  ~Program() {
    if (name_) glDeleteProgram(name_);
  }

  GLuint name() const { return name_; }
  GLint uniform(const char* uniform_name) const { return glGetUniformLocation(name_, uniform_name); }

 private:
  GLuint name_ = 0;
};

/// Texture units by the names the shaders use.
enum TextureUnit : GLint { kUnitColour, kUnitNormal, kUnitShadow, kUnitSky, kUnitCover, kUnitGround, kUnitMirror };

/// The renderer's programs.
struct Programs {
  Program solid, leaf_cover, leaf, ground, grass, water, sky, shadow_solid, shadow_leaf;

  static Result<Programs> make();
};

}  // namespace bosquet::render
