#include "scene/history.h"

#include <cassert>
#include <set>
#include <utility>

#include "scene/changes.h"

namespace bosquet::scene {
namespace {

// Beside its numbers a document holds a handful of pointers.
constexpr std::size_t kDocumentBytes = sizeof(Document) + 256;

std::size_t bytes_of(const Tree& tree) {
  const auto text = [](const std::string& s) { return s.capacity() > 15 ? s.capacity() + 1 : 0; };
  return sizeof(Tree) + text(tree.inventory_name) + text(tree.inventory_id);
}

// What `b` holds of trees that `a` does not.
std::size_t bytes_beside(const Trees& a, const Trees& b) {
  std::size_t bytes = b.blocks().size() * (sizeof(std::shared_ptr<void>) + sizeof(std::size_t));
  std::set<const void*> held;
  for (const auto& block : a.blocks()) held.insert(block.get());
  for (const auto& block : b.blocks()) {
    if (held.contains(block.get())) continue;
    bytes += sizeof(*block) + 16;
    for (const Tree& tree : *block) bytes += bytes_of(tree);
  }
  return bytes;
}

template <class T>
std::size_t bytes_beside(const terrain::TiledGrid<T>& a, const terrain::TiledGrid<T>& b) {
  if (a.size() == b.size() && a.shares_all(b)) return 0;
  const IVec2 tiles = b.tiles();
  const auto table = static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y);
  return table * sizeof(std::shared_ptr<void>) +
         terrain::changed_tiles(a, b).size() * sizeof(typename terrain::TiledGrid<T>::Tile);
}

template <class T>
std::size_t bytes_beside(const SharedList<T>& a, const SharedList<T>& b) {
  return a.shares(b) ? 0 : b.size() * sizeof(T);
}

}  // namespace

std::size_t bytes_apart(const Document& a, const Document& b) {
  std::size_t bytes = kDocumentBytes + b.place.crs_wkt.capacity();
  if (a.trees != b.trees) bytes += bytes_beside(*a.trees, *b.trees);
  if (a.terrain != b.terrain)
    bytes += sizeof(terrain::Terrain) + bytes_beside(a.terrain->height.grid(), b.terrain->height.grid()) +
             bytes_beside(a.terrain->exclusion.grid(), b.terrain->exclusion.grid()) +
             bytes_beside(a.terrain->density.grid(), b.terrain->density.grid()) +
             bytes_beside(a.terrain->areas.grid(), b.terrain->areas.grid()) +
             bytes_beside(a.terrain->ponds, b.terrain->ponds);
  bytes += bytes_beside(a.species, b.species);
  for (std::size_t s = 0; s < b.species.size(); ++s)
    if (s >= a.species.size() || a.species[s] != b.species[s]) bytes += sizeof(Species);
  bytes += bytes_beside(a.interactions, b.interactions) + bytes_beside(a.species_bar, b.species_bar) +
           bytes_beside(a.cameras, b.cameras) + bytes_beside(a.figures, b.figures) + bytes_beside(a.obstacles, b.obstacles) +
           bytes_beside(a.heroes, b.heroes);
  // Meshes and skeletons are shared by their pointers.
  std::set<const void*> held;
  for (const Obstacle& o : a.obstacles) held.insert(o.mesh.get());
  for (const HeroTree& h : a.heroes) held.insert(h.skeleton.get());
  for (const Obstacle& o : b.obstacles)
    if (held.insert(o.mesh.get()).second) bytes += o.mesh->positions.size() * 24 + o.mesh->indices.size() * 4;
  for (const HeroTree& h : b.heroes)
    if (held.insert(h.skeleton.get()).second) bytes += h.skeleton->size() * 40;
  return bytes;
}

History::History(Document start, std::string name, std::size_t most_steps, std::size_t most_bytes)
    : most_steps_(most_steps), most_bytes_(most_bytes) {
  steps_.push_back({std::make_shared<const Document>(std::move(start)), std::move(name)});
}

const std::shared_ptr<const Document>& History::before_drag(std::uint64_t drag) const {
  const bool going_on = drag != 0 && now_ > 0 && steps_[now_].drag == drag;
  return steps_[going_on ? now_ - 1 : now_].document;
}

void History::add(Edited edit, std::uint64_t drag) { add(std::move(edit.document), std::move(edit.name), drag); }

void History::add(Document document, std::string name, std::uint64_t drag) {
  while (can_redo()) {
    bytes_ -= steps_.back().bytes;
    steps_.pop_back();
  }
  if (drag != 0 && now_ > 0 && steps_[now_].drag == drag) {
    bytes_ -= steps_.back().bytes;
    steps_.pop_back();
  }
  Step step{std::make_shared<const Document>(std::move(document)), std::move(name), drag};
  step.bytes = bytes_apart(*steps_.back().document, *step.document);
  bytes_ += step.bytes;
  steps_.push_back(std::move(step));
  now_ = steps_.size() - 1;
  ++revision_;
  trim();
}

// The first step to go takes with it what the second does not share, which is about what the second brought.
void History::trim() {
  while (steps_.size() > 1 && (steps_.size() > most_steps_ + 1 || bytes_ > most_bytes_)) {
    if (now_ == 0) return;
    steps_.pop_front();
    --now_;
    bytes_ -= steps_.front().bytes;
    steps_.front().bytes = 0;
    steps_.front().drag = 0;
  }
}

void History::go_to(std::size_t step) {
  assert(step < steps_.size());
  if (step == now_) return;
  now_ = step;
  ++revision_;
}

void History::undo() {
  assert(can_undo());
  go_to(now_ - 1);
}

void History::redo() {
  assert(can_redo());
  go_to(now_ + 1);
}

}  // namespace bosquet::scene
