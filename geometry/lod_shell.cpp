#include "geometry/lod_shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/leaf_atlas.h"
#include "geometry/shares.h"
#include "geometry/vec_lanes.h"

namespace bosquet::geometry {
namespace {

constexpr int kShellSilhouette = 64;  // samples across, to measure silhouettes
constexpr float kFirstOverlap = 1.5f;
constexpr float kOwnWay = 0.7f;
constexpr int kRounds = 8;  // of measuring and mending

struct Patch {
  Vec3 centre{0.0f}, normal{0.0f}, colour{0.0f};
  Vec2 way{0.0f};  // of its wind weights
  std::uint8_t phase = 0;
  float weight = 0.0f;
};

// Direction number k of n, evenly spread.
Vec3 direction(std::size_t k, std::size_t n) {
  constexpr float kGoldenAngle = 2.399963f;
  const float y = 1.0f - (2.0f * static_cast<float>(k) + 1.0f) / static_cast<float>(n);
  const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
  const SinCos a = sin_cos(kGoldenAngle * static_cast<float>(k % 64) + 0.7f * static_cast<float>(k / 64));
  return {r * a.cos, y, r * a.sin};
}

std::vector<Patch> divide(const TriangleMesh& foliage, const Box3& box, std::size_t count) {
  std::vector<Vec3> directions(count);
  for (std::size_t k = 0; k < count; ++k) directions[k] = direction(k, count);
  const Vec3 middle = box.centre(), half = glm::max(0.5f * box.size(), Vec3(0.05f));
  std::vector<Patch> patches(count);
  for (std::size_t i = 0; i + 2 < foliage.indices.size(); i += 3) {
    const std::uint32_t *c = &foliage.indices[i], a = c[0];
    const Vec3 at = (foliage.positions[a] + foliage.positions[c[1]] + foliage.positions[c[2]]) / 3.0f;
    const Vec3 n =
        glm::cross(foliage.positions[c[1]] - foliage.positions[a], foliage.positions[c[2]] - foliage.positions[a]);
    const Vec3 place = (at - middle) / half;
    const float out2 = std::min(glm::dot(place, place), 1.5f);
    std::size_t nearest = 0;
    float most = -2.0f;
    for (std::size_t k = 0; k < count; ++k)
      if (const float d = glm::dot(place, directions[k]); d > most) most = d, nearest = k;
    // What lies far out is what is seen.
    const float weight = std::sqrt(glm::dot(n, n)) * (0.02f + out2 * out2);
    Patch& patch = patches[nearest];
    patch.weight += weight;
    patch.centre += weight * at;
    patch.colour += weight * (foliage.colours.empty() ? Vec3(1.0f) : Vec3(foliage.colours[a]) / 255.0f);
    if (!foliage.wind.empty()) {
      patch.way += weight * Vec2(foliage.wind[a].x, foliage.wind[a].y);
      patch.phase = foliage.wind[a].w;
    }
  }
  std::erase_if(patches, [](const Patch& p) { return p.weight <= 0.0f; });
  for (Patch& p : patches) {
    p.centre = p.centre / p.weight, p.colour = p.colour / p.weight, p.way = p.way / p.weight;
    p.normal = unit((p.centre - middle) / (half * half), kUp);
  }
  return patches;
}

TriangleMesh mesh_of(const std::vector<Patch>& patches, float side, float lift, const Vec3& tint, std::uint64_t key) {
  TriangleMesh mesh;
  RandomStream random(1, key, Purpose::foliage);
  for (const Patch& p : patches) {
    // No two alike: a crown's surface is clumps, not a ball's.
    const Vec3 own_way{random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f)};
    const Vec3 faces = unit(p.normal + kOwnWay * own_way + lift * kUp, kUp);
    AtlasCell cell = cluster_cell(static_cast<int>(random.below(2)));
    const float margin = 0.5f * kAtlasMargin;
    cell = {cell.u0 + margin, cell.v0 + margin, cell.u1 - margin, cell.v1 - margin};
    if (random.below(2)) std::swap(cell.u0, cell.u1);
    const float own = 0.5f * side * random.uniform(0.9f, 1.1f);
    const Vec3 right = unit(glm::cross(kUp, faces), {1, 0, 0}), up = glm::cross(faces, right);
    const Vec3 colour = p.colour * tint;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 4; ++k) {
      const float x = k & 1 ? own : -own, y = k & 2 ? own : -own;
      mesh.positions.push_back(p.centre + x * right + y * up);
      mesh.normals.push_back(unit(p.normal + 0.35f * (x * right + y * up) / own, p.normal));
      mesh.uvs.push_back({k & 1 ? cell.u1 : cell.u0, k & 2 ? cell.v0 : cell.v1});
      mesh.colours.push_back({unorm8(colour.x), unorm8(colour.y), unorm8(colour.z), 255});
    }
    for (std::uint32_t k : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.indices.push_back(base + k);
  }
  return mesh;
}

// Silhouettes from the side and from above, and the colour of all.
struct Seen {
  float level = 0.0f, above = 0.0f;
  Vec3 colour{0.0f};
};

Seen look_at(const TriangleMesh& mesh, const RasterSkin& skin, const Box3& box) {
  const RasterSurface surface[] = {{&mesh, &skin}};
  Seen seen;
  for (int k = 0; k < 3; ++k) {
    const Appearance a =
        appearance(surface, RasterView::level(kPi * static_cast<float>(k) / 3.0f), box, kShellSilhouette);
    seen.level += a.area / 3.0f, seen.colour += a.area * a.colour;
  }
  const Appearance a = appearance(surface, RasterView::from_above(), box, kShellSilhouette);
  seen.above = a.area, seen.colour += a.area * a.colour;
  const float all = 3.0f * seen.level + seen.above;
  if (all > 0.0f) seen.colour = seen.colour / all;
  return seen;
}

}  // namespace

