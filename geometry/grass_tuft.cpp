#include "geometry/grass_tuft.h"

#include <array>
#include <cassert>
#include <optional>
#include <utility>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

// The picture's columns.
enum TuftColumn { kBlade, kDryBlade, kSeedHead, kStalk, kDaisy, kButtercup, kScabious };
constexpr int kColumnCount = 8, kColumnPixels = 8, kPictureRows = 32;

// What the blades of a kind are like, in heights of the tuft.
struct TuftHabit {
  int blades;
  float least, width, spread, bend;
};
constexpr TuftHabit kMown{9, 0.50f, 0.075f, 0.80f, 0.60f}, kTall{10, 0.40f, 0.021f, 0.24f, 0.50f},
    kWithHeads{6, 0.40f, 0.020f, 0.20f, 0.45f}, kWithFlowers{3, 0.30f, 0.018f, 0.12f, 0.40f};
constexpr int kHeads = 3;
constexpr int kPetals = 5;

class TuftBuilder {
 public:
  explicit TuftBuilder(int shape) : random_(0, static_cast<std::uint64_t>(shape), Purpose::ground_cover) {}

  /// `of`: the column of all blades; usually some are dry.
  void blades(const TuftHabit& habit, std::optional<TuftColumn> of = {}) {
    for (int b = 0; b < habit.blades; ++b) {
      // One after the other around the foot, each leaning outward, more or less.
      const float around =
          2.0f * kPi * (static_cast<float>(b) + random_.uniform(-0.3f, 0.3f)) / static_cast<float>(habit.blades);
      const float aside = around + random_.uniform(-0.8f, 0.8f);
      const float height = random_.uniform(habit.least, 1.0f);
      const TuftColumn usual = random_.uniform() < 0.14f ? kDryBlade : kBlade, column = of.value_or(usual);
      strip(direction(around) * (habit.spread * random_.uniform(0.2f, 1.0f)), height,
            direction(aside) * (habit.bend * height * random_.uniform(0.35f, 1.0f)),
            habit.width * random_.uniform(0.7f, 1.2f), 0.62f, column);
    }
  }
  /// Where a stalk ends.
  Vec3 stalk(float spread, float height, TuftColumn column) {
    const Vec3 out = direction(random_.uniform(0.0f, 2.0f * kPi));
    strip(out * (spread * random_.uniform()), height, out * (0.14f * height * random_.uniform(0.2f, 1.0f)), 0.009f,
          0.75f, column);
    return mesh_.positions.back();
  }
  void seed_head(const Vec3& at) {
    const Vec3 along = glm::normalize(Vec3(0.25f * random_.uniform(), 1.0f, 0.25f * random_.uniform()));
    const float length = random_.uniform(0.12f, 0.2f), half = 0.15f * length;
    const Vec3 side = half * direction(random_.uniform(0.0f, 2.0f * kPi));
    const std::uint32_t a = vertex(at - 0.35f * length * along, kSeedHead, 0.0f),
                        b = vertex(at + 0.1f * length * along + side, kSeedHead, 0.5f),
                        c = vertex(at + 0.1f * length * along - side, kSeedHead, 0.5f),
                        d = vertex(at + 0.65f * length * along, kSeedHead, 1.0f);
    triangle(a, b, c), triangle(c, b, d);
  }
  /// A disc a little turned away from the upright.
  void flower(const Vec3& at, float radius, TuftColumn column) {
    const Vec3 tilt = 0.5f * direction(random_.uniform(0.0f, 2.0f * kPi)), up = glm::normalize(kUp + tilt);
    const Vec3 x = glm::normalize(glm::cross(up, Vec3(0.3f, 0.1f, 1.0f))), z = glm::cross(up, x);
    const std::uint32_t centre = vertex(at, column, 0.0f);
    for (int k = 0; k < kPetals; ++k) {
      const SinCos a = sin_cos(2.0f * kPi * static_cast<float>(k) / static_cast<float>(kPetals));
      vertex(at + radius * (a.cos * x + a.sin * z + 0.12f * up), column, 1.0f);
    }
    for (std::uint32_t k = 0; k < kPetals; ++k) triangle(centre, centre + 1 + k, centre + 1 + (k + 1) % kPetals);
  }
  float uniform(float low, float high) { return random_.uniform(low, high); }

  /// The first triangle gets the first and the last vertex.
  TriangleMesh finished() && {
    mesh_.normals.assign(mesh_.positions.size(), kUp);
    const auto last = static_cast<std::uint32_t>(mesh_.positions.size()) - 1;
    exchange(mesh_.indices[0], 0);
    exchange(mesh_.indices[1], last);
    assert(mesh_.positions.size() <= kTuftVertices);
    return std::move(mesh_);
  }

