#include "core/hash.h"

namespace bosquet {

std::string hex_digits(std::uint64_t digest) {
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, digest >>= 4) text[static_cast<std::size_t>(i)] = "0123456789abcdef"[digest & 15];
  return text;
}

}  // namespace bosquet
