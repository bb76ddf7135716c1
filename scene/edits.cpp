#include "scene/edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/tree_parameters.h"

namespace bosquet::scene {
namespace {

std::vector<std::int32_t> sorted(Selection trees) {
  std::vector<std::int32_t> ids(trees.begin(), trees.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

// The selected trees that are there and may be changed; locked ones are skipped.
std::vector<const Tree*> free_trees(const Document& document, Selection selection, Edited& edited) {
  std::vector<const Tree*> trees;
  for (std::int32_t id : sorted(selection)) {
    const Tree* tree = document.trees->find(id);
    if (!tree) continue;
    if (tree->locked)
      edited.skipped.push_back(id);
    else
      trees.push_back(tree);
  }
  return trees;
}

void note_locked(Edited& edited) {
  if (!edited.skipped.empty())
    edited.notes.push_back(
        fmt::format("{} {} locked", trees_in_words(edited.skipped.size()), edited.skipped.size() == 1 ? "is" : "are"));
}

void put(Edited& edited, const Document& document, std::vector<Tree> trees) {
  edited.document = document;
  for (const Tree& tree : trees) edited.trees.push_back(tree.id);
  if (!trees.empty()) edited.document.trees = std::make_shared<const Trees>(document.trees->edited(std::move(trees)));
}

std::string named(std::string_view name, std::size_t count) {
  return fmt::format(fmt::runtime(name), trees_in_words(count));
}

// Where trees may not stand: off the site, on exclusions, in water, inside buildings.
class BadGround {
 public:
  explicit BadGround(const Document& document) : ground_(*document.terrain) {
    for (const Obstacle& o : document.obstacles)
      if (o.outline) buildings_.push_back({o.outline->bounds(), o.outline.get()});
  }
  bool holds(Vec2 at) const {
    if (!terrain::on_site(ground_, at) || ground_.excluded(at) || ground_.under_water(at)) return true;
    return std::any_of(buildings_.begin(), buildings_.end(),
                       [&](const auto& b) { return b.first.contains(at) && b.second->contains(at); });
  }

 private:
  const terrain::Terrain& ground_;
  std::vector<std::pair<Box2, const Polygon*>> buildings_;
};

std::string label(const Document& document, const Tree& tree) {
  return fmt::format("tree {} ({})", tree.id, document.species_of(tree).name);
}

}  // namespace

std::string trees_in_words(std::size_t count) { return count == 1 ? "a tree" : fmt::format("{} trees", count); }

std::vector<std::int32_t> displaced_trees(const Document& document) {
  const BadGround bad(document);
  std::vector<std::int32_t> ids;
  for (const Tree& tree : *document.trees)
    if (bad.holds(tree.at)) ids.push_back(tree.id);
  return ids;
}

Edited change_trees(const Document& document, Selection selection, std::string_view name,
                    const std::function<void(Tree&)>& change) {
  Edited edited;
  std::vector<Tree> changed;
  const auto trees = free_trees(document, selection, edited);
  for (const Tree* tree : trees) {
    Tree now = *tree;
    change(now);
    now.id = tree->id, now.key = tree->key;
    if (now != *tree) changed.push_back(std::move(now));
  }
  put(edited, document, std::move(changed));
  edited.name = named(name, trees.size());
  note_locked(edited);
  return edited;
}

Edited remove_trees(const Document& document, Selection selection) {
  Edited edited;
  edited.document = document;
  for (const Tree* tree : free_trees(document, selection, edited)) edited.trees.push_back(tree->id);
  if (!edited.trees.empty())
    edited.document.trees = std::make_shared<const Trees>(document.trees->edited({}, edited.trees));
  edited.name = named("Remove {}", edited.trees.size());
  note_locked(edited);
  return edited;
}

Result<Edited> move_trees(const Document& document, Selection selection, Vec2 by) {
  if (!(by.x - by.x == 0.0f && by.y - by.y == 0.0f)) return Error{"trees can only be moved by finite distances"};
  Edited edited;
  std::vector<Tree> moved;
  std::size_t off_site = 0;
  std::vector<std::int32_t> stay;
  const BadGround bad(document);
  for (const Tree* tree : free_trees(document, selection, edited)) {
    Tree now = *tree;
    now.at += by;
    if (!terrain::on_site(*document.terrain, now.at)) {
      stay.push_back(tree->id), ++off_site;
      continue;
    }
    if (now.at == tree->at) continue;
    if (bad.holds(now.at) && !bad.holds(tree->at)) edited.displaced.push_back(now.id);
    moved.push_back(std::move(now));
  }
  note_locked(edited);
  if (off_site) edited.notes.push_back(fmt::format("{} would leave the site", trees_in_words(off_site)));
  edited.skipped.insert(edited.skipped.end(), stay.begin(), stay.end());
  std::sort(edited.skipped.begin(), edited.skipped.end());
  edited.name = named("Move {}", moved.size());
  put(edited, document, std::move(moved));
  return edited;
}

Result<Edited> scale_trees(const Document& document, Selection selection, float height, float width) {
  if (!(height > 0.0f && height <= 1000.0f && width > 0.0f && width <= 1000.0f))
    return Error{fmt::format("trees cannot be scaled by {} and {}, allowed is above 0 to 1000", height, width)};
  return change_trees(document, selection, "Scale {}", [&](Tree& tree) {
    const auto scaled = [](float s, float by) { return std::clamp(s * by, kLeastTreeScale, kMostTreeScale); };
    const float before = tree.scale_width;
    tree.scale_height = scaled(tree.scale_height, height), tree.scale_width = scaled(before, width);
    if (tree.trunk_diameter_m) *tree.trunk_diameter_m *= tree.scale_width / before;
  });
}

Edited lock_trees(const Document& document, Selection selection, bool locked) {
  Edited edited;
  std::vector<Tree> changed;
  for (std::int32_t id : sorted(selection))
    if (const Tree* tree = document.trees->find(id); tree && tree->locked != locked) {
      changed.push_back(*tree);
      changed.back().locked = locked;
    }
  edited.name = named(locked ? "Lock {}" : "Unlock {}", changed.size());
  put(edited, document, std::move(changed));
  return edited;
}

Result<Edited> replace_species(const Document& document, Selection selection, std::size_t species) {
  if (species >= document.species.size())
    return Error{fmt::format("there is no species number {}; the document has {}", species, document.species.size())};
  std::size_t own = 0;
  const Species& now = *document.species[species];
  Edited edited = change_trees(document, selection, fmt::format("Replace {{}} by {}", now.name), [&](Tree& tree) {
    if (tree.species == species) return;
    if (tree.measured) {
      const Species& was = document.species_of(tree);
      const auto kept = [](float scale, float before, float after) {
        return std::clamp(scale * before / after, kLeastTreeScale, kMostTreeScale);
      };
      tree.scale_height = kept(tree.scale_height, was.shape.mature_height_m, now.shape.mature_height_m);
      tree.scale_width = kept(tree.scale_width, was.shape.crown_width_m, now.shape.crown_width_m);
    }
    own += !tree.overrides.empty() || !tree.studio_edits.empty();
    tree.species = species;
    tree.overrides = {};
    tree.studio_edits = {};
  });
  if (own) edited.notes.push_back(fmt::format("{} lost what was changed for it alone", trees_in_words(own)));
  return edited;
}

Edited set_status(const Document& document, Selection selection, TreeStatus status) {
  return change_trees(document, selection,
                      fmt::format("Mark {{}} as {}", kTreeStatusNames[static_cast<std::size_t>(status)]),
                      [&](Tree& tree) { tree.status = status; });
}

Result<Edited> set_overrides(const Document& document, Selection selection, SharedList<ParameterOverride> overrides) {
  for (std::int32_t id : selection)
    if (const Tree* tree = document.trees->find(id); tree && !tree->locked)
      if (auto fits = with_overrides(document.species_of(*tree).growth, overrides, label(document, *tree)); !fits)
        return fits.error();
  return change_trees(document, selection, "Change parameters of {}", [&](Tree& tree) { tree.overrides = overrides; });
}

Edited set_studio_edits(const Document& document, std::int32_t tree, SharedList<std::string> operations) {
  return change_trees(document, {&tree, 1}, "Shape {} by hand",
                      [&](Tree& t) { t.studio_edits = std::move(operations); });
}

Result<Edited> keep_as_hero(const Document& document, std::int32_t id, std::shared_ptr<const growth::Skeleton> skeleton,
                            std::string name) {
  const Tree* tree = document.trees->find(id);
  if (!tree) return Error{fmt::format("there is no tree {}", id)};
  if (tree->locked) return Error{fmt::format("{} is locked", label(document, *tree))};
  if (!skeleton || skeleton->size() == 0) return Error{fmt::format("{} has not grown yet", label(document, *tree))};
  Edited edited = remove_trees(document, {&id, 1});
  edited.name = fmt::format("Keep {} as hero tree", label(document, *tree));
  edited.document.heroes.push_back(
      {edited.document.next_standing_id--, std::move(name), tree->species, tree->key, tree->at, std::move(skeleton)});
  return edited;
}

}  // namespace bosquet::scene
