#include <algorithm>
#include <optional>

#include "core/scalar.h"
#include "geometry/branch_mesh.h"
#include "geometry/foliage.h"
#include "geometry/leaf_atlas.h"
#include "geometry/leafy_wood.h"

namespace bosquet::geometry {

std::vector<LeafSite> leaf_sites(const FoliageInput& in, FoliageLevel level) {
  const growth::Skeleton& s = *in.skeleton;
  const FoliageLook& look = *in.foliage;
  const bool leafed = has_leaves(in.look->leaf, in.season);
  std::vector<LeafSite> sites;
  if (level == FoliageLevel::leaves && !leafed) return sites;
  const bool single = level == FoliageLevel::leaves;
  const Bloom* bloom = bloom_of(in.look->leaf, in.season);
  const int leaves = single ? single_leaves(in.look->leaf) : 0;
  const float fallen = in.season == Season::autumn && !in.look->leaf.evergreen ? look.autumn_fall : 0.0f;
  const float divergence = radians(look.divergence_deg);
  const std::vector<std::uint8_t> bears = bearing(in);
  std::optional<CrownLight> crown_light;
  if (single && bloom) crown_light.emplace(in);

  for (const ThickestPaths::Path& path : in.paths->paths) {
    const auto run = in.paths->of(path);
    // Around a twig leaves go on turning from internode to internode; 64 turns are enough to forget where it began.
    std::uint32_t around = static_cast<std::uint32_t>(foliage_stream(in, run[0], kOfInternode).at(1) >> 58);
    for (std::size_t k = 0; k < run.size(); ++k) {
      const std::uint32_t i = run[k];
      if (!bears[i]) continue;
      const Vec3 d = s.distal[i] - s.proximal(i);
      const float length = std::sqrt(glm::dot(d, d));
      RandomStream of_internode = foliage_stream(in, i, kOfInternode);
      const auto n =
          std::min(static_cast<std::uint32_t>(length / look.cluster_spacing_m + of_internode.uniform()), 1000u);
      // The foot of a side branch lies inside the wood that bears it.
      const float inside = k == 0 && path.parent >= 0 ? in.radius[in.paths->internodes[path.node]] : 0.0f;
      for (std::uint32_t place = 0; place <= n; ++place) {
        const bool tip = place == n;
        if (tip && k + 1 < run.size()) break;
        RandomStream random = foliage_stream(in, i, place);
        LeafSite site;
        site.internode = i;
        site.place = static_cast<std::uint16_t>(place);
        site.tip = tip;
        site.at = tip ? 1.0f : (static_cast<float>(place) + random.uniform(0.25f, 0.75f)) / static_cast<float>(n);
        site.azimuth = divergence * static_cast<float>(around++) + random.uniform(-0.25f, 0.25f);
        site.size = 1.0f + look.size_variation * random.uniform(-1.0f, 1.0f);
        const bool gone = random.uniform() < fallen;
        if ((gone && !single) || site.at * length < inside) continue;
        if (!single) {
          sites.push_back(site);
          continue;
        }
        // The twig's wood and its leaves one by one.
        const float twig_size = site.size;
        site.leaf = LeafSite::kTwigWood;
        sites.push_back(site);
        for (int number = 0; number < leaves; ++number) {
          RandomStream of_leaf = foliage_stream(in, i, place, number);
          site.leaf = static_cast<std::int16_t>(number);
          site.size = twig_size * (1.0f + look.size_variation * of_leaf.uniform(-1.0f, 1.0f));
          if (of_leaf.uniform() >= fallen) sites.push_back(site);
        }
        site.size = 1.0f;
        if (crown_light && blooms(in, bloom, site, *crown_light))
          for (int bunch = 0; bunch < bloom->bunches; ++bunch) {
            site.leaf = static_cast<std::int16_t>(LeafSite::kFirstBunch + bunch);
            sites.push_back(site);
          }
      }
    }
  }
  return sites;
}

int single_leaves(const LeafLook& leaf) {
  const float cell = cluster_cell_m(leaf), all = static_cast<float>(leaf.cluster_leaves);
  float blade = 1e-6f * leaf.length_mm * leaf.width_mm;
  switch (leaf.outline) {
    case LeafOutline::needle_spray:
    case LeafOutline::scale_cord:
      return leaf.cluster_leaves;  // side shoots, which do not hide each other
    case LeafOutline::pinnate_compound:
      blade *= 0.45f;
      break;
    case LeafOutline::palmate:
      blade *= 0.5f;
      break;
    default:
      blade *= 0.66f;
  }
  // Leaves of the picture are turned away by some degree and smaller toward the shoot's end; thrown at random on the part
  // of the cell that the twig fills they cover 1 - exp(-area) of it.
  constexpr float kSeen = 0.68f;
  const float filled = leaf.cluster == ClusterForm::strings ? 0.35f : 0.62f;
  const float region = filled * cell * cell, shown = region * (1.0f - exp2(-1.442695f * kSeen * all * blade / region));
  return std::clamp(static_cast<int>(shown / blade + 0.5f), std::min(3, leaf.cluster_leaves), leaf.cluster_leaves);
}

}  // namespace bosquet::geometry
