#include "geometry/grass_field.h"

#include <array>
#include <optional>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/grass_tuft.h"
#include "geometry/ground_colour.h"
#include "geometry/ground_covers.h"
#include "geometry/noise.h"

namespace bosquet::geometry {
namespace {

using terrain::Cover;

// Of each kind: tufts a square metre at density 1, and cells of a lattice along a tile that hold the densest field.
struct GrassKind {
  Cover cover;
  float per_m2;
  int cells;
  std::uint64_t key;
};
constexpr GrassKind kLawnSward{Cover::grass, 220.0f, 206, 1}, kMeadowSward{Cover::natural, kMeadowTuftsPerM2, 124, 2};

// Ground so much above the water bears its first and all of its grass.
constexpr float kFirstRise_m = 0.12f, kFullRise_m = 0.5f;
// Tufts stand so deep, in their heights, that no foot shows.
constexpr float kTuftSunk = 0.04f;
// Flowers and seed heads among meadow tufts, by Season.
constexpr std::array<float, 4> kFlowerShare{0.08f, 0.06f, 0.0f, 0.0f}, kSeedShare{0.03f, 0.16f, 0.24f, 0.05f};
// Heights of grass in its seasons.
constexpr std::array<float, 4> kMeadowHeight{0.65f, 1.0f, 0.9f, 0.42f}, kLawnHeight{1.0f, 1.0f, 1.0f, 0.8f};
constexpr float kGrassPatch_m = 3.5f;

// Even noise between random numbers on a lattice, 0..1.
float patch_noise(std::uint64_t seed, std::uint64_t key, Vec2 p) {
  const Vec2 cell = glm::floor(p);
  const Vec2 f = p - cell;
  const auto i = static_cast<std::int64_t>(cell.x), j = static_cast<std::int64_t>(cell.y);
  const auto at = [&](std::int64_t di, std::int64_t dj) {
    const auto x = static_cast<std::uint64_t>(i + di), y = static_cast<std::uint64_t>(j + dj);
    return RandomStream(seed, mix_bits(x * 0x9e3779b97f4a7c15ull + y) + key, Purpose::ground_cover).uniform();
  };
  const Vec2 s = f * f * (3.0f - 2.0f * f);
  return glm::mix(glm::mix(at(0, 0), at(1, 0), s.x), glm::mix(at(0, 1), at(1, 1), s.x), s.y);
}

class GrassTile {
 public:
  GrassTile(const terrain::Terrain& terrain, const GrassOptions& options, IVec2 tile, float rank)
      : terrain_(terrain), options_(options), tile_(tile), rank_(rank), size_(terrain.size_m()) {}

  void add(const GrassKind& sward, std::vector<Tuft>& out) const {
    const float cell = kGrassTileM / static_cast<float>(sward.cells);
    const float full =
        options_.density * sward.per_m2 * cell * cell;  // share of the cells that bear a tuft at full cover
    for (int j = 0; j < sward.cells; ++j)
      for (int i = 0; i < sward.cells; ++i) {
        const IVec2 at = tile_ * sward.cells + IVec2(i, j);
        RandomStream random(options_.seed,
                            mix_bits(static_cast<std::uint64_t>(static_cast<std::uint32_t>(at.x)) << 32 |
                                     static_cast<std::uint32_t>(at.y)) +
                                sward.key,
                            Purpose::ground_cover);
        const float number = random.uniform();
        if (number >= full * rank_) continue;
        const Vec2 plan = cell * (Vec2(at) + Vec2(random.uniform(), random.uniform()));
        if (plan.x < 0.0f || plan.y < 0.0f || plan.x > size_.x || plan.y > size_.y) continue;
        const float share = full * cover(sward, plan);
        if (number >= share * rank_ || (options_.taken && options_.taken(plan))) continue;
        out.push_back(tuft(sward, plan, number / share, random));
      }
  }