TriangleMesh crown_shell(const TriangleMesh& foliage, const RasterSkin& leaf, const RasterSkin& mass,
                         std::size_t patches, std::uint64_t key) {
  if (foliage.empty() || patches == 0) return {};
  const Box3 box = foliage.bounds();
  const std::vector<Patch> parts = divide(foliage, box, patches);
  const Seen wanted = look_at(foliage, leaf, box);

  // Sides that tile the ellipsoid of the crown, then mended by what is seen. Parts stand at their middle, so the crown
  // must be spread a little for its plan to be as wide.
  const Vec3 half = 0.5f * box.size();
  const float surface = 4.0f * kPi / 3.0f * (half.x * half.y + half.y * half.z + half.z * half.x);
  float side = kFirstOverlap * std::sqrt(surface / static_cast<float>(parts.size())), spread = 1.0f, lift = 0.3f;
  Vec3 tint{1.0f};
  const auto built = [&] {
    std::vector<Patch> placed = parts;
    for (Patch& p : placed) p.centre = box.centre() + Vec3(spread, 1.0f, spread) * (p.centre - box.centre());
    return mesh_of(placed, side, lift, tint, key);
  };
  Box3 around = box;
  around.add(box.low - 0.3f * half), around.add(box.high + 0.3f * half);
  TriangleMesh mesh = built();
  for (int round = 0; round < kRounds; ++round) {
    const Seen got = look_at(mesh, mass, around);
    if (got.level <= 0.0f || got.above <= 0.0f || wanted.level <= 0.0f || wanted.above <= 0.0f) break;
    const float level = wanted.level / got.level, above = wanted.above / got.above;
    // More seen from above: patches lie flatter; where that is not enough, they stand farther out.
    const float flatter = std::clamp(above / level, 0.6f, 1.6f);
    lift = std::clamp(lift + 1.2f * (flatter - 1.0f), -0.3f, 2.5f);
    spread = std::clamp(spread * std::sqrt(std::sqrt(flatter)), 0.8f, 1.2f);
    // Between the square root of the ratio (patches apart) and the ratio itself (patches that overlap).
    const float root = std::sqrt(std::sqrt(level * above));
    side *= std::clamp(root * std::sqrt(root), 0.7f, 1.4f);
    for (int c = 0; c < 3; ++c)
      if (got.colour[c] > 0.0f) tint[c] = std::clamp(tint[c] * wanted.colour[c] / got.colour[c], 0.2f, 3.0f);
    mesh = built();
  }
  // A patch moves as a whole.
  if (!foliage.wind.empty())
    for (const Patch& p : parts)
      mesh.wind.insert(mesh.wind.end(), 4, {unorm8(p.way.x / 255.0f), unorm8(p.way.y / 255.0f), 0, p.phase});
  return mesh;
}

}  // namespace bosquet::geometry
