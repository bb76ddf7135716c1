#include "geometry/human_figure.h"

#include <initializer_list>
#include <vector>

#include "core/scalar.h"

namespace bosquet::geometry {
namespace {

constexpr std::uint32_t kBodySides = 16;

// A level ellipse: x along the walk, z across it.
struct BodyRing {
  Vec3 centre;
  float half_x, half_z;
};

// A closed tube through rings from below upward or from above downward.
void add_body(TriangleMesh& mesh, const std::vector<BodyRing>& rings) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const bool upward = rings.back().centre.y > rings.front().centre.y;
  for (const BodyRing& ring : rings)
    for (std::uint32_t k = 0; k < kBodySides; ++k) {
      const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(k) / static_cast<float>(kBodySides));
      mesh.positions.push_back(ring.centre + Vec3(ring.half_x * a.cos, 0.0f, ring.half_z * a.sin));
      mesh.normals.push_back(glm::normalize(Vec3(a.cos / ring.half_x, 0.0f, a.sin / ring.half_z)));
    }
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {first + a, first + (upward ? b : c), first + (upward ? c : b)});
  };
  const auto last = static_cast<std::uint32_t>(rings.size() - 1);
  for (std::uint32_t r = 0; r < last; ++r)
    for (std::uint32_t k = 0; k < kBodySides; ++k) {
      const std::uint32_t a = r * kBodySides + k, b = r * kBodySides + (k + 1) % kBodySides;
      triangle(a, a + kBodySides, b), triangle(b, a + kBodySides, b + kBodySides);
    }
  for (std::uint32_t k = 1; k + 1 < kBodySides; ++k) {
    triangle(0, k, k + 1);
    triangle(last * kBodySides, last * kBodySides + k + 1, last * kBodySides + k);
  }
}

// A leg in mid-stride: foot at `stride` along the walk, knee bent by `bend`.
void add_leg(TriangleMesh& mesh, float side, float stride, float bend, float lift) {
  const Vec3 hip(0.0f, 0.92f, 0.085f * side), knee(0.42f * stride + bend, 0.49f, 0.08f * side),
      ankle(stride, 0.085f + lift, 0.075f * side);
  add_body(mesh, {{hip, 0.092f, 0.085f},
                  {glm::mix(hip, knee, 0.45f), 0.084f, 0.076f},
                  {knee, 0.060f, 0.056f},
                  {glm::mix(knee, ankle, 0.35f), 0.060f, 0.054f},
                  {ankle, 0.040f, 0.038f}});
  const Vec3 sole(stride, lift, 0.075f * side), toe(0.055f, 0.0f, 0.0f);
  add_body(mesh, {{ankle, 0.042f, 0.040f},
                  {sole + 0.8f * toe + Vec3(0, 0.055f, 0), 0.095f, 0.042f},
                  {sole + toe + Vec3(0, 0.025f, 0), 0.130f, 0.046f},
                  {sole + toe, 0.128f, 0.045f}});
}

void add_arm(TriangleMesh& mesh, float side, float swing) {
  const Vec3 shoulder(0.0f, 1.41f, 0.185f * side), elbow(0.45f * swing, 1.12f, 0.235f * side),
      wrist(swing, 0.875f, 0.225f * side), fingers(1.08f * swing, 0.76f, 0.215f * side);
  add_body(mesh, {{shoulder, 0.060f, 0.052f},
                  {glm::mix(shoulder, elbow, 0.5f), 0.054f, 0.048f},
                  {elbow, 0.044f, 0.040f},
                  {wrist, 0.032f, 0.028f},
                  {glm::mix(wrist, fingers, 0.45f), 0.040f, 0.026f},
                  {fingers, 0.018f, 0.014f}});
}

}  // namespace

TriangleMesh human_figure(float heading_deg) {
  TriangleMesh mesh;
  // A knee-free coat: shoulders, waist, hem.
  add_body(mesh, {{{0.00f, 0.80f, 0}, 0.125f, 0.175f},
                  {{0.00f, 0.95f, 0}, 0.122f, 0.178f},
                  {{0.00f, 1.10f, 0}, 0.100f, 0.148f},
                  {{0.01f, 1.27f, 0}, 0.116f, 0.172f},
                  {{0.00f, 1.40f, 0}, 0.098f, 0.200f},
                  {{0.00f, 1.45f, 0}, 0.070f, 0.130f},
                  {{0.01f, 1.48f, 0}, 0.052f, 0.060f},
                  {{0.02f, 1.55f, 0}, 0.050f, 0.052f}});
  // Head.
  const Vec3 head(0.03f, 1.635f, 0.0f);
  std::vector<BodyRing> rings;
  for (int k = 0; k <= 8; ++k) {
    const SinCos a = sin_cos(kPi * (0.04f + 0.92f * static_cast<float>(k) / 8.0f));
    rings.push_back({head - Vec3(0.0f, 0.116f * a.cos, 0.0f), 0.098f * a.sin, 0.078f * a.sin});
  }
  add_body(mesh, rings);
  add_leg(mesh, 1.0f, 0.27f, 0.05f, 0.0f), add_leg(mesh, -1.0f, -0.27f, 0.06f, 0.02f);
  add_arm(mesh, 1.0f, -0.20f), add_arm(mesh, -1.0f, 0.24f);

  float top = 0.0f;
  for (const Vec3& p : mesh.positions) top = std::max(top, p.y);
  const SinCos turn = sin_cos(radians(heading_deg - 90.0f));
  const auto turned = [&](const Vec3& v) {
    return Vec3(turn.cos * v.x - turn.sin * v.z, v.y, turn.sin * v.x + turn.cos * v.z);
  };
  for (Vec3& p : mesh.positions) p = turned(p) * (kFigureHeight / top);
  for (Vec3& n : mesh.normals) n = turned(n);
  mesh.uvs.assign(mesh.positions.size(), Vec2(0.0f));
  return mesh;
}

}  // namespace bosquet::geometry
