// Atmosphere: the light of sun and sky over a site, from how air and dust scatter it.
//
// Source    Nishita et al. 1993 (single scattering); Bruneton 2017 (coefficients of air, ozone, dust); Hillaire 2020,
//           section 5.5 (multiple scattering as one isotropic term)
// Units     lengths inside in km; radiance and irradiance relative to a sun of kSunAtTop above the air, linear RGB
//           white-balanced to that sun
// Frame     world; the table is symmetric about the sun's azimuth
// Holds     a function of sun and turbidity alone; all values finite and >= 0 (tested), also with the sun below the
//           horizon
// Cost      about 0.1 s on one core
#pragma once

#include <array>
#include <vector>

#include "core/vec.h"
#include "scene/model.h"

namespace bosquet::render {

/// Irradiance of the sun above the air, at right angles to it.
inline constexpr float kSunAtTop = 20.0f;

struct Atmosphere {
  /// Sky radiance: column i at azimuth pi * ((i + 1/2) / columns)^2 from the sun, row j at elevation
  /// pi/2 * ((j + 1/2) / rows)^2; rows from the horizon up.
  static constexpr int kColumns = 96, kRows = 96;
  std::vector<Vec3> radiance;

  Vec3 to_sun{0.0f, 1.0f, 0.0f};  ///< unit
  Vec3 sun_irradiance{0.0f};      ///< at the ground, at right angles to the sun; 0 with the sun below the horizon
  Vec3 sky_irradiance{0.0f};      ///< on level open ground

  /// Spherical harmonics (9 terms, order of Ramamoorthi and Hanrahan 2001) of the light from sky above and sunlit
  /// ground below, already convolved with the cosine: dot with the basis at a normal gives irradiance.
  std::array<Vec3, 9> ambient{};

  /// Radiance of the sky in a direction; at and below the horizon, that of the horizon.
  Vec3 sky(const Vec3& direction) const;

  /// Irradiance on a surface of this normal from everything but the sun itself.
  Vec3 ambient_irradiance(const Vec3& normal) const;
};

/// The light over ground of this mean albedo.
Atmosphere make_atmosphere(const scene::Sun& sun, float turbidity, const Vec3& ground_albedo);

/// Perceived brightness of linear RGB.
inline float luminance(const Vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

}  // namespace bosquet::render
