#include "geometry/foliage.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/random.h"
#include "core/scalar.h"
#include "geometry/branch_mesh.h"
#include "geometry/leaf_atlas.h"
#include "geometry/leaf_cards.h"
#include "geometry/leafy_wood.h"
#include "geometry/petiole.h"
#include "geometry/shares.h"
#include "geometry/wind.h"

namespace bosquet::geometry {
namespace {

/// Bunches that hang from their stalks; others stand out from their twig.
bool hangs(BloomForm form) {
  return form == BloomForm::catkin || form == BloomForm::balls || form == BloomForm::keys ||
         form == BloomForm::bracts || form == BloomForm::drupes || form == BloomForm::nuts || form == BloomForm::cones;
}

/// The sum of two angles.
SinCos sum(const SinCos& a, const SinCos& b) { return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin}; }

// Cards of hanging whips grow in length before they grow in width, until they are so many times squared as long as wide.
constexpr float kMostSlender = 2.0f;

/// Linear colour factor: `warm` above 0 turns green toward yellow and red, below 0 away from it.
Vec3 hue_turned(float warm) {
  return warm > 0.0f ? Vec3{1.0f, 1.0f - 0.25f * warm, 1.0f - 0.5f * warm} : Vec3{1.0f + 0.3f * warm, 1.0f, 1.0f};
}

/// Leaves let light through to those behind them: shade is less deep than on wood.
float leaf_occlusion(float light) { return 0.3f + 0.7f * occlusion(light); }

AtlasCell inset(AtlasCell cell, float share_of_width) {
  const float margin = 0.5f * kAtlasMargin, middle = 0.5f * (cell.u0 + cell.u1);
  const float half = (0.25f - margin) * share_of_width;
  return {middle - half, cell.v0 + margin, middle + half, cell.v1 - margin};
}

/// A strip of the wood at a twig's foot.
AtlasCell wood_cell() {
  const AtlasCell cell = cluster_cell(0);
  const float middle = 0.5f * (cell.u0 + cell.u1), foot = cell.v1 - 0.5f * kAtlasMargin;
  return {middle - 0.0005f, foot - 0.01f, middle + 0.0005f, foot - 0.002f};
}

/// How far up its twig a leaf stands, 0..1.
float place_on_twig(const LeafLook& leaf, int number, int leaves, float jitter) {
  const float x = (static_cast<float>(number) + jitter) / static_cast<float>(leaves);
  return leaf.cluster == ClusterForm::tuft ? 0.55f + 0.45f * x : 0.12f + 0.88f * x;
}

/// Makes the cards of a tree's leaf sites. Sites of one twig come one after the other.
class FoliageMesher {
 public:
  FoliageMesher(const FoliageInput& in, FoliageLevel level, std::span<const LeafSite> sites, std::size_t count)
      : in_(in),
        look_(*in.foliage),
        leaf_(in.look->leaf),
        level_(level),
        sites_(sites),
        count_(count),
        single_(level == FoliageLevel::leaves),
        folded_(level == FoliageLevel::clusters && look_.cluster_planes == 1),
        bloom_(bloom_of(leaf_, in.season)),
        insertion_(sin_cos(radians(look_.insertion_deg))),
        leaf_droop_(sin_cos(radians(leaf_.droop_deg))),
        twig_droop_(sin_cos(radians(look_.cluster_droop_deg))),
        fold_(sin_cos(radians(folded_ ? look_.fold_deg : 0.0f))),
        crown_(*in.skeleton, sites),
        crown_light_(in) {
    measure_cards();
    measure_thinning();
    RandomStream of_tree = foliage_stream(in, kWholeTree, kOfInternode);
    tree_warmth_ = look_.tree_hue * of_tree.uniform(-0.5f, 0.5f);
    tree_value_ = 1.0f - 0.16f * look_.tree_hue * of_tree.uniform();
    mottle_ = in.season == Season::autumn && !leaf_.evergreen ? 0.35f : 0.12f;
  }

