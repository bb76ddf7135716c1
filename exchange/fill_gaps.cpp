#include "exchange/fill_gaps.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bosquet::exchange {
namespace {

constexpr int kSweeps = 200;
constexpr float kSettled = 1e-4f;        // metres in a sweep: finer than any survey
constexpr float kOverRelaxation = 1.7f;  // 1 is plain Gauss-Seidel; below 2 it converges

struct Grid {
  int columns, rows;
  std::vector<float> values;
  float& at(int c, int r) {
    return values[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  }
  float at(int c, int r) const { return const_cast<Grid*>(this)->at(c, r); }
};

// Half as many cells a side, each the mean of the numbers among its four.
Grid coarser(const Grid& fine) {
  Grid out{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
  out.values.resize(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows));
  for (int r = 0; r < out.rows; ++r)
    for (int c = 0; c < out.columns; ++c) {
      float sum = 0;
      int n = 0;
      for (int y = 2 * r; y < std::min(2 * r + 2, fine.rows); ++y)
        for (int x = 2 * c; x < std::min(2 * c + 2, fine.columns); ++x)
          if (const float v = fine.at(x, y); !std::isnan(v)) sum += v, ++n;
      out.at(c, r) = n > 0 ? sum / static_cast<float>(n) : std::numeric_limits<float>::quiet_NaN();
    }
  return out;
}

bool complete(const Grid& grid) {
  return std::none_of(grid.values.begin(), grid.values.end(), [](float v) { return std::isnan(v); });
}

// Gaps take the coarse grid's height, bilinear between its cell centres.
void fill_from(const Grid& coarse, Grid& fine) {
  const auto weigh = [](int i, int n, int& low, int& high, float& f) {
    const float x = std::clamp(0.5f * (static_cast<float>(i) - 0.5f), 0.0f, static_cast<float>(n - 1));
    low = std::min(static_cast<int>(x), n - 1), high = std::min(low + 1, n - 1), f = x - static_cast<float>(low);
  };
  for (int r = 0; r < fine.rows; ++r)
    for (int c = 0; c < fine.columns; ++c) {
      if (!std::isnan(fine.at(c, r))) continue;
      int c0, c1, r0, r1;
      float fx, fy;
      weigh(c, coarse.columns, c0, c1, fx), weigh(r, coarse.rows, r0, r1, fy);
      const float south = coarse.at(c0, r0) * (1 - fx) + coarse.at(c1, r0) * fx;
      const float north = coarse.at(c0, r1) * (1 - fx) + coarse.at(c1, r1) * fx;
      fine.at(c, r) = south * (1 - fy) + north * fy;
    }
}

}  // namespace

void fill_gaps(int columns, int rows, std::vector<float>& samples) {
  assert(samples.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<std::size_t> gaps;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (std::isnan(samples[i])) gaps.push_back(i);
  if (gaps.empty() || gaps.size() == samples.size()) return;

  // Push to the level that has no gaps, pull back.
  std::vector<Grid> levels{{columns, rows, std::move(samples)}};
  while (!complete(levels.back())) levels.push_back(coarser(levels.back()));
  for (std::size_t k = levels.size() - 1; k > 0; --k) fill_from(levels[k], levels[k - 1]);
  samples = std::move(levels.front().values);

  // Relax toward the mean of the neighbours that there are.
  const auto width = static_cast<std::size_t>(columns);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    float largest = 0;
    for (std::size_t i : gaps) {
      const std::size_t c = i % width, r = i / width;
      float sum = 0;
      int n = 0;
      if (c > 0) sum += samples[i - 1], ++n;
      if (c + 1 < width) sum += samples[i + 1], ++n;
      if (r > 0) sum += samples[i - width], ++n;
      if (r + 1 < static_cast<std::size_t>(rows)) sum += samples[i + width], ++n;
      if (n == 0) continue;
      const float step = kOverRelaxation * (sum / static_cast<float>(n) - samples[i]);
      samples[i] += step;
      largest = std::max(largest, std::abs(step));
    }
    if (largest < kSettled) break;
  }
}

}  // namespace bosquet::exchange
