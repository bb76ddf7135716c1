#include "render/atmosphere.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace bosquet::render {
namespace {

// Bruneton 2017 for wavelengths 680, 550, 440 nm; lengths in km.
constexpr float kGroundRadius = 6360.0f, kTopRadius = 6460.0f;
const Vec3 kRayleigh(5.802e-3f, 13.558e-3f, 33.1e-3f);
constexpr float kRayleighScale = 8.0f;
constexpr float kMieScale = 1.2f;
constexpr float kMieForward = 0.76f;
const Vec3 kOzone(0.650e-3f, 1.881e-3f, 0.085e-3f);

/// The viewer stands this high, so that the horizon is not inside the ground.
constexpr float kViewerRadius = kGroundRadius + 0.05f;

/// Turbidity is the optical depth of air and dust over that of air alone, at 550 nm; continental dust dims blue more
/// (Angstrom exponent 1.3) and absorbs a tenth of what it takes out.
constexpr float kAirDepth = 0.098f;
const Vec3 kDustByColour(0.76f, 1.0f, 1.34f);
constexpr float kDustAlbedo = 0.9f;

struct Air {
  float dust;  ///< extinction at the ground, per km, at 550 nm

  Vec3 rayleigh(float height) const { return kRayleigh * std::exp(-height / kRayleighScale); }
  Vec3 mie_extinction(float height) const { return kDustByColour * (dust * std::exp(-height / kMieScale)); }
  Vec3 extinction(float height) const {
    const float ozone = std::max(0.0f, 1.0f - std::abs(height - 25.0f) / 15.0f);
    return rayleigh(height) + mie_extinction(height) + kOzone * ozone;
  }
};

/// Distance along a ray from radius r with cosine mu to a sphere of this radius, seen from inside.
float to_sphere(float r, float mu, float radius) {
  return -r * mu + std::sqrt(std::max(0.0f, r * r * (mu * mu - 1.0f) + radius * radius));
}

bool hits_ground(float r, float mu) {
  return mu < 0.0f && r * r * (mu * mu - 1.0f) + kGroundRadius * kGroundRadius > 0;
}

float to_ground(float r, float mu) {
  return -r * mu - std::sqrt(std::max(0.0f, r * r * (mu * mu - 1.0f) + kGroundRadius * kGroundRadius));
}

Vec3 exp_of(const Vec3& v) { return {std::exp(v.x), std::exp(v.y), std::exp(v.z)}; }

/// Share of the sun's light that reaches radius r when the sun's cosine of zenith distance there is mu; a soft edge
/// stands for the sun's size and twilight.
class SunThroughAir {
 public:
  explicit SunThroughAir(const Air& air) {
    table_.resize(kHeights * kCosines);
    parallel_for(kHeights, [&](std::size_t i) {
      const float height = (kTopRadius - kGroundRadius) * std::pow(static_cast<float>(i) / (kHeights - 1), 2.0f);
      const float r = kGroundRadius + std::max(height, 0.001f);
      for (std::size_t j = 0; j < kCosines; ++j) {
        const float mu = -0.25f + 1.25f * static_cast<float>(j) / (kCosines - 1);
        const float length = to_sphere(r, mu, kTopRadius);
        Vec3 depth(0.0f);
        constexpr int kSteps = 32;
        float before = 0;
        for (int s = 1; s <= kSteps; ++s) {
          const float after = length * std::pow(static_cast<float>(s) / kSteps, 2.0f);
          const float t = 0.5f * (before + after);
          const float here = std::sqrt(r * r + t * t + 2 * r * t * mu);
          depth += air.extinction(std::max(here - kGroundRadius, 0.0f)) * (after - before);
          before = after;
        }
        // The ground hides the sun below its horizon.
        const float horizon = -std::sqrt(std::max(0.0f, 1 - (kGroundRadius / r) * (kGroundRadius / r)));
        const float seen = glm::smoothstep(-0.02f, 0.01f, mu - horizon);
        table_[i * kCosines + j] = exp_of(-depth) * seen;
      }
    });
  }

  Vec3 operator()(float r, float mu) const {
    const float x =
        std::sqrt(std::clamp((r - kGroundRadius) / (kTopRadius - kGroundRadius), 0.0f, 1.0f)) * (kHeights - 1);
    const float y = std::clamp((mu + 0.25f) / 1.25f, 0.0f, 1.0f) * (kCosines - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kHeights - 2);
    const auto j = std::min(static_cast<std::size_t>(y), kCosines - 2);
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const Vec3* t = table_.data() + i * kCosines + j;
    return glm::mix(glm::mix(t[0], t[1], v), glm::mix(t[kCosines], t[kCosines + 1], v), u);
  }