  TriangleMesh mesh() {
    const std::size_t triangles = count_ * triangles_per_site(look_, level_);
    CardWriter cards(crown_, look_.soft_normals, triangles, folded_ ? 6 * count_ : 2 * triangles, in_.wind != nullptr);
    std::array<const LeafSite*, 4> waiting;
    int waits = 0;
    const auto write_waiting = [&] {
      if (waits > 0) add_leaves(std::span(waiting).first(static_cast<std::size_t>(waits)), cards);
      waits = 0;
    };
    const LeafSite* last = nullptr;
    for (std::size_t k = 0; k < sites_.size(); ++k) {
      if (!keeps(k)) continue;
      const LeafSite& site = sites_[k];
      if (!last || site.internode != last->internode || site.place != last->place) {
        write_waiting();
        stand_twig(site);
        if (in_.wind) cards.set_wind(in_.wind->on(*in_.skeleton, site.internode, site.at));
      }
      last = &site;
      if (!single_) {
        add_twig(site, cards);
        continue;
      }
      waiting[static_cast<std::size_t>(waits++)] = &site;
      if (waits == 4) write_waiting();
    }
    write_waiting();
    return cards.take();
  }

 private:
  void measure_cards() {
    const bool spring = in_.season == Season::spring;
    const float season_size = spring && !leaf_.evergreen ? look_.spring_size : 1.0f;
    constexpr float kFilled = 1.0f - 2.0f * kAtlasMargin;
    twig_m_ = cluster_cell_m(leaf_) * (0.5f + 0.5f * season_size) * kFilled;
    if (!single_) return;
    leaf_m_ = leaf_cell_m(leaf_) * season_size * kFilled;
    bunch_m_ = bloom_ ? bunch_cell_m(*bloom_) * kFilled : 0.0f;
    folded_leaves_ = bloom_ && bloom_->before_leaves && spring;
    narrow_ = is_needle(leaf_.outline) ? 1.0f : std::clamp(1.35e-3f * leaf_.width_mm / leaf_cell_m(leaf_), 0.1f, 1.0f);
    leaves_ = single_leaves(leaf_);
    for (int number = 0; number < std::max(leaves_, bloom_ ? bloom_->bunches : 0); ++number)
      turned_.push_back(sin_cos(radians(look_.divergence_deg) * static_cast<float>(number)));
  }

  /// What is left out adds its area to the others.
  void measure_thinning() {
    double all = 0.0, of_kept = 0.0;
    for (std::size_t k = 0; k < sites_.size(); ++k) {
      if (!sites_[k].is_leafy()) continue;
      const double area = static_cast<double>(sites_[k].size) * static_cast<double>(sites_[k].size);
      all += area;
      if (keeps(k)) of_kept += area;
    }
    growth_ = of_kept > 0.0 ? static_cast<float>(std::sqrt(all / of_kept)) : 1.0f;
    crowding_ = 1.0f - 1.0f / growth_;
    if (leaf_.cluster == ClusterForm::strings && !single_) slender_ = std::min(growth_, kMostSlender);
  }

  bool keeps(std::size_t k) const {
    const std::size_t n = sites_.size();
    return count_ == n || (k + 1) * count_ / n != k * count_ / n;
  }

