#include "ui/pick.h"

#include <algorithm>
#include <cmath>

#include "ui/tools/standing_edits.h"

namespace bosquet::ui {
namespace {

// A ray this flat meets the ground nowhere that a hand could mean.
constexpr float kFarthest_m = 20000.0f;
constexpr int kHalvings = 24;
// Thin trunks are picked as if they were so thick, as seen from a metre away.
constexpr float kPickWidth = 0.004f;

float above(const terrain::Terrain& ground, const Vec3& p) {
  const Vec2 size = ground.size_m();
  const Vec2 at = glm::clamp(to_plan(p), Vec2(0.0f), size);
  return p.y - ground.ground(at);
}

// Distance along the ray to an ellipsoid with half axes (r, h, r), or a negative number.
float ellipsoid_hit(const SightRay& ray, const Vec3& centre, float r, float h) {
  const Vec3 scale(1.0f / r, 1.0f / h, 1.0f / r);
  const Vec3 o = (ray.origin - centre) * scale, d = ray.direction * scale;
  const float a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0f;
  const float root = b * b - a * c;
  if (root < 0.0f) return -1.0f;
  const float first = (-b - std::sqrt(root)) / a;
  return first > 0.0f ? first : (-b + std::sqrt(root)) / a;
}

// The same to an upright cylinder.
float trunk_hit(const SightRay& ray, const Vec3& foot, float radius, float height) {
  const Vec2 d(ray.direction.x, ray.direction.z), o(ray.origin.x - foot.x, ray.origin.z - foot.z);
  const float a = glm::dot(d, d);
  if (!(a > 0.0f)) return -1.0f;
  const float nearest = -glm::dot(o, d) / a;
  if (nearest <= 0.0f) return -1.0f;
  const float r = std::max(radius, kPickWidth * nearest);
  const float miss2 = glm::dot(o + nearest * d, o + nearest * d);
  if (miss2 > r * r) return -1.0f;
  const float y = ray.origin.y + nearest * ray.direction.y;
  return y >= foot.y && y <= foot.y + height ? nearest : -1.0f;
}

bool inside(const std::vector<Vec2>& outline, Vec2 p) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 a = outline[i], b = outline[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

}  // namespace

std::optional<Vec3> ground_hit(const terrain::Terrain& ground, const SightRay& ray) {
  float t = 0.0f, before = 0.0f;
  float height = above(ground, ray.origin);
  if (height < 0.0f) return {};
  const float cell = ground.height.lattice().cell_m;
  while (t < kFarthest_m) {
    before = t;
    // As far as nothing steeper than 1:1 can reach up to the ray, and never less than a part of a cell.
    t += std::max({0.5f * height, 0.5f * cell, 0.0005f * t});
    height = above(ground, ray.origin + t * ray.direction);
    if (height < 0.0f) break;
    if (ray.direction.y >= 0.0f && height > kFarthest_m) return {};
  }
  if (height >= 0.0f) return {};
  float after = t;
  for (int i = 0; i < kHalvings; ++i) {
    const float middle = 0.5f * (before + after);
    (above(ground, ray.origin + middle * ray.direction) < 0.0f ? after : before) = middle;
  }
  return ray.origin + after * ray.direction;
}

std::optional<std::int32_t> tree_hit(const scene::Document& document, const SightRay& ray) {
  std::optional<std::int32_t> hit;
  // Nothing behind the ground is meant.
  const std::optional<Vec3> end = ground_hit(*document.terrain, ray);
  float nearest = end ? glm::length(*end - ray.origin) + 0.5f : kFarthest_m;
  for (const scene::Tree& tree : *document.trees) {
    const crowns::RepresentativeShape& shape = document.species_of(tree).shape;
    const Vec3 foot = to_world(tree.at, document.terrain->ground(tree.at));
    const float half = 0.5f * tree.scale_height * shape.crown_height_m();
    const float base = tree.scale_height * shape.trunk_height_m;
    for (const float t :
         {ellipsoid_hit(ray, foot + Vec3(0, base + half, 0), 0.5f * tree.scale_width * shape.crown_width_m, half),
          trunk_hit(ray, foot, 0.5f * tree.scale_width * shape.trunk_width_m, base + half)})
      if (t > 0.0f && t < nearest) nearest = t, hit = tree.id;
  }
  for (const scene::HeroTree& hero : document.heroes) {
    const HeroExtent extent = extent_of(*hero.skeleton);
    const Vec3 foot = to_world(hero.at, document.terrain->ground(hero.at));
    // A crown over the upper two thirds.
    const float base = extent.height_m / 3.0f, half = 0.5f * (extent.height_m - base);
    const float trunk = hero.skeleton->size() > 0 ? hero.skeleton->radius[0] : 0.0f;
    for (const float t :
         {ellipsoid_hit(ray, foot + Vec3(0, base + half, 0), std::max(0.05f, extent.radius_m), std::max(0.05f, half)),
          trunk_hit(ray, foot, trunk, extent.height_m)})
      if (t > 0.0f && t < nearest) nearest = t, hit = hero.id;
  }
  return hit;
}

std::vector<std::int32_t> trees_inside(const scene::Document& document, const CameraRig& rig, Vec2 view_size,
                                       const std::vector<Vec2>& outline) {
  std::vector<std::int32_t> ids;
  if (outline.size() < 3) return ids;
  for (const scene::Tree& tree : *document.trees) {
    const auto seen = rig.project(to_world(tree.at, document.terrain->ground(tree.at)), view_size);
    if (seen && inside(outline, *seen)) ids.push_back(tree.id);
  }
  for (const scene::HeroTree& hero : document.heroes) {
    const auto seen = rig.project(to_world(hero.at, document.terrain->ground(hero.at)), view_size);
    if (seen && inside(outline, *seen)) ids.push_back(hero.id);
  }
  return ids;
}

}  // namespace bosquet::ui
