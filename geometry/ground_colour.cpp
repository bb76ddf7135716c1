#include "geometry/ground_colour.h"

#include <algorithm>
#include <array>
#include <optional>

#include "geometry/ground_texture.h"
#include "geometry/noise.h"

namespace bosquet::geometry {
namespace {

using terrain::Cover;

// Around the water the ground is wet up to so far above its level.
constexpr float kWetRise_m = 0.25f;

// By Season.
constexpr std::array<Vec3, 4> kMeadowTint{Vec3{0.94f, 1.06f, 0.90f}, Vec3{1.0f}, Vec3{1.34f, 1.06f, 0.98f},
                                          Vec3{1.22f, 0.94f, 0.98f}};
constexpr std::array<Vec3, 4> kLawnTint{Vec3{0.96f, 1.06f, 0.92f}, Vec3{1.0f}, Vec3{1.10f, 0.99f, 0.96f},
                                        Vec3{1.12f, 0.90f, 0.94f}};

}  // namespace

Vec3 season_tint(Cover cover, Season season) {
  const auto s = static_cast<std::size_t>(season);
  return cover == Cover::natural ? kMeadowTint[s] : cover == Cover::grass ? kLawnTint[s] : Vec3(1.0f);
}

Vec3 ground_albedo(const terrain::Terrain& terrain, Cover cover, const GroundPlace& place, Season season) {
  Vec3 albedo = cover_colour(cover) * season_tint(cover, season);
  if (cover == Cover::natural) {
    albedo = glm::mix(albedo, kForestFloorColour, std::clamp(place.shade, 0.0f, 1.0f));
    albedo = glm::mix(kSoilColour, albedo, smooth_step(kBareGround, kSteepGround, place.normal.y));
  }
  if (const std::optional<float> level = terrain.water_level(place.plan)) {
    const float rise = place.height_m - *level;
    albedo = glm::mix(kWetSandColour, albedo, smooth_step(0.25f * kWetRise_m, kWetRise_m, rise));
    albedo *= glm::mix(0.55f, 1.0f, smooth_step(-0.8f, 0.0f, rise));  // darker with depth
  }
  return albedo;
}

}  // namespace bosquet::geometry
