#include "geometry/impostor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/scalar.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

constexpr int kSamples = 4;       // of a texel's side
constexpr float kMargin = 0.04f;  // around the tree in its picture, so that mipmaps do not mix neighbours
constexpr int kSilhouette = 96;   // samples across, to measure silhouettes
constexpr int kDirections = 4;    // from which they are measured
constexpr float kFaint = 0.08f;   // texels covered less are noise of single samples

std::array<RasterView, 3> views(const Box3& box) {
  std::array<RasterView, 3> all{RasterView::level(0.0f), RasterView::level(0.5f * kPi), RasterView::from_above()};
  for (RasterView& view : all) frame(view, box, kMargin);
  return all;
}

// One cell: the tree at kSamples times the pixels, averaged; then alpha for the alpha test.
void paint_cell(std::span<const RasterSurface> tree, const RasterView& view, Image& atlas, int x0, int y0, int side) {
  RasterPicture picture(kSamples * side, kSamples * side);
  rasterize(tree, view, picture);
  struct Texel {
    Vec3 colour{0.0f};
    float cover = 0.0f;
  };
  std::vector<Texel> texels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  Vec3 all{0.0f};
  float covered = 0.0f;
  for (int y = 0; y < kSamples * side; ++y)
    for (int x = 0; x < kSamples * side; ++x) {
      const std::size_t from =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(kSamples * side) + static_cast<std::size_t>(x);
      if (!picture.drawn[from]) continue;
      Texel& t = texels[static_cast<std::size_t>(y / kSamples) * static_cast<std::size_t>(side) +
                        static_cast<std::size_t>(x / kSamples)];
      t.colour += picture.colour[from], t.cover += 1.0f / (kSamples * kSamples);
      all += picture.colour[from], covered += 1.0f;
    }
  const Vec3 mean = covered > 0.0f ? all / covered : Vec3(0.2f);

  // The share of texels that pass the test shall be the covered share: the cover of the texel at that place in order
  // becomes the cutoff.
  std::vector<float> sorted;
  for (const Texel& t : texels)
    if (t.cover > kFaint) sorted.push_back(t.cover);
  const auto wanted = static_cast<std::size_t>(covered / (kSamples * kSamples) + 0.5f);
  float threshold = 0.5f;
  if (!sorted.empty()) {
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    threshold = std::clamp(sorted[std::min(wanted, sorted.size()) - (wanted > 0)], kFaint, 0.9f);
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const Texel& t =
          texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)];
      const float n = t.cover * kSamples * kSamples;
      // Few samples say little of a colour: they lean on the mean.
      const Vec3 colour = (t.colour + mean) / (n + 1.0f);
      const float alpha = t.cover >= threshold
                              ? kImpostorCutoff + (1.0f - kImpostorCutoff) * (t.cover - threshold) / (1.0f - threshold)
                              : (kImpostorCutoff - 0.02f) * t.cover / threshold;
      std::uint8_t* pixel = atlas.at(x0 + x, y0 + y);
      put_srgb(pixel, colour);
      pixel[3] = unit_byte(alpha);
    }
}

// Mean silhouette over directions between and along the cards.
float silhouette(std::span<const RasterSurface> surfaces, const Box3& box) {
  float area = 0.0f;
  for (int k = 0; k < kDirections; ++k) {
    const float azimuth = 0.5f * kPi * (static_cast<float>(k) + 0.5f) / static_cast<float>(kDirections);
    area += appearance(surfaces, RasterView::level(azimuth), box, kSilhouette).area;
  }
  return area / static_cast<float>(kDirections);
}

struct Card {
  Vec3 corner[4];  ///< lower left, lower right, upper left, upper right
  Vec3 normal[4];
  float u0, v0, u1, v1;
};

void add(TriangleMesh& mesh, const Card& card) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (int k = 0; k < 4; ++k) {
    mesh.positions.push_back(card.corner[k]);
    mesh.normals.push_back(glm::normalize(card.normal[k]));
    mesh.uvs.push_back({k & 1 ? card.u1 : card.u0, k & 2 ? card.v0 : card.v1});
  }
  for (std::uint32_t k : {0u, 1u, 3u, 0u, 3u, 2u}) mesh.indices.push_back(base + k);
}

}  // namespace