 private:
  static Vec3 direction(float angle) {
    const SinCos a = sin_cos(angle);
    return {a.cos, 0.0f, a.sin};
  }
  std::uint32_t vertex(const Vec3& at, TuftColumn column, float height) {
    mesh_.positions.push_back(at);
    mesh_.uvs.emplace_back((static_cast<float>(column) + 0.5f) / float{kColumnCount},
                           1.0f - (0.5f + height * (kPictureRows - 1)) / kPictureRows);
    return static_cast<std::uint32_t>(mesh_.positions.size()) - 1;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }
  // Rises to `share` of its height before it bends over to where it leans.
  void strip(const Vec3& foot, float height, const Vec3& lean, float width, float share, TuftColumn column) {
    const float reach = glm::length(lean);
    const Vec3 across = reach > 0.0f ? glm::cross(lean / reach, kUp) : Vec3(1.0f, 0.0f, 0.0f);
    const Vec3 half = 0.5f * width * across, bend = foot + share * height * kUp + 0.35f * lean;
    const std::uint32_t a = vertex(foot - half, column, 0.0f), b = vertex(foot + half, column, 0.0f),
                        c = vertex(bend - 0.85f * half, column, share), d = vertex(bend + 0.85f * half, column, share),
                        e = vertex(foot + height * kUp + lean, column, 1.0f);
    triangle(a, b, c), triangle(c, b, d), triangle(c, d, e);
  }
  void exchange(std::uint32_t a, std::uint32_t b) {
    std::swap(mesh_.positions[a], mesh_.positions[b]);
    std::swap(mesh_.uvs[a], mesh_.uvs[b]);
    for (std::uint32_t& index : mesh_.indices) index = index == a ? b : index == b ? a : index;
  }

  TriangleMesh mesh_;
  RandomStream random_;
};

// Shares of the ground's colour at the foot, in the shade of its neighbours, and at the tip.
struct Shades {
  Vec3 foot, tip;
};
constexpr std::array<Shades, 4> kBladeShades{{{Vec3(0.48f, 0.50f, 0.46f), Vec3(1.60f, 1.68f, 1.30f)},
                                              {Vec3(0.48f, 0.50f, 0.46f), Vec3(1.60f, 1.62f, 1.35f)},
                                              {Vec3(0.50f, 0.48f, 0.46f), Vec3(1.66f, 1.56f, 1.36f)},
                                              {Vec3(0.52f, 0.50f, 0.48f), Vec3(1.54f, 1.48f, 1.36f)}}};
constexpr Shades kDry{Vec3(0.75f, 0.68f, 0.6f), Vec3(1.75f, 1.40f, 1.30f)},
    kSeeds{Vec3(1.25f, 1.05f, 1.0f), Vec3(1.9f, 1.55f, 1.6f)};
// Albedos.
constexpr Vec3 kStalkGreen{0.070f, 0.105f, 0.035f}, kWhite{0.68f, 0.68f, 0.62f}, kGold{0.62f, 0.40f, 0.02f},
    kViolet{0.30f, 0.20f, 0.50f};

Vec3 colour_of(int column, float height, Season season) {
  const auto share = [&](const Shades& s) { return glm::mix(s.foot, s.tip, height) / kTuftTone; };
  switch (column) {
    case kBlade:
      return share(kBladeShades[static_cast<std::size_t>(season)]);
    case kDryBlade:
      return share(kDry);
    case kSeedHead:
      return share(kSeeds);
    case kStalk:
      return kStalkGreen * (0.6f + 0.5f * height);
    case kDaisy:
      return height < 0.38f ? kGold : kWhite;
    case kButtercup:
      return kGold;
    case kScabious:
      return height < 0.3f ? 0.7f * kViolet : kViolet;
    default:
      return Vec3(0.1f);
  }
}

}  // namespace

TriangleMesh grass_tuft(int shape) {
  assert(shape >= 0 && shape < kTuftShapes);
  TuftBuilder tuft(shape);
  if (shape < kFirstMeadow) {
    tuft.blades(kMown);
  } else if (shape < kFirstSeed) {
    tuft.blades(kTall);
  } else if (shape < kFirstFlower) {
    tuft.blades(kWithHeads);
    for (int h = 0; h < kHeads; ++h) tuft.seed_head(tuft.stalk(0.12f, tuft.uniform(0.95f, 1.3f), kBlade));
  } else {
    const auto column = static_cast<TuftColumn>(kDaisy + (shape - kFirstFlower));
    tuft.blades(kWithFlowers, kStalk);
    for (int h = 0; h < kHeads; ++h) {
      const Vec3 top = tuft.stalk(0.14f, tuft.uniform(0.6f, 1.05f), kStalk);
      tuft.flower(top, column == kButtercup ? 0.030f : 0.050f, column);
    }
  }
  return std::move(tuft).finished();
}

Image grass_picture(Season season) {
  Image picture(kColumnCount * kColumnPixels, kPictureRows, 3);
  for (int y = 0; y < kPictureRows; ++y)
    for (int x = 0; x < picture.width; ++x)
      put_srgb(picture.at(x, y),
               colour_of(x / kColumnPixels, static_cast<float>(kPictureRows - 1 - y) / (kPictureRows - 1), season));
  return picture;
}

}  // namespace bosquet::geometry