 private:
  static constexpr std::size_t kHeights = 32, kCosines = 192;
  std::vector<Vec3> table_;
};

/// What one ray gathers, with light scattered more than once given as isotropic radiance per height.
struct Gathered {
  Vec3 light{0.0f};    ///< per unit of sun irradiance
  Vec3 through{1.0f};  ///< transmittance to the ray's end
  Vec3 spread{0.0f};   ///< light scattered from an even environment of radiance 1 (Hillaire's f_ms integrand)
};

constexpr std::size_t kScatterHeights = 24;

struct Scattering {
  const Air& air;
  const SunThroughAir& sun;
  Vec3 to_sun;
  Vec3 ground_albedo;
  std::array<Vec3, kScatterHeights> multiple{};  ///< by height, as the square root of height / thickness of the air

  Vec3 multiple_at(float height) const {
    const float x = std::sqrt(std::clamp(height / (kTopRadius - kGroundRadius), 0.0f, 1.0f)) * (kScatterHeights - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kScatterHeights - 2);
    return glm::mix(multiple[i], multiple[i + 1], x - static_cast<float>(i));
  }

  /// March from `from` (planet centre at the origin) along `ray`; isotropic: phase functions are 1 / 4 pi.
  Gathered gather(const Vec3& from, const Vec3& ray, int steps, bool isotropic) const {
    const float r = glm::length(from), mu = glm::dot(from, ray) / r;
    const bool ground = hits_ground(r, mu);
    const float length = ground ? to_ground(r, mu) : to_sphere(r, mu, kTopRadius);
    const float nu = glm::dot(ray, to_sun);
    const float even = 1.0f / (4 * kPi);
    const float rayleigh_phase = isotropic ? even : 3.0f / (16 * kPi) * (1 + nu * nu);
    const float g = kMieForward;
    const float mie_phase = isotropic ? even
                                      : 3.0f / (8 * kPi) * (1 - g * g) * (1 + nu * nu) /
                                            ((2 + g * g) * std::pow(1 + g * g - 2 * g * nu, 1.5f));
    Gathered sum;
    float before = 0;
    for (int s = 1; s <= steps; ++s) {
      const float share = static_cast<float>(s) / static_cast<float>(steps);
      const float after = length * share * share;
      const float t = 0.5f * (before + after), step = after - before;
      before = after;
      const Vec3 at = from + ray * t;
      const float radius = glm::length(at), height = std::max(radius - kGroundRadius, 0.0f);
      const Vec3 rayleigh = air.rayleigh(height);
      const Vec3 mie = air.mie_extinction(height) * kDustAlbedo;
      const Vec3 extinction = air.extinction(height);
      const Vec3 sunlight = sun(radius, glm::dot(at, to_sun) / radius);
      const Vec3 source =
          sunlight * (rayleigh * rayleigh_phase + mie * mie_phase) + (rayleigh + mie) * multiple_at(height);
      const Vec3 across = exp_of(-extinction * step);
      const Vec3 weight = sum.through * (Vec3(1.0f) - across) / glm::max(extinction, Vec3(1e-9f));
      sum.light += source * weight;
      sum.spread += (rayleigh + mie) * weight;
      sum.through *= across;
    }
    if (ground) {
      const Vec3 at = from + ray * length;
      const Vec3 up = glm::normalize(at);
      const float cosine = std::max(0.0f, glm::dot(up, to_sun));
      sum.light += sum.through * sun(kGroundRadius + 0.001f, glm::dot(up, to_sun)) * cosine * ground_albedo / kPi;
    }
    return sum;
  }
};

/// Evenly spread directions (Fibonacci spiral).
Vec3 spread_direction(int i, int n) {
  const float y = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(n);
  const float angle = static_cast<float>(i) * 2.39996323f, ring = std::sqrt(std::max(0.0f, 1 - y * y));
  return {ring * std::cos(angle), y, ring * std::sin(angle)};
}

std::array<float, 9> harmonics(const Vec3& n) {
  return {0.282095f,
          0.488603f * n.y,
          0.488603f * n.z,
          0.488603f * n.x,
          1.092548f * n.x * n.y,
          1.092548f * n.y * n.z,
          0.315392f * (3 * n.z * n.z - 1),
          1.092548f * n.x * n.z,
          0.546274f * (n.x * n.x - n.y * n.y)};
}

}  // namespace