  /// Where the twig stands on its branch and how it turns; wood turns less than a leaf's stalk.
  void stand_twig(const LeafSite& site) {
    const growth::Skeleton& s = *in_.skeleton;
    const std::uint32_t i = site.internode;
    const RandomStream random = foliage_stream(in_, i, site.place);
    light_ = crown_light_.at(i);
    const float weak = 1.0f / (1.0f + 10.0f * std::max(0.0f, s.vigor[i]));
    warmth_ = look_.vigor_hue * weak * weak + tree_warmth_;
    value_ = leaf_occlusion(light_) * tree_value_;
    blooming_ = blooms(in_, bloom_, site, crown_light_);
    const Vec3 from = s.proximal(i), to = s.distal[i];
    const Vec3 branch = unit(to - from, kUp);
    const Across across(branch);
    azimuth_ = sin_cos(site.azimuth);
    const Vec3 radial = across.at(azimuth_);
    at_ = glm::mix(from, to, site.at) + (site.tip ? 0.0f : 0.8f * in_.radius[i]) * radial;
    out_ = crown_.outward(at_);
    const LeafFrame foot = site.tip ? stalk(branch, across.over, {0.0f, 1.0f}) : stalk(branch, radial, insertion_);
    // A card that stands for many looks out of the crown, a piece of its shell.
    const Hanging hang = hanging(all4(foot.heading), twig_droop_, all4(out_));
    constexpr std::uint64_t kAny = 1000;  // far from the numbers drawn in turn
    const auto any = [&](std::uint64_t number) {
      return static_cast<float>(random.at(kAny + number) >> 40) * 0x1p-23f - 1.0f;
    };
    const float shell = single_ ? 0.0f : crowding_;
    const Vec3 toward = unit(glm::mix(hang.normal.lane(0), out_, std::max(look_.sun_turn * light_, shell)) +
                                 0.7f * shell * Vec3{any(0), any(1), any(2)},
                             kUp);
    const float ease = 0.6f * (0.9f + 0.3f * any(3)) * (1.0f + shell);
    frame_ = turn_petiole(sunk(all4(foot), hang.heading, all4(ease * look_.bend)), all4(toward),
                          all4(ease * look_.twist), all4(ease * look_.bend), all4(ease * look_.turn))
                 .lane(0);
    if (single_) across_ = Across(frame_.heading);
  }

  Rgba8 colour(const Vec3& tint) const { return {unorm8(tint.x), unorm8(tint.y), unorm8(tint.z), 255}; }
  Vec3 leaf_tint(float mottle) const { return hue_turned(std::clamp(warmth_ + mottle_ * mottle, -1.0f, 1.0f)); }

  /// The twig of a site with all its leaves: one card, folded or not, or crossed ones.
  void add_twig(const LeafSite& site, CardWriter& cards) const {
    RandomStream random = draws(site);
    LeafCard card;
    const Vec3 tint = leaf_tint(random.uniform(-1.0f, 1.0f));
    card.colour = colour(value_ * random.uniform(0.88f, 1.0f) * tint);
    const bool first = random.uniform() < 0.5f;
    // In a season with a bloom the atlas' first column shows it, the second is plain.
    card.uv = inset(cluster_cell(bloom_ ? !blooming_ : !first), 1.0f);
    if (random.uniform() < 0.5f) std::swap(card.uv.u0, card.uv.u1);
    // A card of far trees has the area of all planes of the clusters that it stands for.
    const float of_planes = level_ == FoliageLevel::cards ? std::sqrt(static_cast<float>(look_.cluster_planes)) : 1.0f;
    const float side = twig_m_ * site.size * growth_ * of_planes;
    card.length = side * slender_, card.half_width = 0.5f * side / slender_;
    // A card that stands for many grows around its place, not out of the crown.
    card.foot = at_ - 0.5f * crowding_ * card.length * frame_.heading;
    card.heading = frame_.heading;
    const int planes = level_ == FoliageLevel::clusters ? look_.cluster_planes : 1;
    for (int plane = 0; plane < planes; ++plane) {
      Vec3 left = frame_.left;
      card.up = frame_.up;
      if (planes > 1) {
        const SinCos turn = sin_cos(kPi * (static_cast<float>(plane) + 0.5f) / static_cast<float>(planes) - 0.5f * kPi);
        left = turn.cos * frame_.left + turn.sin * frame_.up;
        card.up = turn.cos * frame_.up - turn.sin * frame_.left;
      }
      card.left = fold_.cos * left - fold_.sin * card.up, card.right = -fold_.cos * left - fold_.sin * card.up;
      folded_ ? cards.add_folded(card) : cards.add_flat(card);
    }
  }

