#include "scene/planting_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/hash.h"
#include "scene/changes.h"
#include "terrain/exclusion.h"

namespace bosquet::scene {
namespace {

using distribution::Planting;
using distribution::StandingTree;

StandingTree standing(const Tree& tree, const std::vector<distribution::Species>& species) {
  StandingTree stands = distribution::standing_tree(tree.key, static_cast<std::uint32_t>(tree.species),
                                                    species[tree.species], tree.at, tree.scale_width);
  if (tree.trunk_diameter_m) stands.trunk_radius_m = 0.5f * *tree.trunk_diameter_m;
  return stands;
}

bool makes_room(const Tree& tree) { return tree.status == TreeStatus::to_remove; }

distribution::Sowing sowing(const Document& document) {
  // Recipes name their blocks, painted ones have numbers.
  return {document.seed, Hasher().add("painted").add(document.next_block).digest(), 0, planted_mix(document)};
}

// The document with what was planted, which the ground holds already.
Edited finish(const Document& document, PlantingGround& ground, const std::vector<StandingTree>& planted) {
  Edited edited;
  edited.document = document;
  Document& after = edited.document;
  ++after.next_block;
  std::vector<Tree> trees;
  for (const StandingTree& stands : planted) {
    Tree& tree = trees.emplace_back();
    tree.id = after.next_tree_id++;
    tree.key = stands.key;
    tree.species = stands.species;
    tree.at = stands.at;
    tree.scale_height = tree.scale_width = stands.scale;
    edited.trees.push_back(tree.id);
  }
  if (!trees.empty()) after.trees = std::make_shared<const Trees>(document.trees->edited(std::move(trees)));
  edited.name = fmt::format("Plant {}", trees_in_words(planted.size()));
  ground.planted(after);
  return edited;
}

Result<Planting*> prepared(const Document& document, PlantingGround& ground) {
  if (document.species.empty()) return Error{"there is no species to plant"};
  return ground.of(document);
}

float distance2(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const float length2 = glm::dot(along, along);
  const float t = length2 > 0.0f ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
  const Vec2 off = p - (a + t * along);
  return glm::dot(off, off);
}

}  // namespace

std::vector<distribution::Species> planting_species(const Document& document) {
  std::vector<distribution::Species> species;
  for (const auto& s : document.species) species.push_back({s->name, s->shape.trunk_width_m, s->planting});
  return species;
}

std::vector<distribution::MixEntry> planted_mix(const Document& document) {
  if (!document.species_bar.empty()) return document.species_bar.all();
  std::vector<distribution::MixEntry> mix(document.species.size());
  for (std::size_t s = 0; s < mix.size(); ++s) mix[s].species = static_cast<std::uint32_t>(s);
  return mix;
}

Result<Planting*> PlantingGround::of(const Document& document) {
  const std::vector<distribution::Species> species = planting_species(document);
  const bool same_ground =
      planting_ && document_->terrain == document.terrain && document_->species.shares(document.species) &&
      document_->interactions == document.interactions && document_->obstacles.shares(document.obstacles);
  if (!same_ground) {
    planting_.reset();
    terrain::Terrain plantable = *document.terrain;
    for (const Obstacle& o : document.obstacles)
      if (o.outline) plantable = terrain::exclude(plantable, *o.outline);
    auto made = Planting::make(std::move(plantable), species, document.interactions.all());
    if (!made) return made.error();
    planting_ = std::move(*made);
    for (const Tree& tree : *document.trees)
      if (!makes_room(tree)) planting_->add(standing(tree, species));
  } else if (document_->trees != document.trees) {
    const Changes by = changes(*document_, document);
    const auto remove = [&](std::int32_t id) {
      if (const Tree& tree = *document_->trees->find(id); !makes_room(tree)) planting_->remove(tree.key);
    };
    const auto add = [&](std::int32_t id) {
      if (const Tree& tree = *document.trees->find(id); !makes_room(tree)) planting_->add(standing(tree, species));
    };
    for (std::int32_t id : by.removed) remove(id);
    for (std::int32_t id : by.changed) remove(id);
    for (std::int32_t id : by.changed) add(id);
    for (std::int32_t id : by.added) add(id);
  }
  document_ = document;
  return &*planting_;
}

Result<Edited> plant_tree(const Document& document, PlantingGround& ground, std::size_t species, Vec2 at, float scale) {
  if (species >= document.species.size())
    return Error{fmt::format("there is no species number {}; the document has {}", species, document.species.size())};
  if (!(scale >= kLeastTreeScale && scale <= kMostTreeScale))
    return Error{fmt::format("a tree of {} times its size cannot be planted, allowed is {} to {}", scale,
                             kLeastTreeScale, kMostTreeScale)};
  auto planting = prepared(document, ground);
  if (!planting) return planting.error();
  const std::uint64_t key = distribution::tree_key(sowing(document).block, 0);
  const auto refusal = distribution::plant_one(**planting, key, static_cast<std::uint32_t>(species), at, scale);
  if (refusal != distribution::Refusal::none)
    return Error{fmt::format("no tree can stand at ({:.1f}, {:.1f}): {}", at.x, at.y, distribution::words(refusal))};
  return finish(document, ground, {*(*planting)->find(key)});
}

Result<Edited> plant_stroke(const Document& document, PlantingGround& ground, const distribution::PlantBrush& brush,
                            std::span<const distribution::BrushEvent> events, Progress* progress) {
  auto planting = prepared(document, ground);
  if (!planting) return planting.error();
  const distribution::Sown sown = distribution::sow_stroke(**planting, sowing(document), brush, events, progress);
  Edited edited = finish(document, ground, sown.trees);
  if (sown.no_room && !sown.cancelled)
    edited.notes.push_back(fmt::format("room for {} of {}", sown.trees.size(), trees_in_words(sown.asked)));
  return edited;
}

Result<LivePlanting> LivePlanting::begin(const Document& document, PlantingGround& ground,
                                         const distribution::PlantBrush& brush) {
  auto planting = prepared(document, ground);
  if (!planting) return planting.error();
  LivePlanting live(document, ground);
  live.sower_ = std::make_unique<distribution::StrokeSower>(**planting, sowing(document), brush);
  return live;
}

Edited LivePlanting::extend(std::span<const distribution::BrushEvent> events) {
  sower_->extend(events);
  return scene::finish(before_, *ground_, sower_->sown().trees);
}

Edited LivePlanting::finish() {
  sower_->finish();
  Edited edited = scene::finish(before_, *ground_, sower_->sown().trees);
  if (sower_->sown().no_room)
    edited.notes.push_back(
        fmt::format("room for {} of {}", sower_->sown().trees.size(), trees_in_words(sower_->sown().asked)));
  return edited;
}

Result<Edited> plant_places(const Document& document, PlantingGround& ground, std::span<const Vec2> places,
                            float jitter_m, std::string_view what) {
  auto planting = prepared(document, ground);
  if (!planting) return planting.error();
  const distribution::Planted planted = distribution::plant_at(**planting, sowing(document), places, jitter_m);
  Edited edited = finish(document, ground, planted.trees);
  edited.name += fmt::format(" in a {}", what);
  std::map<distribution::Refusal, std::size_t> why;
  for (const distribution::LeftOut& out : planted.left_out) ++why[out.why];
  for (const auto& [refusal, count] : why)
    edited.notes.push_back(fmt::format("{} left out: {}", trees_in_words(count), distribution::words(refusal)));
  return edited;
}

Result<Edited> plant_area(const Document& document, PlantingGround& ground, const distribution::Region& where,
                          std::size_t count, Progress* progress) {
  auto planting = prepared(document, ground);
  if (!planting) return planting.error();
  const distribution::Sown sown = distribution::sow(**planting, sowing(document), where, count, progress);
  Edited edited = finish(document, ground, sown.trees);
  if (sown.no_room) edited.notes.push_back(fmt::format("room for {} of {}", sown.trees.size(), trees_in_words(count)));
  return edited;
}

Edited erase_stroke(const Document& document, std::span<const Vec2> points, float radius_m) {
  std::vector<std::int32_t> near;
  for (const Tree& tree : *document.trees)
    for (std::size_t n = 0; n < points.size(); ++n)
      if (distance2(tree.at, points[n ? n - 1 : 0], points[n]) <= radius_m * radius_m) {
        near.push_back(tree.id);
        break;
      }
  Edited edited = remove_trees(document, near);
  edited.name = fmt::format("Erase {}", trees_in_words(edited.trees.size()));
  return edited;
}

std::vector<std::int32_t> trees_within(const Document& document, const distribution::Region& where) {
  std::vector<std::int32_t> ids;
  for (const Tree& tree : *document.trees)
    if (distribution::contains(where, tree.at)) ids.push_back(tree.id);
  return ids;
}

}  // namespace bosquet::scene
