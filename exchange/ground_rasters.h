// Ground rasters: heights, masks, areas and ponds of a terrain as GeoTIFFs, exactly as they are.
//
// Heights   one band of 32-bit floats; cells of the ground's width whose middles are the corners that heights stand on
// Map       bands of 16-bit whole numbers, a cell of the ground each: 1 how far it is barred from planting, 2 planting
//           density (both in 1/255), 3 the area on top, 4 the one under it, 5 the top one's cover in 1/255, 6 whose water
//           level holds there. Areas count from 1 in the order of the recipe's list, 0 is the one without a name. A
//           ground without areas has two bands, one without ponds five
// Frame     placed by the site's corner and reference system; row 0 in the north, as rasters have it
// Holds     what was written is read back with the same bits
// Errors    a file that cannot be written or read, a map of another size or with numbers that mean nothing
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::exchange {

/// Whether there is anything but heights and a water level: masks, areas, ponds.
bool has_map(const terrain::Terrain& ground);

Result<void> write_heights(const terrain::Terrain& ground, const scene::Georeference& place,
                           const std::filesystem::path& target);
Result<void> write_map(const terrain::Terrain& ground, const scene::Georeference& place,
                       const std::filesystem::path& target);

/// Lays a map over a ground that has none yet; `areas` are those it numbers, from 1 on.
Result<void> read_map(const std::filesystem::path& file, const std::vector<terrain::Area>& areas,
                      terrain::Terrain& ground);

}  // namespace bosquet::exchange
