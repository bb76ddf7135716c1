#include "distribution/thinning.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/scalar.h"
#include "distribution/draws.h"

namespace bosquet::distribution {
namespace {

// Seedlings of one year are numbered from year * 2^32, so that more of them renumber those of no other year.
constexpr int kYearBits = 32;
// Numbers of a seedling's planting stream; sowing uses those from 2^30 on for other things.
constexpr std::uint64_t kEast = 1, kNorth = 2, kSuited = 3, kLifespan = 4;

struct Plant {
  StandingTree tree;  // at its final scale
  std::uint64_t number;
  int born, dies;         // years
  float scale, radius_m;  // now
};

std::size_t count_in(const Box2& box, float per_hectare) {
  const double area = static_cast<double>(box.size().x) * static_cast<double>(box.size().y);
  return static_cast<std::size_t>(per_hectare * 1e-4 * area + 0.5);
}

// Share of the final size at each whole age.
std::vector<float> shares(const Stature& stature, int years) {
  std::vector<float> out;
  for (int age = 0; age <= years; ++age)
    out.push_back(pow(1.0f - exp(-stature.rate * static_cast<float>(age)), stature.shape));
  return out;
}

class Stand {
 public:
  Stand(Planting& planting, const Sowing& what, const Region& where, const ThinningRules& rules,
        std::span<const Stature> statures)
      : planting_(planting), what_(what), where_(where), rules_(rules), statures_(statures) {
    // Seedlings are drawn over the bounds that lie on the site and kept where the region is.
    box_ = bounds(where);
    box_ = {glm::max(box_.low, Vec2(0.0f)), glm::min(box_.high, planting.terrain().size_m())};
    for (const Stature& stature : statures) {
      shares_.push_back(shares(stature, rules.years));
    }
    for (const StandingTree& tree : planting.trees())
      keepers_.push_back({tree.at, radius(tree.species, tree.scale), 0});
  }

  void year(int year) {
    come_up(year);
    std::size_t left = 0;
    for (Plant& plant : plants_) {
      if (plant.dies <= year) {
        ++aged;
        continue;
      }
      plant.scale = plant.tree.scale * shares_[plant.tree.species][static_cast<std::size_t>(year - plant.born)];
      plant.radius_m = radius(plant.tree.species, plant.scale);
      plants_[left++] = plant;
    }
    plants_.resize(left);
    thin();
  }

  // Those that are large enough now stand in the planting.
  void finish(int year, Thinned& out) {
    std::sort(plants_.begin(), plants_.end(), [](const Plant& a, const Plant& b) { return a.number < b.number; });
    for (const Plant& plant : plants_) {
      if (plant.scale < rules_.least_scale) continue;
      const StandingTree tree = standing_tree(plant.tree.key, plant.tree.species,
                                              planting_.species()[plant.tree.species], plant.tree.at, plant.scale);
      if (planting_.refusal(tree) != Refusal::none) continue;
      planting_.add(tree);
      out.trees.push_back(tree);
      out.ages.push_back(year - plant.born);
    }
  }

  std::size_t seedlings = 0, dominated = 0, aged = 0;

 private:
  struct Circle {
    Vec2 at;
    float radius_m;
    int next;  // in its bucket
  };

  float radius(std::uint32_t species, float scale) const {
    return rules_.crowding * scale * statures_[species].crown_radius_m;
  }

  void come_up(int year) {
    if (box_.empty()) return;
    const std::size_t count = count_in(box_, year == 1 ? rules_.seedlings_per_ha : rules_.regeneration_per_ha);
    const std::uint64_t first = what_.first_index + (static_cast<std::uint64_t>(year - 1) << kYearBits);
    for (std::size_t n = 0; n < count; ++n) {
      const std::uint64_t key = tree_key(what_.block, first + n);
      const RandomStream stream(what_.seed, key, Purpose::planting);
      const Vec2 at = box_.low + box_.size() * Vec2{unit_interval(stream.at(kEast)), unit_interval(stream.at(kNorth))};
      if (!contains(where_, at)) continue;
      if (unit_interval(stream.at(kSuited)) >= planting_.terrain().density.at(at)) continue;
      const auto type = draw_type(planting_, what_, key, {});
      if (!type) return;
      const std::uint32_t species = what_.mix[*type].species;
      const StandingTree tree =
          standing_tree(key, species, planting_.species()[species], at, draw_scale(planting_, what_, key, *type));
      if (planting_.refusal(tree) != Refusal::none) continue;
      const float lifespan = rules_.lifespan_years * (0.8f + 0.4f * unit_interval(stream.at(kLifespan)));
      plants_.push_back({tree, first + n, year - 1, year - 1 + static_cast<int>(lifespan), 0.0f, 0.0f});
      ++seedlings;
    }
  }

