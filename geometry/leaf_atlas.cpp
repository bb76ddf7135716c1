#include "geometry/leaf_atlas.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "geometry/bloom_painter.h"
#include "geometry/texture_colour.h"
#include "geometry/twig_painter.h"

namespace bosquet::geometry {
namespace {

// A texel of the whole atlas and of its coarser copies.
struct Sum {
  Vec3 colour{0.0f};
  float alpha = 0.0f;
};

// Straight colours everywhere: where nothing was painted, those of the nearest coarser copy that has any.
std::vector<Vec3> spread_colours(const std::vector<Sum>& finest, int size, const Vec3& fallback) {
  std::vector<std::vector<Sum>> levels{finest};
  for (int n = size / 2; n >= 1; n /= 2) {
    const std::vector<Sum>& fine = levels.back();
    std::vector<Sum> coarse(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        Sum& sum = coarse[static_cast<std::size_t>(y * n + x)];
        for (int k = 0; k < 4; ++k) {
          const Sum& s = fine[static_cast<std::size_t>((2 * y + k / 2) * 2 * n + 2 * x + k % 2)];
          sum.colour += s.colour, sum.alpha += s.alpha;
        }
      }
    }
    levels.push_back(std::move(coarse));
  }
  std::vector<Vec3> colours{levels.back()[0].alpha > 0.0f ? levels.back()[0].colour / levels.back()[0].alpha
                                                          : fallback};
  int n = 1;
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    n *= 2;
    std::vector<Vec3> finer(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
    parallel_for(
        static_cast<std::size_t>(n),
        [&](std::size_t y) {
          for (std::size_t x = 0; x < static_cast<std::size_t>(n); ++x) {
            const std::size_t i = y * static_cast<std::size_t>(n) + x;
            const Sum& s = levels[l][i];
            finer[i] = s.alpha > 1.0f / 512.0f ? s.colour / s.alpha
                                               : colours[(y / 2) * static_cast<std::size_t>(n / 2) + x / 2];
          }
        },
        16);
    colours = std::move(finer);
  }
  return colours;
}

}  // namespace

float cluster_cell_m(const LeafLook& leaf) { return leaf.cluster_m; }

float leaf_cell_m(const LeafLook& leaf) {
  if (leaf.outline == LeafOutline::needle_spray) return 0.001f * 5.5f * leaf.length_mm;
  if (leaf.outline == LeafOutline::scale_cord) return 0.3f * leaf.cluster_m;
  const float tall = 1.06f * leaf.length_mm + leaf.petiole_mm, wide = 1.12f * leaf.width_mm;
  return 0.001f * std::max(tall, wide) / (1.0f - 2.0f * kAtlasMargin);
}

float bunch_cell_m(const Bloom& bloom) {
  constexpr float kRims = 2.5f * kAtlasMargin;
  return std::max(bunch_extent_m(bloom) / (1.0f - kRims - kBunchStem),
                  2.0f * bunch_half_width_m(bloom) / (1.0f - kRims));
}

LeafAtlas make_leaf_atlas(const LeafLook& leaf, Season season, std::uint64_t seed, int size) {
  assert(size >= 128 && size <= 4096 && (size & (size - 1)) == 0);
  const Bloom* bloom = bloom_of(leaf, season);
  const int half = size / 2;
  std::vector<AtlasCanvas> cells;
  for (int c = 0; c < 4; ++c) cells.emplace_back(1, 1.0f, seed);
  parallel_for(4, [&](std::size_t c) {
    const Bloom* here = c % 2 == 0 ? bloom : nullptr;
    const AtlasSubject subject = c < 2 ? AtlasSubject::twig : here ? AtlasSubject::bunch : AtlasSubject::leaf;
    const float side = subject == AtlasSubject::twig   ? cluster_cell_m(leaf)
                       : subject == AtlasSubject::leaf ? leaf_cell_m(leaf)
                                                       : bunch_cell_m(*here);
    cells[c] = paint_cell(leaf, season, here, subject, seed, static_cast<int>(c), half, side);
  });

  LeafAtlas out{Image(size, size, 4), Image(half, half, 3)};
  const auto n = static_cast<std::size_t>(size);
  std::vector<Sum> sums(n * n);
  const auto texel = [&](int x, int y) -> const AtlasCanvas::Texel& {
    return cells[static_cast<std::size_t>((y / half) * 2 + x / half)].at(x % half, y % half);
  };
  parallel_for(
      n,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < n; ++x) {
          const AtlasCanvas::Texel& t = texel(static_cast<int>(x), static_cast<int>(y));
          sums[y * n + x] = {t.colour, t.alpha};
        }
      },
      16);
  const std::vector<Vec3> colours = spread_colours(sums, size, twig_albedo(leaf));
  parallel_for(
      n,
      [&](std::size_t y) {
        for (std::size_t x = 0; x < n; ++x) {
          std::uint8_t* pixel = out.base_colour.at(static_cast<int>(x), static_cast<int>(y));
          put_srgb(pixel, colours[y * n + x]);
          pixel[3] = unit_byte(sums[y * n + x].alpha);
        }
      },
      16);
  parallel_for(
      n / 2,
      [&](std::size_t row) {
        for (int x = 0; x < half; ++x) {
          Vec2 lean{0.0f};
          float alpha = 0.0f;
          for (int k = 0; k < 4; ++k) {
            const AtlasCanvas::Texel& t = texel(2 * x + k % 2, 2 * static_cast<int>(row) + k / 2);
            lean += t.lean, alpha += t.alpha;
          }
          if (alpha > 0.0f) lean /= alpha;
          put_normal(out.normal.at(x, static_cast<int>(row)), glm::normalize(Vec3(lean, 1.0f)));
        }
      },
      16);
  return out;
}

}  // namespace bosquet::geometry