  /// Up to four sites of the twig that stands: its wood, single leaves, bunches of flowers or fruit.
  void add_leaves(std::span<const LeafSite* const> sites, CardWriter& cards) const {
    SmallCards card;
    card.count = static_cast<int>(sites.size());
    const auto draws_of = [&](std::size_t k) { return draws(*sites[std::min(k, sites.size() - 1)]); };
    std::array<RandomStream, 4> random{draws_of(0), draws_of(1), draws_of(2), draws_of(3)};

    // Leaves stand on their twig as the twig on the branch.
    Float4 sin{}, cos{}, along{}, ease{};
    Int4 is_leaf{};
    for (int k = 0; k < card.count; ++k) {
      const LeafSite& site = *sites[static_cast<std::size_t>(k)];
      if (!is_single_leaf(site)) continue;
      RandomStream& own = random[static_cast<std::size_t>(k)];
      const SinCos azimuth = sum(turned_[static_cast<std::size_t>(site.leaf)], azimuth_);
      sin[k] = azimuth.sin, cos[k] = azimuth.cos, is_leaf[k] = -1;
      along[k] = place_on_twig(leaf_, site.leaf, leaves_, own.uniform(0.2f, 0.8f)) * 0.8f * twig_m_;
      ease[k] = own.uniform(0.6f, 1.2f);
    }
    const LeafFrames twig = all4(frame_);
    const Vec3x4 at = all4(at_), out = all4(out_);
    const LeafFrames foot = stalk(twig.heading, cos * all4(across_.side) + sin * all4(across_.over), insertion_);
    const Hanging hang = hanging(foot.heading, leaf_droop_, out);
    const Vec3x4 toward = unit(mix(hang.normal, out, all4(look_.sun_turn * light_)), all4(kUp));
    constexpr float kCoarse = 0.4f;  // of so many leaves none is looked at closely enough for more steps
    const LeafFrames turned = turn_petiole(sunk(foot, hang.heading, ease * look_.bend), toward, ease * look_.twist,
                                           ease * look_.bend, ease * look_.turn, kCoarse);
    card.heading = select(is_leaf, turned.heading, twig.heading), card.left = select(is_leaf, turned.left, twig.left);
    card.up = select(is_leaf, turned.up, twig.up);
    card.foot = select(is_leaf, at + along * twig.heading, at);

    card.length = card.half_width = all4(0.0f);
    for (int k = 0; k < card.count; ++k)
      dress(*sites[static_cast<std::size_t>(k)], random[static_cast<std::size_t>(k)], k, card);
    // A card that stands for many grows around its place, not out of the crown.
    card.foot = select(is_leaf, card.foot - 0.5f * crowding_ * card.length * card.heading, card.foot);
    if (in_.wind)
      for (std::size_t k = 0; k < sites.size(); ++k) card.still[k] = sites[k]->leaf == LeafSite::kTwigWood;
    cards.add(card, out_);
  }

  static bool is_single_leaf(const LeafSite& site) { return site.leaf >= 0 && !site.is_bunch(); }

  /// The numbers of a twig or leaf that leaf_sites() has left.
  RandomStream draws(const LeafSite& site) const {
    RandomStream random = foliage_stream(in_, site.internode, site.place, site.leaf);
    for (std::uint64_t used = 0; used < kLeafDraws; ++used) random.bits();
    return random;
  }

