// Vector writer: a document's trees as points on a map, for geographic information systems.
//
// Format    .gpkg: layers `trees` (points) and `site` (its outline); .shp: trees with .shx .dbf .cpg and, where the
//           reference system is known, .prj; .geojson: trees in degrees on WGS 84 with nine decimals (RFC 7946)
// Model     attributes: id, species, common_name, botanical, status, height_m, trunk_diameter_m, crown_diameter_m,
//           clear_stem_m, form, surveyed, inventory_name, inventory_id, and grown_height_m, grown_trunk_m, grown_crown_m,
//           age_years once grown; a Shapefile cuts their names to ten letters (kTreeAttributes). What is not known is null
// Frame     coordinates in the site's reference system; without one, metres of an unknown system. GeoJSON without one
//           has metres too and says so ("crs": null), with a warning
// Holds     read_inventory() gives back from a GeoPackage all that an inventory said, places and sizes to the last bit;
//           scales that were drawn or inferred may be off by one. A Shapefile cuts texts at 254 bytes
// Decision  files appear whole: they are written beside the target and moved there; a Shapefile's .shp comes last
// Errors    what GDAL and the disk refuse
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "exchange/tree_records.h"

namespace bosquet::exchange {

struct TreeAttribute {
  std::string_view name, short_name;
};
inline constexpr TreeAttribute kTreeAttributes[]{{"id", "id"},
                                                 {"species", "species"},
                                                 {"common_name", "common"},
                                                 {"botanical", "botanical"},
                                                 {"status", "status"},
                                                 {"height_m", "height_m"},
                                                 {"trunk_diameter_m", "trunk_m"},
                                                 {"crown_diameter_m", "crown_m"},
                                                 {"clear_stem_m", "clear_m"},
                                                 {"form", "form"},
                                                 {"surveyed", "surveyed"},
                                                 {"inventory_name", "inv_name"},
                                                 {"inventory_id", "inv_id"},
                                                 {"grown_height_m", "grown_h_m"},
                                                 {"grown_trunk_m", "grown_t_m"},
                                                 {"grown_crown_m", "grown_c_m"},
                                                 {"age_years", "age_years"}};

struct WrittenTrees {
  std::uint64_t bytes = 0;  ///< of all files
  std::vector<std::string> warnings;
};

/// Whether an ending is one that write_trees() knows: .gpkg, .shp, .geojson.
bool writes_trees(const std::filesystem::path& path);

/// `site_m` is the site's size, `place` where its corner lies.
Result<WrittenTrees> write_trees(const std::filesystem::path& path, std::span<const TreeRecord> trees,
                                 const scene::Georeference& place, DVec2 site_m);

}  // namespace bosquet::exchange
