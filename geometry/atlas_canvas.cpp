#include "geometry/atlas_canvas.h"

#include <algorithm>
#include <cmath>

#include "geometry/leaf_atlas.h"
#include "geometry/shares.h"

namespace bosquet::geometry {
namespace {

// Light from the upper left, as painters have it: what the albedo keeps of a surface's slope.
float painted_light(Vec2 slope) {
  const float facing = (0.45f * slope.x - 0.5f * slope.y) / std::sqrt(1.0f + slope.x * slope.x + slope.y * slope.y);
  return 1.0f + 0.32f * facing;
}

}  // namespace

AtlasCanvas::AtlasCanvas(int pixels, float side_m, std::uint64_t seed)
    : pixels_(pixels),
      side_(side_m),
      texels_(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(pixels)),
      blotches_(seed, 60, 5, 5, 3, 0.55f) {}

AtlasCanvas::Window AtlasCanvas::window(Box2 box) const {
  const float margin = kAtlasMargin * side_;
  box.low = glm::max(box.low, Vec2(-0.5f * side_ + margin, margin));
  box.high = glm::min(box.high, Vec2(0.5f * side_ - margin, side_ - margin));
  if (box.empty()) return {0, 0, 0, 0};
  const float scale = 1.0f / pixel();
  // Pixels whose centres lie in the box: ceil(edge - 1/2), as positive numbers.
  const auto up = [](float x) { return static_cast<int>(x + 0.5f); };
  return {up((box.low.x + 0.5f * side_) * scale), up((side_ - box.high.y) * scale),
          up((box.high.x + 0.5f * side_) * scale), up((side_ - box.low.y) * scale)};
}

void AtlasCanvas::over(int x, int y, const Vec3& colour, float alpha, Vec2 lean) {
  Texel& t = texels_[index(x, y)];
  const float under = 1.0f - alpha;
  t.colour = colour * alpha + t.colour * under;
  t.lean = lean * alpha + t.lean * under;
  t.alpha = alpha + t.alpha * under;
}

void AtlasCanvas::rod(Vec2 a, Vec2 b, float ra, float rb, const Vec3& colour_a, const Vec3& colour_b) {
  const float reach = std::max(ra, rb) + pixel();
  Box2 box;
  box.add(a), box.add(b);
  box.low -= Vec2(reach), box.high += Vec2(reach);
  const Vec2 along = b - a;
  const float length2 = std::max(glm::dot(along, along), 1e-12f);
  const Vec2 across = Vec2(along.y, -along.x) / std::sqrt(length2);
  const Window w = window(box);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const Vec2 from = centre(x, y) - a;
      const float t = clamp01(glm::dot(from, along) / length2);
      const Vec2 off = from - along * t;
      const float distance = std::sqrt(glm::dot(off, off)), radius = ra + (rb - ra) * t;
      // Thinner than a pixel: as wide as one, fainter.
      const float seen = std::max(radius, 0.5f * pixel());
      const float cover = clamp01(0.5f + (seen - distance) / pixel()) * std::min(1.0f, 1.4f * radius / seen);
      if (cover <= 0.0f) continue;
      const float turn = std::clamp(glm::dot(from, across) / seen, -0.85f, 0.85f);
      const Vec2 slope = across * (-turn * 0.9f);
      over(x, y, glm::mix(colour_a, colour_b, t) * (painted_light(slope) * (1.0f - 0.25f * turn * turn)), cover,
           -slope);
    }
  }
}

void AtlasCanvas::needle(Vec2 base, Vec2 tip, float width, const Vec3& colour, float shade) {
  const float half = 0.5f * width, reach = half + pixel();
  Box2 box;
  box.add(base), box.add(tip);
  box.low -= Vec2(reach), box.high += Vec2(reach);
  const Vec2 along = tip - base;
  const float length2 = std::max(glm::dot(along, along), 1e-12f), inverse = 1.0f / std::sqrt(length2);
  Vec2 across = Vec2(along.y, -along.x) * inverse;
  if (across.y < 0.0f) across = -across;  // toward the light from above
  const Window w = window(box);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const Vec2 from = centre(x, y) - base;
      const float t = clamp01(glm::dot(from, along) / length2);
      const Vec2 off = from - along * t;
      const float distance = std::sqrt(glm::dot(off, off));
      // Even over most of its length, then pointed.
      const float radius = half * std::min(1.0f, 3.5f * (1.0f - t) + 0.15f) * (0.7f + 0.3f * std::min(1.0f, 6.0f * t));
      const float seen = std::max(radius, 0.5f * pixel());
      const float cover = clamp01(0.5f + (seen - distance) / pixel()) * std::min(1.0f, radius / seen);
      if (cover <= 0.0f) continue;
      const float turn = std::clamp(glm::dot(from, across) / seen, -0.9f, 0.9f);
      over(x, y, colour * (shade * (1.0f + 0.28f * turn) * (0.85f + 0.2f * t)), cover, across * (0.7f * turn));
    }
  }
}