Vec3 Atmosphere::sky(const Vec3& direction) const {
  const float elevation = std::asin(std::clamp(direction.y, 0.0f, 1.0f));
  const Vec2 flat(direction.x, direction.z), sun_flat(to_sun.x, to_sun.z);
  const float both = glm::length(flat) * glm::length(sun_flat);
  const float azimuth = both > 1e-9f ? std::acos(std::clamp(glm::dot(flat, sun_flat) / both, -1.0f, 1.0f)) : 0.0f;
  const float x = std::sqrt(azimuth / kPi) * kColumns - 0.5f, y = std::sqrt(elevation / (kPi / 2)) * kRows - 0.5f;
  const auto texel = [&](int i, int j) {
    i = std::clamp(i, 0, kColumns - 1), j = std::clamp(j, 0, kRows - 1);
    return radiance[static_cast<std::size_t>(j * kColumns + i)];
  };
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), u), glm::mix(texel(i, j + 1), texel(i + 1, j + 1), u), v);
}

Vec3 Atmosphere::ambient_irradiance(const Vec3& normal) const {
  const std::array<float, 9> basis = harmonics(normal);
  Vec3 sum(0.0f);
  for (std::size_t i = 0; i < 9; ++i) sum += ambient[i] * basis[i];
  return glm::max(sum, Vec3(0.0f));
}

Atmosphere make_atmosphere(const scene::Sun& sun, float turbidity, const Vec3& ground_albedo) {
  Atmosphere out;
  out.to_sun = sun.direction();
  const Air air{kAirDepth * std::max(0.05f, turbidity - 1.0f) / kMieScale};
  const SunThroughAir through(air);
  Scattering scattering{air, through, out.to_sun, ground_albedo};

  // Multiple scattering per height: second order, then the geometric series of all later ones.
  std::array<Vec3, kScatterHeights> multiple{};
  parallel_for(kScatterHeights, [&](std::size_t h) {
    const float share = static_cast<float>(h) / (kScatterHeights - 1);
    const Vec3 at(0, kGroundRadius + std::max(0.01f, (kTopRadius - kGroundRadius) * share * share), 0);
    constexpr int kDirections = 64;
    Vec3 second(0.0f), again(0.0f);
    for (int d = 0; d < kDirections; ++d) {
      const Gathered g = scattering.gather(at, spread_direction(d, kDirections), 20, true);
      second += g.light / static_cast<float>(kDirections);
      again += g.spread / static_cast<float>(kDirections);
    }
    multiple[h] = second / (Vec3(1.0f) - glm::min(again, Vec3(0.95f)));
  });
  scattering.multiple = multiple;

  // The table of the sky.
  out.radiance.resize(static_cast<std::size_t>(Atmosphere::kColumns * Atmosphere::kRows));
  const Vec3 eye(0, kViewerRadius, 0);
  const float sun_azimuth = std::atan2(out.to_sun.z, out.to_sun.x);
  const auto direction_of = [&](float column, float row) {
    const float azimuth = sun_azimuth + kPi * std::pow(column / Atmosphere::kColumns, 2.0f);
    const float elevation = kPi / 2 * std::pow(row / Atmosphere::kRows, 2.0f);
    return Vec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth));
  };
  parallel_for(static_cast<std::size_t>(Atmosphere::kRows), [&](std::size_t j) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(Atmosphere::kColumns); ++i) {
      const Vec3 ray = direction_of(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f);
      out.radiance[j * static_cast<std::size_t>(Atmosphere::kColumns) + i] =
          scattering.gather(eye, ray, 40, false).light * kSunAtTop;
    }
  });

  out.sun_irradiance = through(kViewerRadius, out.to_sun.y) * kSunAtTop;
  if (out.to_sun.y <= 0.0f) out.sun_irradiance = Vec3(0.0f);

  // Light from all around by quadrature: the sky above, then ground lit by sun and sky below.
  constexpr int kDirections = 2048;
  constexpr float kSolidAngle = 4 * kPi / kDirections;
  for (int d = 0; d < kDirections; ++d) {
    const Vec3 ray = spread_direction(d, kDirections);
    if (ray.y > 0) out.sky_irradiance += out.sky(ray) * (ray.y * kSolidAngle);
  }
  const Vec3 ground = ground_albedo / kPi * (out.sky_irradiance + out.sun_irradiance * std::max(0.0f, out.to_sun.y));
  for (int d = 0; d < kDirections; ++d) {
    const Vec3 ray = spread_direction(d, kDirections);
    const Vec3 light = ray.y > 0 ? out.sky(ray) : ground;
    const std::array<float, 9> basis = harmonics(ray);
    for (std::size_t i = 0; i < 9; ++i) out.ambient[i] += light * (basis[i] * kSolidAngle);
  }
  // Convolution with the cosine scales the bands by pi, 2 pi / 3, pi / 4.
  for (std::size_t i = 0; i < 9; ++i) out.ambient[i] *= i == 0 ? kPi : i < 4 ? 2 * kPi / 3 : kPi / 4;
  return out;
}

}  // namespace bosquet::render
