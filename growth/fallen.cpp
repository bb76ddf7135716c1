#include "growth/fallen.h"

#include <algorithm>
#include <cassert>

namespace bosquet::growth {

Skeleton without_fallen(const Skeleton& s) {
  assert(s.radius.size() == s.size());
  const auto count = static_cast<std::size_t>(std::count(s.shed.begin(), s.shed.end(), kNever));
  Skeleton out;
  out.parent.reserve(count), out.axis.reserve(count), out.order.reserve(count), out.distal.reserve(count);
  out.radius.reserve(count), out.born.reserve(count), out.light.reserve(count), out.vigor.reserve(count);
  out.number.reserve(count);
  if (!s.pipes.empty()) out.pipes.reserve(count);
  std::vector<std::int32_t> now(s.size(), -1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (!s.alive(i)) continue;
    now[i] = static_cast<std::int32_t>(out.parent.size());
    // Whole branches fall, so what stands stands on standing wood.
    out.parent.push_back(s.parent[i] < 0 ? -1 : now[static_cast<std::size_t>(s.parent[i])]);
    out.axis.push_back(s.axis[i]), out.order.push_back(s.order[i]), out.distal.push_back(s.distal[i]);
    out.radius.push_back(s.radius[i]), out.born.push_back(s.born[i]);
    out.light.push_back(s.light[i]), out.vigor.push_back(s.vigor[i]);
    if (!s.pipes.empty()) out.pipes.push_back(s.pipes[i]);
    out.number.push_back(s.number_of(static_cast<std::uint32_t>(i)));
  }
  out.shed.assign(count, kNever);
  out.seasons = s.seasons, out.internode_length_m = s.internode_length_m, out.detail = s.detail;
  out.tip_diameter_m = s.tip_diameter_m, out.pipe_exponent = s.pipe_exponent;
  return out;
}

}  // namespace bosquet::growth