  // From the largest to the smallest: who meets a larger one that lives dies.
  void thin() {
    std::sort(plants_.begin(), plants_.end(), [](const Plant& a, const Plant& b) {
      return a.radius_m != b.radius_m ? a.radius_m > b.radius_m : a.tree.key < b.tree.key;
    });
    float largest = plants_.empty() ? 0.0f : plants_.front().radius_m;
    for (const Circle& keeper : keepers_) largest = std::max(largest, keeper.radius_m);
    clear_buckets(2.0f * largest);
    for (const Circle& keeper : keepers_) put(keeper);
    std::size_t left = 0;
    for (const Plant& plant : plants_) {
      if (meets_any(plant.tree.at, plant.radius_m)) {
        ++dominated;
        continue;
      }
      put({plant.tree.at, plant.radius_m, -1});
      plants_[left++] = plant;
    }
    plants_.resize(left);
  }

  // Buckets as wide as the two largest circles reach, so that a circle's neighbours are in the nine about it.
  void clear_buckets(float reach_m) {
    constexpr float kFinest_m = 0.5f, kMost = 2048.0f;
    const Vec2 size = planting_.terrain().size_m();
    bucket_m_ = std::max({reach_m, kFinest_m, std::max(size.x, size.y) / kMost});
    buckets_ = IVec2(size / bucket_m_) + 1;
    heads_.assign(static_cast<std::size_t>(buckets_.x) * static_cast<std::size_t>(buckets_.y), -1);
    circles_.clear();
  }
  IVec2 bucket(Vec2 at) const { return IVec2(glm::clamp(at / bucket_m_, Vec2(0.0f), Vec2(buckets_ - 1))); }
  int& head(int i, int j) {
    return heads_[static_cast<std::size_t>(j) * static_cast<std::size_t>(buckets_.x) + static_cast<std::size_t>(i)];
  }
  void put(Circle circle) {
    const IVec2 b = bucket(circle.at);
    circle.next = head(b.x, b.y);
    head(b.x, b.y) = static_cast<int>(circles_.size());
    circles_.push_back(circle);
  }
  bool meets_any(Vec2 at, float radius_m) {
    const IVec2 b = bucket(at), low = glm::max(b - 1, IVec2(0)), high = glm::min(b + 1, buckets_ - 1);
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        for (int n = head(i, j); n >= 0;) {
          const Circle& circle = circles_[static_cast<std::size_t>(n)];
          const Vec2 d = circle.at - at;
          const float reach = circle.radius_m + radius_m;
          if (d.x * d.x + d.y * d.y < reach * reach) return true;
          n = circle.next;
        }
    return false;
  }

  Planting& planting_;
  const Sowing& what_;
  const Region& where_;
  const ThinningRules& rules_;
  std::span<const Stature> statures_;
  Box2 box_;
  std::vector<std::vector<float>> shares_;  // of each species, by age
  std::vector<Plant> plants_;
  std::vector<Circle> keepers_;  // trees that stood before
  std::vector<Circle> circles_;
  std::vector<int> heads_;
  IVec2 buckets_{1};
  float bucket_m_ = 1.0f;
};

}  // namespace

double seedlings_in_all(const Region& where, const ThinningRules& rules) {
  const Box2 box = bounds(where);
  if (box.empty()) return 0.0;
  const double hectares = static_cast<double>(box.size().x) * static_cast<double>(box.size().y) * 1e-4;
  return hectares * (rules.seedlings_per_ha + static_cast<double>(rules.regeneration_per_ha) * (rules.years - 1));
}

Thinned fill_by_thinning(Planting& planting, const Sowing& what, const Region& where, const ThinningRules& rules,
                         std::span<const Stature> statures, Progress* progress) {
  assert(statures.size() == planting.species().size());
  assert(rules.years > 0 && rules.crowding > 0.0f);
  assert(seedlings_in_all(where, rules) <= kMostSeedlings);
  Thinned out;
  Stand stand(planting, what, where, rules, statures);
  int year = 1;
  for (; year <= rules.years; ++year) {
    if (progress && progress->cancelled()) {
      out.cancelled = true;
      break;
    }
    stand.year(year);
  }
  if (!out.cancelled) stand.finish(rules.years, out);
  out.seedlings = stand.seedlings, out.dominated = stand.dominated, out.aged = stand.aged;
  return out;
}

}  // namespace bosquet::distribution