 private:
  /// 0 to 1: how much of the grass that could stand there does.
  float cover(const GrassKind& sward, Vec2 plan) const {
    const terrain::CoverShares shares = cover_shares(terrain_, plan);
    if (shares[static_cast<std::size_t>(sward.cover)] < 0.5f) return 0.0f;
    float share = 1.0f;
    if (options_.shade) {
      // Grass bears the shade of one tree; under several it grows thinner, and nothing under closed crowns.
      share = std::min(1.0f, 2.0f * (1.0f - std::clamp(options_.shade(plan), 0.0f, 1.0f)));
    }
    if (share <= 0.0f) return 0.0f;
    if (const std::optional<float> level = terrain_.water_level(plan))
      share *= smooth_step(kFirstRise_m, kFullRise_m, terrain_.ground(plan) - *level);
    return share <= 0.0f ? 0.0f : share * smooth_step(kBareGround, kSteepGround, terrain_.height.normal(plan).y);
  }

  Tuft tuft(const GrassKind& sward, Vec2 plan, float rank, RandomStream& random) const {
    const auto season = static_cast<std::size_t>(options_.season);
    Tuft t;
    t.lawn = sward.cover == Cover::grass;
    t.rank = rank;
    t.normal = terrain_.height.normal(plan);
    const SinCos turn = sin_cos(2.0f * kPi * random.uniform());
    t.turn = {turn.cos, turn.sin};
    const float kind = random.uniform();
    if (t.lawn) {
      t.shape = static_cast<std::uint8_t>(random.below(kLawnShapes));
      t.height_m = options_.lawn_height_m * kLawnHeight[season] * random.uniform(0.75f, 1.15f);
    } else {
      // Taller here and lower there, as soil and cattle have it.
      const float wide = patch_noise(options_.seed, 11, plan / kGrassPatch_m);
      t.height_m =
          options_.meadow_height_m * kMeadowHeight[season] * (0.45f + 0.6f * wide) * random.uniform(0.75f, 1.15f);
      // A kind of flower has its own places.
      const auto flower = random.below(kFlowerShapes);
      const float here = patch_noise(options_.seed, 21 + flower, plan / (0.7f * kGrassPatch_m) + 0.37f);
      int shape = kFirstMeadow + static_cast<int>(random.below(kMeadowShapes));
      if (kind < kFlowerShare[season] * smooth_step(0.45f, 0.8f, here) * 2.0f)
        shape = kFirstFlower + static_cast<int>(flower);
      else if (kind > 1.0f - kSeedShare[season])
        shape = kFirstSeed + static_cast<int>(random.below(kSeedShapes));
      t.shape = static_cast<std::uint8_t>(shape);
    }
    const float shade = options_.shade ? std::clamp(options_.shade(plan), 0.0f, 1.0f) : 0.0f;
    if (!t.lawn) t.height_m *= 1.0f - 0.5f * shade;
    const float y = options_.grid ? options_.grid->height_at(plan) : terrain_.ground(plan);
    t.at = to_world(plan, y - kTuftSunk * t.height_m);
    if (t.shape >= kFirstFlower) return t;
    const Vec3 albedo =
        ground_albedo(terrain_, sward.cover, {plan, terrain_.ground(plan), t.normal, shade}, options_.season);
    t.colour = glm::min(albedo * (kTuftTone * random.uniform(0.88f, 1.12f)), Vec3(1.0f));
    return t;
  }

  const terrain::Terrain& terrain_;
  const GrassOptions& options_;
  IVec2 tile_;
  float rank_;
  Vec2 size_;
};

}  // namespace

std::vector<Tuft> grass_in(const terrain::Terrain& terrain, const GrassOptions& options, IVec2 tile, float rank) {
  std::vector<Tuft> out;
  const GrassTile field(terrain, options, tile, std::min(rank, 1.0f));
  field.add(kLawnSward, out);
  field.add(kMeadowSward, out);
  return out;
}

}  // namespace bosquet::geometry
