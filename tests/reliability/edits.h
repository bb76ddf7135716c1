// Random edits of a document, for sessions that are killed and disks that fail.
#pragma once

#include <algorithm>

#include "core/random.h"
#include "scene/document.h"
#include "terrain/brush.h"

namespace bosquet::scene {

/// Trees moved, planted or erased, or a stroke on the ground; the same for the same stream.
inline Document edited(const Document& d, RandomStream& random) {
  Document out = d;
  const Vec2 size = d.terrain->size_m();
  const Vec2 at{random.uniform(0, size.x), random.uniform(0, size.y)};
  const std::uint32_t what = random.below(8);
  if (what == 0) {
    terrain::Stroke stroke;
    stroke.points = {at, at + Vec2(5.0f)};
    stroke.kind =
        static_cast<terrain::BrushKind>(random.below(static_cast<std::uint32_t>(terrain::kBrushKindNames.size())));
    out.terrain = std::make_shared<const terrain::Terrain>(terrain::apply(*d.terrain, stroke));
  } else if (what <= 2) {
    Tree tree = d.trees->back();
    tree.id = out.next_tree_id++;
    tree.key = random.bits();
    tree.at = at;
    out.trees = std::make_shared<const Trees>(d.trees->edited({tree}));
  } else if (what == 3 && d.trees->size() > 20) {
    const std::int32_t gone[] = {(*d.trees)[random.below(static_cast<std::uint32_t>(d.trees->size()))].id};
    out.trees = std::make_shared<const Trees>(d.trees->edited({}, gone));
  } else {
    std::vector<Tree> moved;
    const std::uint32_t first = random.below(static_cast<std::uint32_t>(d.trees->size()));
    for (std::size_t i = first; i < std::min<std::size_t>(first + 5, d.trees->size()); ++i) {
      moved.push_back((*d.trees)[i]);
      moved.back().at = at + Vec2(static_cast<float>(i - first));
      moved.back().locked = !moved.back().locked;
    }
    out.trees = std::make_shared<const Trees>(d.trees->edited(std::move(moved)));
  }
  return out;
}

}  // namespace bosquet::scene
