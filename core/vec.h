// Vectors, boxes and the one mapping between plan and world.
//
// Units     metres
// World     right-handed, x = east, y = up, z = -north (south), as glTF
// Plan      (east, north) from the site's south-west corner, as in files, recipes and on screen
// Tree      a tree's own frame has the world's axes and its origin at the tree's base
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace bosquet {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;
using IVec2 = glm::ivec2;
using IVec3 = glm::ivec3;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using Rgba8 = glm::u8vec4;

inline constexpr Vec3 kUp{0.0f, 1.0f, 0.0f};

/// The world point above plan position `plan` at `height` metres.
inline Vec3 to_world(Vec2 plan, float height) { return {plan.x, height, -plan.y}; }

/// The plan position (east, north) under a world point.
inline Vec2 to_plan(const Vec3& world) { return {world.x, -world.z}; }

/// Closed axis-aligned rectangle; empty (low > high) until something is added.
struct Box2 {
  Vec2 low{std::numeric_limits<float>::max()};
  Vec2 high{std::numeric_limits<float>::lowest()};

  bool empty() const { return low.x > high.x || low.y > high.y; }
  Vec2 size() const { return high - low; }
  Vec2 centre() const { return 0.5f * (low + high); }
  bool contains(Vec2 p) const { return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y; }
  void add(Vec2 p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box2& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
};

/// Closed axis-aligned box; empty (low > high) until something is added.
struct Box3 {
  Vec3 low{std::numeric_limits<float>::max()};
  Vec3 high{std::numeric_limits<float>::lowest()};

  bool empty() const { return low.x > high.x || low.y > high.y || low.z > high.z; }
  Vec3 size() const { return high - low; }
  Vec3 centre() const { return 0.5f * (low + high); }
  void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void add(const Box3& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
};

}  // namespace bosquet
