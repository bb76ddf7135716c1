// Project hash: 128-bit content hashes that guard a project file against silent damage.
//
// Model     two lanes of a 64-bit mixing function (core/random.h) with constants of their own; bytes go in as
//           little-endian words, their number last. Not cryptographic: it is chance that is guarded against
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "core/hash.h"
#include "core/random.h"

namespace bosquet::scene {

struct Hash128 {
  std::uint64_t first = 0, second = 0;

  bool operator==(const Hash128&) const = default;
};

/// 32 lower-case hex digits.
inline std::string hex_digits(const Hash128& hash) {
  return bosquet::hex_digits(hash.first) + bosquet::hex_digits(hash.second);
}

class Hasher128 {
 public:
  Hasher128& add(std::uint64_t word) {
    first_ = mix_bits(first_ ^ word) * 0x9e3779b97f4a7c15ull + 1;
    second_ = mix_bits(second_ + word) * 0xd6e8feb86659fd93ull + 3;
    return *this;
  }
  Hasher128& add(const Hash128& hash) { return add(hash.first).add(hash.second); }
  Hasher128& add(std::span<const std::byte> bytes) {
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, 8);
      add(word);
    }
    std::uint64_t rest = 0;
    if (i < bytes.size()) std::memcpy(&rest, bytes.data() + i, bytes.size() - i);
    return add(rest).add(std::uint64_t{bytes.size()});
  }
  Hasher128& add(std::string_view text) { return add(std::as_bytes(std::span(text.data(), text.size()))); }

  Hash128 digest() const { return {mix_bits(first_), mix_bits(second_)}; }

 private:
  static_assert(std::endian::native == std::endian::little, "words are read as they lie in memory");
  std::uint64_t first_ = 0x243f6a8885a308d3ull, second_ = 0x13198a2e03707344ull;
};

}  // namespace bosquet::scene
