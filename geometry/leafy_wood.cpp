#include "geometry/leafy_wood.h"

#include <algorithm>

namespace bosquet::geometry {

RandomStream foliage_stream(const FoliageInput& in, std::uint32_t internode, std::uint32_t place, int leaf) {
  const std::uint32_t number = internode == kWholeTree ? kWholeTree : in.skeleton->number_of(internode);
  const std::uint64_t which = static_cast<std::uint64_t>(number) << 32 | static_cast<std::uint64_t>(place) << 16 |
                              static_cast<std::uint64_t>(leaf + 2);
  return {in.seed, mix_bits(in.key) + which, Purpose::foliage};
}

std::vector<std::uint8_t> bearing(const FoliageInput& in) {
  const growth::Skeleton& s = *in.skeleton;
  std::vector<std::uint16_t> last_growth(s.size(), 0);
  for (std::uint32_t i : in.paths->internodes) last_growth[i] = s.born[i];
  for (std::size_t i = s.size(); i-- > 0;) {
    if (s.parent[i] < 0) continue;
    std::uint16_t& below = last_growth[static_cast<std::size_t>(s.parent[i])];
    below = std::max(below, last_growth[i]);
  }
  std::vector<std::uint8_t> bears(s.size(), 0);
  for (std::uint32_t i : in.paths->internodes)
    bears[i] = 2000.0f * in.radius[i] <= in.foliage->max_twig_mm &&
               last_growth[i] - s.born[i] <= in.foliage->leaf_life_seasons;
  return bears;
}

CrownLight::CrownLight(const FoliageInput& in) : light_(in.skeleton->light) {
  const std::vector<std::uint8_t> bears = bearing(in);
  for (std::uint32_t i : in.paths->internodes)
    if (bears[i]) sorted_.push_back(light_[i]);
  std::sort(sorted_.begin(), sorted_.end());
  if (!sorted_.empty()) scale_ = 1.0f / std::clamp(sorted_[sorted_.size() * 19 / 20], 0.02f, 1.0f);
}

float CrownLight::at(std::uint32_t internode) const { return std::clamp(light_[internode] * scale_, 0.0f, 1.0f); }

float CrownLight::rank(std::uint32_t internode) const {
  const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), light_[internode]);
  return sorted_.empty() ? 1.0f : static_cast<float>(above - sorted_.begin()) / static_cast<float>(sorted_.size());
}

bool blooms(const FoliageInput& in, const Bloom* bloom, const LeafSite& site, const CrownLight& light) {
  if (!bloom) return false;
  constexpr std::uint64_t kBlooming = 990;
  const float r = static_cast<float>(foliage_stream(in, site.internode, site.place).at(kBlooming) >> 40) * 0x1p-24f;
  const float rank = light.rank(site.internode);
  return r * rank * rank > 1.0f - bloom->share;
}

}  // namespace bosquet::geometry