  /// Size, picture and colour of card k; the place of a bunch.
  void dress(const LeafSite& site, RandomStream& random, int k, SmallCards& card) const {
    const bool wood = site.leaf == LeafSite::kTwigWood;
    if (site.is_bunch()) stand_bunch(site.leaf - LeafSite::kFirstBunch, random, k, card);
    const Vec3 tint = leaf_tint(random.uniform(-1.0f, 1.0f));
    const float value = value_ * random.uniform(0.88f, 1.0f);
    const bool first = random.uniform() < 0.5f;
    AtlasCell& uv = card.uv[k];
    if (wood) {
      uv = wood_cell();
      card.length[k] = 0.8f * twig_m_, card.half_width[k] = 0.5e-3f * leaf_.twig_mm;
    } else if (site.is_bunch()) {
      uv = inset(leaf_cell(0), 1.0f);
      card.length[k] = bunch_m_, card.half_width[k] = 0.5f * bunch_m_;
    } else {
      uv = inset(leaf_cell(bloom_ || !first), narrow_);
      card.length[k] = leaf_m_ * site.size * growth_ * (blooming_ && folded_leaves_ ? kFoldedLeaf : 1.0f);
      card.half_width[k] = 0.5f * card.length[k] * narrow_;
    }
    card.colour[k] = colour(is_single_leaf(site) ? value * tint : Vec3(value));
    if (random.uniform() < 0.5f) std::swap(uv.u0, uv.u1);
  }

  /// Bunches are spread along the twig, hanging down or standing out.
  void stand_bunch(int number, RandomStream& random, int k, SmallCards& card) const {
    const Vec3 radial = across_.at(sum(turned_[static_cast<std::size_t>(number)], azimuth_));
    const float share = (static_cast<float>(number) + random.uniform()) / static_cast<float>(bloom_->bunches);
    const Vec3 heading = unit(hangs(bloom_->form) ? 0.25f * radial - kUp : 0.6f * radial + 0.8f * kUp, radial);
    const Vec3 up = unit(radial - glm::dot(radial, heading) * heading, kUp);
    card.foot.set(k, at_ + (0.25f + 0.7f * share) * 0.8f * twig_m_ * frame_.heading);
    card.heading.set(k, heading), card.up.set(k, up), card.left.set(k, glm::cross(up, heading));
  }

  const FoliageInput& in_;
  const FoliageLook& look_;
  const LeafLook& leaf_;
  const FoliageLevel level_;
  const std::span<const LeafSite> sites_;
  const std::size_t count_;
  const bool single_, folded_;  ///< leaves one by one; twigs on folded cards
  const Bloom* const bloom_;
  const SinCos insertion_, leaf_droop_, twig_droop_, fold_;
  const Crown crown_;
  const CrownLight crown_light_;
  float twig_m_ = 0, leaf_m_ = 0, bunch_m_ = 0, narrow_ = 1;
  bool folded_leaves_ = false;  ///< leaves are just opening in their season
  int leaves_ = 0;
  std::vector<SinCos> turned_;  ///< of the leaves of a twig, one after the other
  float growth_ = 1, crowding_ = 0, slender_ = 1;
  float tree_warmth_ = 0, tree_value_ = 1, mottle_ = 0;

  // The twig that stands.
  Vec3 at_{0.0f}, out_ = kUp;
  LeafFrame frame_{};
  Across across_{kUp};
  SinCos azimuth_{0.0f, 1.0f};
  float light_ = 1, warmth_ = 0, value_ = 1;
  bool blooming_ = false;
};

}  // namespace

std::size_t triangles_per_site(const FoliageLook& foliage, FoliageLevel level) {
  switch (level) {
    case FoliageLevel::leaves:
      return 2;
    case FoliageLevel::clusters:
      return foliage.cluster_planes == 1 ? 4 : 2 * static_cast<std::size_t>(foliage.cluster_planes);
    case FoliageLevel::cards:
      return 2;
  }
  return 2;
}

TriangleMesh mesh_foliage(const FoliageInput& in, FoliageLevel level, std::span<const LeafSite> sites,
                          std::size_t count) {
  count = std::min(count, sites.size());
  if (count == 0) return {};
  return FoliageMesher(in, level, sites, count).mesh();
}

}  // namespace bosquet::geometry
