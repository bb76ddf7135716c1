// Content hashes: the skeleton digest, cache keys and document digests.
//
// Model     a 64-bit word is absorbed at a time: state = mix(state ^ word) * odd; values go in by their bits, so two
//           equal inputs give equal digests on every machine. Not cryptographic.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/random.h"
#include "core/vec.h"

namespace bosquet {

class Hasher {
 public:
  Hasher& add(std::uint64_t word) {
    state_ = mix_bits(state_ ^ word) * 0x9e3779b97f4a7c15ull + 1;
    return *this;
  }
  Hasher& add(std::uint32_t v) { return add(std::uint64_t{v}); }
  Hasher& add(int v) { return add(static_cast<std::uint64_t>(static_cast<std::int64_t>(v))); }
  Hasher& add(bool v) { return add(std::uint64_t{v}); }
  Hasher& add(float v) { return add(std::uint64_t{std::bit_cast<std::uint32_t>(v)}); }
  Hasher& add(double v) { return add(std::bit_cast<std::uint64_t>(v)); }
  Hasher& add(Vec2 v) { return add(v.x).add(v.y); }
  Hasher& add(const Vec3& v) { return add(v.x).add(v.y).add(v.z); }
  Hasher& add(std::string_view text) {
    add(std::uint64_t{text.size()});
    for (unsigned char c : text) add(std::uint64_t{c});
    return *this;
  }
  template <class T>
  Hasher& add_all(std::span<const T> values) {
    add(std::uint64_t{values.size()});
    for (const T& v : values) add(v);
    return *this;
  }

  std::uint64_t digest() const { return mix_bits(state_); }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3ull;
};

/// 16 lower-case hex digits.
std::string hex_digits(std::uint64_t digest);

/// 64-bit hash of a text, for stable keys made from names.
inline std::uint64_t hash_text(std::string_view text) { return Hasher().add(text).digest(); }

}  // namespace bosquet
