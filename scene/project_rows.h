// Project rows: what the project store's writer and reader share. Nobody else includes it.
#pragma once

#include "core/result.h"
#include "scene/project_store.h"

namespace bosquet::scene {

/// The sections of blobs that are grids, and the grid of each.
template <class Terrain, class Visit>
void each_grid(Terrain& t, const Visit& visit) {
  visit("height", t.height.grid());
  visit("exclusion", t.exclusion.grid());
  visit("density", t.density.grid());
  visit("area_cells", t.areas.grid());
  visit("ponds", t.ponds);
}

/// Writes what differs from `before`, within the transaction that is open; returns what the database then holds.
Result<KnownRows> write_rows(Database& database, const KnownRows& before, const Document& document,
                             const ProjectMeta& meta);

/// Reads all that can be read; `known` is what the database holds, nothing when it is damaged or edited by others.
Result<StoredDocument> read_rows(Database& database, KnownRows& known);

}  // namespace bosquet::scene
