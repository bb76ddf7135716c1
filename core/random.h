// Random streams: numbers that are a hash of what is being computed.
//
// Source    Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3" (counter-based generators); the mixing
//           function is SplitMix64's (Steele et al. 2014)
// Model     number n of a stream = mix(stream_key + n * golden), stream_key = hash(document seed, key, purpose)
// Holds     neither thread, order nor other streams can change a stream; a tree's stream is keyed by its stable key
//           (never its place in an array), so deleting one tree reshuffles no other
#pragma once

#include <cstdint>

namespace bosquet {

/// SplitMix64's finaliser: a bijection of 64-bit words in which every input bit flips half of the output bits.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x ^= x >> 30, x *= 0xbf58476d1ce4e5b9ull;
  x ^= x >> 27, x *= 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// What a stream is for; every use of randomness names its own. Values are part of results: never renumber.
enum class Purpose : std::uint64_t {
  terrain = 1,
  planting = 2,
  growth = 3,
  foliage = 4,
  texture = 5,
  statistics = 6,
  asymmetry = 7,
  scale = 8,
  branch_mesh = 9,
  ground_cover = 10,
};

class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t key, Purpose purpose)
      : key_(mix_bits(mix_bits(mix_bits(seed + kGolden) + key) + static_cast<std::uint64_t>(purpose))) {}

  std::uint64_t bits() { return at(counter_++); }

  /// Uniform in [0, 1), multiples of 2^-24.
  float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  float uniform(float low, float high) { return low + (high - low) * uniform(); }

  /// Uniform integer in [0, n), n > 0.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((bits() >> 32) * n) >> 32); }

  /// Number n of the stream, without moving it.
  std::uint64_t at(std::uint64_t n) const { return mix_bits(key_ + (n + 1) * kGolden); }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace bosquet
