// Leafy wood: which internodes bear leaves, how much light their leaves see, which twigs are in flower or fruit.
//
// Who       leaf_sites.cpp places leaves by it, foliage.cpp makes their cards
// Holds     random numbers are keyed by internode, place and leaf
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "geometry/bloom.h"
#include "geometry/foliage.h"

namespace bosquet::geometry {

inline constexpr std::uint32_t kWholeTree = 0xffffffff;  ///< as an internode: the numbers of the tree itself
inline constexpr std::uint32_t kOfInternode = 0xffff;    ///< as a place: the numbers of the internode itself
inline constexpr std::uint64_t kLeafDraws = 4;  ///< numbers of a leaf's or twig's stream that leaf_sites() may use

/// Random numbers of a twig (leaf kWholeTwig), a leaf of it, or an internode.
RandomStream foliage_stream(const FoliageInput& input, std::uint32_t internode, std::uint32_t place,
                            int leaf = LeafSite::kWholeTwig);

/// For each standing internode, whether it is young and thin enough to bear leaves.
std::vector<std::uint8_t> bearing(const FoliageInput& input);

/// Exposure of leafy wood beside that of its crown. Even a free tree's leaves shade each other so much that few see half of
/// the sky; eyes and cameras take the brightest for white.
class CrownLight {
 public:
  explicit CrownLight(const FoliageInput& input);

  /// 1 where nineteen of twenty are darker, in proportion below.
  float at(std::uint32_t internode) const;

  /// Share of the leafy wood that is not brighter.
  float rank(std::uint32_t internode) const;

 private:
  const std::vector<float>& light_;
  std::vector<float> sorted_;
  float scale_ = 1.0f;
};

/// r L^2 > 1 - share: r is a hash of the twig's place, L the rank of its exposure in the crown. False without a bloom.
bool blooms(const FoliageInput& input, const Bloom* bloom, const LeafSite& site, const CrownLight& light);

}  // namespace bosquet::geometry