void AtlasCanvas::ball(Vec2 at, float radius, const Vec3& colour, float squash) {
  const float reach = radius + pixel();
  const Window w = window({at - Vec2(reach), at + Vec2(reach)});
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const Vec2 from = centre(x, y) - at, stretched{from.x, from.y / squash};
      const float distance = std::sqrt(glm::dot(stretched, stretched));
      const float cover = clamp01(0.5f + (radius - distance) / pixel());
      if (cover <= 0.0f) continue;
      const Vec2 n = stretched / std::max(radius, 0.5f * pixel()) * 0.85f;
      const float rim = std::min(1.0f, glm::dot(n, n));
      over(x, y, colour * ((1.0f - 0.30f * rim) * painted_light(-1.1f * n)), cover, 0.9f * n);
    }
  }
}

void AtlasCanvas::petal(Vec2 base, Vec2 tip, float width, const Vec3& colour, const Vec3& at_base) {
  const Vec2 along = tip - base;
  const float length2 = std::max(glm::dot(along, along), 1e-12f), length = std::sqrt(length2);
  const Vec2 across = Vec2(along.y, -along.x) / length;
  Box2 box;
  box.add(base), box.add(tip);
  box.low -= Vec2(0.5f * width + pixel()), box.high += Vec2(0.5f * width + pixel());
  const Window w = window(box);
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const Vec2 from = centre(x, y) - base;
      const float t = glm::dot(from, along) / length2, side = glm::dot(from, across);
      // Broad beyond the middle, notched a little at the end.
      const float s = clamp01(t),
                  half = 0.5f * width * std::sqrt(std::max(0.0f, 4.0f * s * (1.0f - s) * (0.55f + 0.45f * s)));
      const float distance = std::min(half - std::fabs(side), std::min(t, 1.0f - t) * length);
      const float cover = clamp01(0.5f + distance / pixel());
      if (cover <= 0.0f) continue;
      over(x, y, glm::mix(at_base, colour, smooth_step(0.0f, 0.45f, s)) * (0.90f + 0.12f * s), cover,
           across * (0.8f * side / std::max(width, pixel())));
    }
  }
}

void AtlasCanvas::blade(const LeafBlade& blade, const BladePose& pose) {
  const Vec2 along = pose.direction, across{along.y, -along.x};
  const float half = blade.half_width() * pose.length * pose.narrow, inverse = 1.0f / pose.length;
  const float bow = std::fabs(pose.bend) * pose.length + half, tail = blade.overhang() * pose.length;
  // The shadow falls to the lower right, a few percent of the leaf away.
  const Vec2 drop = Vec2(0.03f, -0.05f) * pose.length;
  const float soft = 0.05f;
  Box2 box;
  for (const float v : {-tail, pose.length}) {
    for (const float u : {-bow, bow}) box.add(pose.base + along * v + across * u);
  }
  Box2 shaded = box;
  shaded.add(Box2{box.low + drop, box.high + drop});
  shaded.low -= Vec2(soft * pose.length), shaded.high += Vec2(soft * pose.length);
  const auto local = [&](Vec2 p) {
    const Vec2 from = p - pose.base;
    const float v = glm::dot(from, along) * inverse;
    return Vec2((glm::dot(from, across) * inverse - pose.bend * v * v) / pose.narrow, v);
  };
  if (pose.shadow > 0.0f) {
    const Window w = window(shaded);
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        Texel& t = texels_[index(x, y)];
        if (t.alpha <= 0.0f) continue;
        const Vec2 uv = local(centre(x, y) - drop);
        t.colour *= 1.0f - pose.shadow * smooth_step(-soft, soft, blade.distance(uv.x, uv.y));
      }
    }
  }
  const float step = pixel() * inverse;
  const float squeeze = 0.5f * (1.0f + pose.narrow);
  const Vec2 blotch_at{pose.base.x * 31.0f, pose.base.y * 17.0f};
  const Window w = window({box.low - Vec2(pixel()), box.high + Vec2(pixel())});
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      const Vec2 uv = local(centre(x, y));
      const BladePoint p = blade.at(uv.x, uv.y, step);
      const float cover = clamp01(0.5f + p.distance * squeeze / step);
      if (cover <= 0.0f) continue;
      const float blotch = blotches_(0.35f * uv.x + blotch_at.x, 0.35f * uv.y + blotch_at.y);
      const float inner = smooth_step(0.0f, 0.55f * blade.half_width(), p.distance + 0.06f * blotch);
      Vec3 colour = glm::mix(pose.edge, pose.colour, inner) * (1.0f + pose.mottle * 2.0f * blotch);
      colour = glm::mix(colour, pose.vein, 0.75f * p.vein);
      const Vec2 relief = across * (p.slope.x / pose.narrow) + along * p.slope.y;
      const Vec2 slope = pose.tilt + relief;
      // Slope of a surface z(x, y) leans the normal the other way.
      over(x, y, colour * painted_light(slope), cover, -slope);
    }
  }
}

}  // namespace bosquet::geometry
