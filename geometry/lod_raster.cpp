#include "geometry/lod_raster.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

// Finer is never looked at: a picture has a few dozen pixels.
constexpr int kFinestSkin = 256;

std::size_t index(int side, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

// Averages of 2 x 2 texels; colours weigh as much as they cover.
std::vector<RasterSkin::Texel> halved(const std::vector<RasterSkin::Texel>& from, int side) {
  std::vector<RasterSkin::Texel> out(static_cast<std::size_t>(side / 2) * static_cast<std::size_t>(side / 2));
  for (int y = 0; y < side / 2; ++y)
    for (int x = 0; x < side / 2; ++x) {
      Vec3 sum{0.0f}, plain{0.0f};
      float cover = 0.0f;
      for (int k = 0; k < 4; ++k) {
        const RasterSkin::Texel& t = from[index(side, 2 * x + (k & 1), 2 * y + (k >> 1))];
        sum += t.cover * t.colour, plain += 0.25f * t.colour, cover += t.cover;
      }
      out[index(side / 2, x, y)] = {cover > 0.0f ? sum / cover : plain, 0.25f * cover};
    }
  return out;
}

// Uniform in [0, 1) by sample and triangle.
float chance(std::uint32_t x, std::uint32_t y, std::uint64_t triangle) {
  const std::uint64_t bits = mix_bits(mix_bits(triangle + 0x9e3779b97f4a7c15ull) ^ (std::uint64_t{x} << 32 | y));
  return static_cast<float>(bits >> 40) * 0x1p-24f;
}

float wrapped(float x) { return x - std::floor(x); }

}  // namespace

RasterSkin::RasterSkin() : levels_(1, std::vector<Texel>(1)) {}

RasterSkin::RasterSkin(const Image& image, float cutoff) : RasterSkin() {
  if (image.empty()) return;
  // A power of two, by nearest texels where the image is none; then averages.
  int side = 1;
  while (2 * side <= std::min(std::max(image.width, image.height), 4 * kFinestSkin)) side *= 2;
  std::vector<Texel> texels(index(side, 0, side));
  const auto threshold = cutoff * 255.0f;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const std::uint8_t* p = image.at(x * image.width / side, y * image.height / side);
      const auto linear = [&](int c) { return linear_from_srgb(static_cast<float>(p[c]) / 255.0f); };
      Texel& t = texels[index(side, x, y)];
      t.colour = image.channels >= 3 ? Vec3(linear(0), linear(1), linear(2)) : Vec3(linear(0));
      t.cover = image.channels == 4 && static_cast<float>(p[3]) < threshold ? 0.0f : 1.0f;
    }
  while (side > kFinestSkin) texels = halved(texels, side), side /= 2;
  side_ = side;
  levels_.clear();
  levels_.push_back(std::move(texels));
  for (; side > 1; side /= 2) levels_.push_back(halved(levels_.back(), side));
}

RasterSkin::Texel RasterSkin::at(Vec2 uv, float texels) const {
  std::size_t level = 0;
  int side = side_;
  for (float span = texels; span >= 1.5f && level + 1 < levels_.size(); span *= 0.5f) ++level, side /= 2;
  const int x = std::min(static_cast<int>(wrapped(uv.x) * static_cast<float>(side)), side - 1);
  const int y = std::min(static_cast<int>(wrapped(uv.y) * static_cast<float>(side)), side - 1);
  return levels_[level][index(side, x, y)];
}

RasterView RasterView::level(float azimuth) {
  const SinCos a = sin_cos(azimuth);
  RasterView view;
  view.right = {a.cos, 0.0f, -a.sin};
  view.toward = {a.sin, 0.0f, a.cos};
  return view;
}

RasterView RasterView::from_above() {
  RasterView view;
  view.up = {0, 0, -1};
  view.toward = {0, 1, 0};
  return view;
}

void frame(RasterView& view, const Box3& box, float margin) {
  Box2 flat;
  for (unsigned k = 0; k < 8; ++k)
    flat.add(
        view.project({k & 1 ? box.high.x : box.low.x, k & 2 ? box.high.y : box.low.y, k & 4 ? box.high.z : box.low.z}));
  const Vec2 wider = glm::max(margin * flat.size(), Vec2(1e-3f));
  view.low = flat.low - wider, view.high = flat.high + wider;
}

