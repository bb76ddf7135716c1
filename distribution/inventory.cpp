#include "distribution/inventory.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/random.h"
#include "core/scalar.h"

namespace bosquet::distribution {
namespace {

constexpr float kGoldenTurn = 2.39996323f;  // radians; tries beside each other never repeat a direction
constexpr int kTries = 64;
constexpr float kLeastShift_m = 0.05f;

// Trees by square of side kSamePlace_m.
class Places {
 public:
  explicit Places(std::span<const StandingTree> trees) : trees_(trees) { buckets_.reserve(trees.size()); }
  void add(std::size_t n) { buckets_.emplace(id(square(trees_[n].at)), n); }

  /// The earliest tree nearer than kSamePlace_m, or trees.size().
  std::size_t at(Vec2 place) const {
    std::size_t earliest = trees_.size();
    const auto [x, y] = square(place);
    for (std::int64_t j = y - 1; j <= y + 1; ++j)
      for (std::int64_t i = x - 1; i <= x + 1; ++i) {
        const auto [begin, end] = buckets_.equal_range(id({i, j}));
        for (auto it = begin; it != end; ++it) {
          const Vec2 d = trees_[it->second].at - place;
          if (d.x * d.x + d.y * d.y < kSamePlace_m * kSamePlace_m) earliest = std::min(earliest, it->second);
        }
      }
    return earliest;
  }

 private:
  struct Square {
    std::int64_t x, y;
  };
  static Square square(Vec2 p) {
    return {static_cast<std::int64_t>(std::floor(p.x / kSamePlace_m)),
            static_cast<std::int64_t>(std::floor(p.y / kSamePlace_m))};
  }
  static std::uint64_t id(Square s) {
    return (static_cast<std::uint64_t>(s.x) << 32) ^ (static_cast<std::uint64_t>(s.y) & 0xffffffffu);
  }
  std::span<const StandingTree> trees_;
  std::unordered_multimap<std::uint64_t, std::size_t> buckets_;
};

}  // namespace

std::vector<MovedApart> move_duplicates_apart(std::span<StandingTree> trees, Vec2 size_m) {
  const Box2 site{Vec2{0.0f}, size_m};
  std::vector<MovedApart> moved;
  Places places(trees);
  for (std::size_t n = 0; n < trees.size(); ++n) {
    StandingTree& tree = trees[n];
    const std::size_t twin = places.at(tree.at);
    if (twin < trees.size()) {
      const StandingTree& other = trees[twin];
      const float shift = std::max(tree.trunk_radius_m + other.trunk_radius_m, kLeastShift_m);
      const std::uint64_t both = mix_bits(mix_bits(other.key) + tree.key);
      float turn = 2.0f * kPi * static_cast<float>(both >> 40) * 0x1p-24f;
      Vec2 to = tree.at;
      for (int n_try = 0; n_try < kTries; ++n_try, turn += kGoldenTurn) {
        const SinCos direction = sin_cos(turn);
        to = tree.at + shift * Vec2{direction.cos, direction.sin};
        if (site.contains(to) && places.at(to) == trees.size()) break;
      }
      moved.push_back({n, twin, tree.at, to});
      tree.at = to;
    }
    places.add(n);
  }
  return moved;
}

}  // namespace bosquet::distribution
