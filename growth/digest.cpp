#include "growth/digest.h"

#include "core/hash.h"

namespace bosquet::growth {

std::uint64_t digest(const Skeleton& s) {
  Hasher hasher;
  hasher.add(static_cast<std::uint64_t>(s.size())).add(s.seasons).add(s.internode_length_m).add(s.detail);
  hasher.add(s.tip_diameter_m).add(s.pipe_exponent);
  for (std::size_t i = 0; i < s.size(); ++i) {
    hasher.add(std::uint64_t{s.axis[i]} << 32 | static_cast<std::uint32_t>(s.parent[i]));
    hasher.add(std::uint64_t{s.born[i]} << 32 | std::uint64_t{s.shed[i]} << 8 | s.order[i]);
    hasher.add(s.distal[i]).add(s.radius[i]).add(s.light[i]).add(s.vigor[i]);
  }
  for (const std::uint8_t pipes : s.pipes) hasher.add(static_cast<int>(pipes));
  return hasher.digest();
}

}  // namespace bosquet::growth