RasterPicture::RasterPicture(int w, int h) : width(w), height(h) {
  const std::size_t n = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  colour.resize(n), depth.resize(n), drawn.resize(n);
}

void rasterize(std::span<const RasterSurface> surfaces, const RasterView& view, RasterPicture& picture) {
  const Vec2 per_metre = Vec2(picture.width, picture.height) / (view.high - view.low);
  const float area_per_metre2 = per_metre.x * per_metre.y;
  std::uint64_t number = 0;
  for (const RasterSurface& surface : surfaces) {
    const TriangleMesh& mesh = *surface.mesh;
    const bool mapped = !mesh.uvs.empty(), tinted = !mesh.colours.empty();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3, ++number) {
      const std::uint32_t c[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
      Vec2 p[3];
      float d[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3& at = mesh.positions[c[k]];
        const Vec2 flat = (view.project(at) - view.low) * per_metre;
        p[k] = {flat.x, static_cast<float>(picture.height) - flat.y};
        d[k] = glm::dot(at, view.toward);
      }
      // Twice the area; rows go down, so counter-clockwise comes out negative.
      const float twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
      if (twice == 0.0f || (surface.one_sided && twice > 0.0f)) continue;
      const Vec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
      const int x0 = std::max(0, static_cast<int>(std::floor(low.x))),
                x1 = std::min(picture.width - 1, static_cast<int>(std::floor(high.x)));
      const int y0 = std::max(0, static_cast<int>(std::floor(low.y))),
                y1 = std::min(picture.height - 1, static_cast<int>(std::floor(high.y)));
      if (x0 > x1 || y0 > y1) continue;

      // How many texels a sample spans, as if the triangle faced the viewer.
      float texels = 1.0f;
      if (mapped) {
        const Vec2 s = mesh.uvs[c[1]] - mesh.uvs[c[0]], t = mesh.uvs[c[2]] - mesh.uvs[c[0]];
        const Vec3 n =
            glm::cross(mesh.positions[c[1]] - mesh.positions[c[0]], mesh.positions[c[2]] - mesh.positions[c[0]]);
        const float across = std::sqrt(glm::dot(n, n)) * area_per_metre2;
        const auto side = static_cast<float>(surface.skin->side());
        if (across > 0.0f) texels = side * std::sqrt(std::abs(s.x * t.y - s.y * t.x) / across);
      }
      const float inverse = 1.0f / twice;
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
          const Vec2 q(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
          const float b1 = ((q.x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (q.y - p[0].y)) * inverse;
          const float b2 = ((p[1].x - p[0].x) * (q.y - p[0].y) - (q.x - p[0].x) * (p[1].y - p[0].y)) * inverse;
          const float b0 = 1.0f - b1 - b2;
          if (b0 < 0.0f || b1 < 0.0f || b2 < 0.0f) continue;
          const std::size_t at = index(picture.width, x, y);
          const float depth = b0 * d[0] + b1 * d[1] + b2 * d[2];
          if (picture.drawn[at] && picture.depth[at] >= depth) continue;
          RasterSkin::Texel texel;
          if (mapped) texel = surface.skin->at(b0 * mesh.uvs[c[0]] + b1 * mesh.uvs[c[1]] + b2 * mesh.uvs[c[2]], texels);
          if (texel.cover < 1.0f &&
              chance(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), number) >= texel.cover)
            continue;
          if (tinted) {
            const auto tint = [&](int k) { return Vec3(mesh.colours[c[k]]); };
            texel.colour *= (b0 * tint(0) + b1 * tint(1) + b2 * tint(2)) / 255.0f;
          }
          picture.drawn[at] = 1;
          picture.depth[at] = depth;
          picture.colour[at] = texel.colour;
        }
    }
  }
}

Appearance appearance(std::span<const RasterSurface> surfaces, RasterView view, const Box3& box, int side) {
  frame(view, box, 0.15f);
  RasterPicture picture(side, side);
  rasterize(surfaces, view, picture);
  Appearance out;
  float samples = 0.0f;
  for (std::size_t k = 0; k < picture.drawn.size(); ++k)
    if (picture.drawn[k]) out.colour += picture.colour[k], samples += 1.0f;
  const Vec2 size = view.high - view.low;
  if (samples > 0.0f) out.colour = out.colour / samples;
  out.area = samples * size.x * size.y / static_cast<float>(side * side);
  return out;
}

}  // namespace bosquet::geometry
