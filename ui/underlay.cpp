#include "ui/underlay.h"

#include <algorithm>
#include <array>
#include <vector>

#include "exchange/image_file.h"

namespace bosquet::ui {
namespace {

constexpr int kMostPixels = 2048;
constexpr std::array<float, 3> kMeadow{104, 116, 62};  ///< sRGB
constexpr float kPaper = 0.8f;                         ///< white paper in the sun must not blind

struct Corner {
  Vec3 at, normal;
};

Corner between(const Corner& a, const Corner& b, float t) {
  return {glm::mix(a.at, b.at, t), glm::mix(a.normal, b.normal, t)};
}

// Keeps the part of a polygon where `side` is not below 0 (Sutherland and Hodgman 1974).
template <class Side>
std::vector<Corner> cut(const std::vector<Corner>& ring, Side side) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const float sa = side(a.at), sb = side(b.at);
    if (sa >= 0) kept.push_back(a);
    if ((sa >= 0) != (sb >= 0)) kept.push_back(between(a, b, sa / (sa - sb)));
  }
  return kept;
}

// The mean of blocks of pixels, so that no side is longer than the limit; three channels.
Image smaller(const Image& image) {
  const int step = (std::max(image.width, image.height) + kMostPixels - 1) / kMostPixels;
  Image out(std::max(1, image.width / step), std::max(1, image.height / step), 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      std::array<int, 3> sum{};
      for (int v = 0; v < step; ++v)
        for (int u = 0; u < step; ++u) {
          const std::uint8_t* p = image.at(x * step + u, y * step + v);
          // What is clear shows as paper.
          const int alpha = image.channels == 4 ? p[3] : 255;
          for (std::size_t c = 0; c < 3; ++c) {
            const int colour = image.channels == 1 ? p[0] : p[c];
            sum[c] += (colour * alpha + 255 * (255 - alpha)) / 255;
          }
        }
      for (std::size_t c = 0; c < 3; ++c) out.at(x, y)[c] = static_cast<std::uint8_t>(sum[c] / (step * step));
    }
  return out;
}

void fade(Image& image, float opacity) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& p = image.at(x, y)[c];
        p = static_cast<std::uint8_t>(opacity * kPaper * static_cast<float>(p) + (1.0f - opacity) * kMeadow[c] + 0.5f);
      }
}

}  // namespace

TriangleMesh drape(std::span<const std::shared_ptr<const TriangleMesh>> ground, const PlanRectangle& rectangle,
                   float lift_m) {
  TriangleMesh out;
  const Vec2 low = rectangle.low, high = rectangle.high, size = high - low;
  if (!(size.x > 0 && size.y > 0)) return out;
  for (const auto& chunk : ground) {
    for (std::size_t i = 0; i + 2 < chunk->indices.size(); i += 3) {
      std::vector<Corner> ring;
      Box2 box;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = chunk->indices[i + k];
        ring.push_back({chunk->positions[v], v < chunk->normals.size() ? chunk->normals[v] : kUp});
        box.add(to_plan(chunk->positions[v]));
      }
      if (box.high.x <= low.x || box.low.x >= high.x || box.high.y <= low.y || box.low.y >= high.y) continue;
      const bool whole = box.low.x >= low.x && box.high.x <= high.x && box.low.y >= low.y && box.high.y <= high.y;
      if (!whole) {
        ring = cut(ring, [&](const Vec3& p) { return p.x - low.x; });
        ring = cut(ring, [&](const Vec3& p) { return high.x - p.x; });
        ring = cut(ring, [&](const Vec3& p) { return -p.z - low.y; });
        ring = cut(ring, [&](const Vec3& p) { return high.y + p.z; });
      }
      const auto first = static_cast<std::uint32_t>(out.positions.size());
      for (const Corner& c : ring) {
        out.positions.push_back(c.at + lift_m * kUp);
        out.normals.push_back(glm::normalize(c.normal));
        const Vec2 plan = to_plan(c.at);
        out.uvs.push_back({(plan.x - low.x) / size.x, (high.y - plan.y) / size.y});
      }
      for (std::uint32_t k = 2; k < ring.size(); ++k)
        out.indices.insert(out.indices.end(), {first, first + k - 1, first + k});
    }
  }
  return out;
}

Result<UnderlayPicture> read_underlay(const scene::Underlay& underlay) {
  auto image = exchange::read_image(underlay.file);
  if (!image) return image.error();
  UnderlayPicture picture;
  picture.height_per_width = static_cast<float>(image->height) / static_cast<float>(image->width);
  Image shown = smaller(*image);
  fade(shown, underlay.opacity);
  scene::Material material;
  material.name = "underlay";
  material.surface = scene::Surface::obstacle;
  material.base_colour = std::make_shared<const Image>(std::move(shown));
  picture.material = render::make_levels({std::move(material)});
  return picture;
}

scene::Underlay scaled_to(const scene::Underlay& underlay, Vec2 a, Vec2 b, double true_m) {
  const double length = glm::length(DVec2(b) - DVec2(a));
  if (!(length > 0.0) || !(true_m > 0.0)) return underlay;
  const double by = true_m / length;
  scene::Underlay scaled = underlay;
  scaled.width_m = static_cast<float>(by * static_cast<double>(underlay.width_m));
  scaled.south_west = DVec2(a) + by * (underlay.south_west - DVec2(a));
  return scaled;
}

PlanRectangle rectangle_of(const scene::Underlay& underlay, float height_per_width) {
  const Vec2 low(underlay.south_west);
  return {low, low + Vec2(underlay.width_m, underlay.width_m * height_per_width)};
}

}  // namespace bosquet::ui