TriangleMesh impostor_cards(const ImpostorFrame& frame_of, const ImpostorBlock& block, int atlas_width,
                            int atlas_height, std::size_t triangles, Vec2 stretch) {
  assert(triangles == kTwoCardTriangles || triangles == kFourCardTriangles);
  const auto seen = views(frame_of.box);
  const bool both_sides = triangles == kFourCardTriangles;
  TriangleMesh mesh;
  const auto cell = [&](int number, Card& card, bool mirrored) {
    const int half = block.side / 2, x = block.x + (number & 1) * half, y = block.y + (number >> 1) * half;
    card.u0 = static_cast<float>(x) / static_cast<float>(atlas_width);
    card.u1 = static_cast<float>(x + half) / static_cast<float>(atlas_width);
    card.v0 = static_cast<float>(y) / static_cast<float>(atlas_height);
    card.v1 = static_cast<float>(y + half) / static_cast<float>(atlas_height);
    if (mirrored) std::swap(card.u0, card.u1);
  };
  const Vec3 stretched(stretch.x, stretch.y, stretch.x);
  for (int number = 0; number < 2; ++number) {
    const RasterView& view = seen[static_cast<std::size_t>(number)];
    for (int side = 0; side < (both_sides ? 2 : 1); ++side) {
      Card card;
      cell(number, card, side == 1);
      const Vec3 facing = side == 0 ? view.toward : -view.toward;
      for (int k = 0; k < 4; ++k) {
        // The second side runs the other way, so that its front looks the other way too.
        const bool right = ((k & 1) != 0) != (side == 1), top = (k & 2) != 0;
        const float middle = 0.5f * (view.low.x + view.high.x);
        const float along = middle + frame_of.widen * ((right ? view.high.x : view.low.x) - middle);
        const float up = top ? view.high.y : view.low.y;
        card.corner[k] = stretched * (along * view.right + up * view.up);
        card.normal[k] =
            both_sides ? facing + (right ? 0.7f : -0.7f) * view.right + (top ? 0.8f : 0.25f) * kUp : facing;
      }
      add(mesh, card);
    }
  }
  if (both_sides) {
    const RasterView& view = seen[2];
    Card card;
    cell(2, card, false);
    for (int k = 0; k < 4; ++k) {
      const float along = k & 1 ? view.high.x : view.low.x, up = k & 2 ? view.high.y : view.low.y;
      card.corner[k] = stretched * (along * view.right + up * view.up + frame_of.level_y * kUp);
      const Vec3 out = (k & 1 ? 1.0f : -1.0f) * view.right + (k & 2 ? 1.0f : -1.0f) * view.up;
      card.normal[k] = kUp + 0.35f * out;
    }
    add(mesh, card);
  }
  assert(mesh.triangles() == triangles);
  return mesh;
}

ImpostorFrame paint_impostor(std::span<const RasterSurface> tree, Image& atlas, const ImpostorBlock& block) {
  ImpostorFrame out;
  for (const RasterSurface& surface : tree)
    if (!surface.mesh->empty()) out.box.add(surface.mesh->bounds());
  if (out.box.empty()) out.box.add(Vec3(0.0f)), out.box.add(Vec3(0.1f, 0.1f, 0.1f));
  out.box.low.y = std::max(out.box.low.y, -0.1f);  // what the ground hides needs no picture

  const auto seen = views(out.box);
  const int half = block.side / 2;
  for (int number = 0; number < 3; ++number)
    paint_cell(tree, seen[static_cast<std::size_t>(number)], atlas, block.x + (number & 1) * half,
               block.y + (number >> 1) * half, half);
  for (int y = 0; y < half; ++y)
    for (int x = 0; x < half; ++x) std::fill_n(atlas.at(block.x + half + x, block.y + half + y), 4, std::uint8_t{0});

  // The level card lies a little below the middle of the crown, where most are widest.
  const RasterSurface& crown = tree.back();
  Box3 leaves = crown.mesh->empty() ? out.box : crown.mesh->bounds();
  out.level_y = leaves.low.y + 0.45f * (leaves.high.y - leaves.low.y);

  // As wide as keeps the silhouette.
  const RasterSkin skin(
      [&] {
        Image own(block.side, block.side, 4);
        for (int y = 0; y < block.side; ++y) std::copy_n(atlas.at(block.x, block.y + y), 4 * block.side, own.at(0, y));
        return own;
      }(),
      kImpostorCutoff);
  const float wanted = silhouette(tree, out.box);
  Box3 wide = out.box;
  wide.low -= 0.2f * Vec3(out.box.size().x, 0.0f, out.box.size().z);
  wide.high += 0.2f * Vec3(out.box.size().x, 0.0f, out.box.size().z);
  for (int step = 0; step < 2; ++step) {
    const TriangleMesh cards = impostor_cards(out, {0, 0, block.side}, block.side, block.side, kTwoCardTriangles);
    const RasterSurface surface[] = {{&cards, &skin}};
    const float got = silhouette(surface, wide);
    if (got > 0.0f) out.widen = std::clamp(out.widen * wanted / got, 0.8f, 1.3f);
  }
  return out;
}

}  // namespace bosquet::geometry
