#include "geometry/leaf_cards.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace bosquet::geometry {

Crown::Crown(const growth::Skeleton& s, std::span<const LeafSite> sites) {
  DVec3 sum{0.0}, squares{0.0};
  for (const LeafSite& site : sites) {
    const DVec3 p{s.distal[site.internode]};
    sum += p, squares += p * p;
  }
  const double n = std::max<double>(1.0, static_cast<double>(sites.size()));
  const DVec3 mean = sum / n, variance = squares / n - mean * mean;
  centre_ = Vec3(mean);
  const auto level = static_cast<float>(variance.x + variance.z), upright = static_cast<float>(variance.y);
  centre_.y -= 0.4f * std::sqrt(std::max(0.0f, upright));
  curvature_ = {1.0f / (0.5f * level + 0.05f), 1.0f / (upright + 0.05f), 1.0f / (0.5f * level + 0.05f)};
}

CardWriter::CardWriter(const Crown& crown, float soft, std::size_t triangles, std::size_t vertices, bool windy)
    : crown_(crown), soft_(soft), windy_(windy) {
  mesh_.positions.resize(vertices), mesh_.normals.resize(vertices), mesh_.uvs.resize(vertices);
  mesh_.colours.resize(vertices), mesh_.indices.resize(3 * triangles);
  if (windy) mesh_.wind.resize(vertices);
}

inline void CardWriter::corner(const Vec3& position, const Vec3& normal, float u, float v, Rgba8 colour) {
  mesh_.positions[vertex_] = position, mesh_.normals[vertex_] = normal;
  mesh_.uvs[vertex_] = {u, v}, mesh_.colours[vertex_] = colour;
  ++vertex_;
}

inline void CardWriter::strip(std::uint32_t first, std::uint32_t row, bool front) {
  for (std::uint32_t k = 0; k + 1 < row; ++k) {
    const std::uint32_t a = first + k, b = a + 1, c = a + row, d = c + 1;
    std::uint32_t* to = mesh_.indices.data() + index_;
    to[0] = to[3] = a, to[1] = front ? b : d, to[2] = front ? d : b, to[4] = front ? d : c, to[5] = front ? c : d;
    index_ += 6;
  }
}

/// Of two rows of vertices, at the foot and at the far end.
void CardWriter::weigh(std::uint32_t first, std::uint32_t row, bool flutters) {
  std::fill_n(mesh_.wind.begin() + first, 2 * row, wind_);
  if (!flutters) return;
  for (std::uint32_t k = first + row; k < first + 2 * row; ++k) mesh_.wind[k].z = 255;
}

namespace {

/// How much of a card's normals is the crown's, by the cosine of the angle between the two.
template <class Real>
Real softness(Real cosine, float soft) {
  return soft * cosine * cosine * (3.0f - 2.0f * cosine);
}

}  // namespace

CardWriter::Spread CardWriter::spread(const LeafCard& c) const {
  const Vec3 to_top = c.length * c.heading;
  const float facing = glm::dot(c.up, crown_.outward(c.foot + 0.5f * to_top));
  return {to_top, c.half_width * c.left, c.half_width * c.right, facing >= 0.0f,
          softness(std::min(1.0f, std::abs(facing) / 0.7f), soft_)};
}

void CardWriter::add_flat(const LeafCard& c) {
  const auto first = static_cast<std::uint32_t>(vertex_);
  const auto [to_top, l, r, front, soft] = spread(c);
  const auto put = [&](const Vec3& p, float u, float v) {
    corner(p, unit(glm::mix(front ? c.up : -c.up, crown_.outward(p), soft), kUp), u, v, c.colour);
  };
  put(c.foot + l, c.uv.u0, c.uv.v1), put(c.foot + r, c.uv.u1, c.uv.v1);
  put(c.foot + l + to_top, c.uv.u0, c.uv.v0), put(c.foot + r + to_top, c.uv.u1, c.uv.v0);
  strip(first, 2, front);
  if (windy_) weigh(first, 2, true);
}

void CardWriter::add_folded(const LeafCard& c) {
  const auto first = static_cast<std::uint32_t>(vertex_);
  const auto [to_top, l, r, front, soft] = spread(c);
  const Vec3 flat = front ? c.up : -c.up, across = unit(c.right - c.left, c.left);
  const auto put = [&](const Vec3& p, float u, float v, float side) {
    // Halves look a little to their own side.
    const Vec3 face = unit(flat + 0.35f * side * across, c.up);
    corner(p, unit(glm::mix(face, crown_.outward(p), soft), kUp), u, v, c.colour);
  };
  const float middle = 0.5f * (c.uv.u0 + c.uv.u1);
  put(c.foot + l, c.uv.u0, c.uv.v1, -1), put(c.foot, middle, c.uv.v1, 0), put(c.foot + r, c.uv.u1, c.uv.v1, 1);
  put(c.foot + l + to_top, c.uv.u0, c.uv.v0, -1), put(c.foot + to_top, middle, c.uv.v0, 0);
  put(c.foot + r + to_top, c.uv.u1, c.uv.v0, 1);
  strip(first, 3, front);
  if (windy_) weigh(first, 3, true);
}

void CardWriter::add(const SmallCards& c, const Vec3& out) {
  const Float4 none = all4(0.0f);
  const Vec3x4 outward = all4(out), to_top = c.length * c.heading, half = c.half_width * c.left;
  const Float4 facing = dot(c.up, outward);
  const Int4 front = facing >= none;
  const Float4 soft = softness(min(all4(1.0f), select(front, facing, -facing) / 0.7f), soft_);
  const Vec3x4 normal = unit(mix(select(front, c.up, -c.up), outward, soft), all4(kUp));
  const Vec3x4 left = c.foot + half, right = c.foot - half;
  const Vec3x4 left_top = left + to_top, right_top = right + to_top;
  const auto begin = static_cast<std::uint32_t>(vertex_);
  for (int k = 0; k < c.count; ++k) {
    const auto first = static_cast<std::uint32_t>(vertex_);
    const AtlasCell& uv = c.uv[k];
    const Vec3 n = normal.lane(k);
    corner(left.lane(k), n, uv.u0, uv.v1, c.colour[k]), corner(right.lane(k), n, uv.u1, uv.v1, c.colour[k]);
    corner(left_top.lane(k), n, uv.u0, uv.v0, c.colour[k]), corner(right_top.lane(k), n, uv.u1, uv.v0, c.colour[k]);
    strip(first, 2, front[k] != 0);
  }
  if (!windy_) return;
  for (int k = 0; k < c.count; ++k) weigh(begin + 4 * static_cast<std::uint32_t>(k), 2, !c.still[k]);
}

TriangleMesh CardWriter::take() {
  assert(vertex_ == mesh_.positions.size() && index_ == mesh_.indices.size());
  return std::move(mesh_);
}

}  // namespace bosquet::geometry
