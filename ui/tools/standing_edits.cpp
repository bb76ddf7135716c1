#include "ui/tools/standing_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/settings_edits.h"
#include "scene/site_edits.h"

namespace bosquet::ui {
namespace {

struct Parted {
  std::vector<std::int32_t> trees, heroes;
};

Parted parted(std::span<const std::int32_t> ids) {
  Parted out;
  for (const std::int32_t id : ids) (id > 0 ? out.trees : out.heroes).push_back(id);
  return out;
}

// Goes on with another edit of what an edit made; the first one's name stays where both were of something.
void add(scene::Edited& edited, scene::Edited more, bool named) {
  edited.document = std::move(more.document);
  if (!named) edited.name = std::move(more.name);
}

}  // namespace

HeroExtent extent_of(const growth::Skeleton& skeleton) {
  HeroExtent extent;
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (!skeleton.alive(i)) continue;
    const Vec3& p = skeleton.distal[i];
    extent.height_m = std::max(extent.height_m, p.y);
    extent.radius_m = std::max(extent.radius_m, p.x * p.x + p.z * p.z);
  }
  extent.radius_m = std::sqrt(extent.radius_m);
  return extent;
}

const scene::HeroTree* find_hero(const scene::Document& document, std::int32_t id) {
  for (const scene::HeroTree& hero : document.heroes)
    if (hero.id == id) return &hero;
  return nullptr;
}

Result<scene::Edited> place_hero(const scene::Document& document, const HeroInHand& hero, Vec2 at, float turn_deg) {
  scene::Document with = document;
  std::size_t species = 0;
  while (species < with.species.size() && with.species[species]->name != hero.species->name) ++species;
  if (species == with.species.size()) {
    auto added = scene::add_species(with, *hero.species);
    if (!added) return added.error();
    with = std::move(added->document);
  }
  auto skeleton = hero.skeleton;
  if (turn_deg != 0.0f)
    skeleton = std::make_shared<const growth::Skeleton>(scene::placed(*hero.skeleton, 1.0f, turn_deg));
  return scene::add_hero(with, {0, hero.name, species, hero.key, at, std::move(skeleton)});
}

HeroInHand hero_in_hand(const scene::Document& document, const scene::HeroTree& hero) {
  return {hero.name, document.species[hero.species], hero.key, hero.skeleton};
}

Result<scene::Edited> move_selected(const scene::Document& document, std::span<const std::int32_t> ids, Vec2 by) {
  const Parted both = parted(ids);
  auto edited = scene::move_trees(document, both.trees, by);
  if (!edited) return edited;
  bool named = !both.trees.empty();
  for (const std::int32_t id : both.heroes) {
    const scene::HeroTree* hero = find_hero(edited->document, id);
    if (!hero) continue;
    auto moved = scene::move_hero(edited->document, id, hero->at + by);
    if (!moved)
      edited->skipped.push_back(id);  // it would leave the site
    else
      add(*edited, std::move(*moved), std::exchange(named, true));
  }
  return edited;
}

scene::Edited remove_selected(const scene::Document& document, std::span<const std::int32_t> ids) {
  const Parted both = parted(ids);
  scene::Edited edited = scene::remove_trees(document, both.trees);
  bool named = !both.trees.empty();
  for (const std::int32_t id : both.heroes)
    if (auto removed = scene::remove_hero(edited.document, id))
      add(edited, std::move(*removed), std::exchange(named, true));
  return edited;
}

Result<scene::Edited> scale_selected(const scene::Document& document, std::span<const std::int32_t> ids, float by) {
  const Parted both = parted(ids);
  auto edited = scene::scale_trees(document, both.trees, by, by);
  if (!edited) return edited;
  bool named = !both.trees.empty();
  for (const std::int32_t id : both.heroes) {
    auto turned = scene::turn_hero(edited->document, id, by, 0.0f);
    if (turned) add(*edited, std::move(*turned), std::exchange(named, true));
  }
  return edited;
}

}  // namespace bosquet::ui
