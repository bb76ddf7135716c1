// Vector table: trees that are features of a vector file, read by OGR.
//
// Format    points of GeoJSON, GeoPackage, Shapefile, DXF and whatever else GDAL reads; the parts of a multipoint are
//           trees of their own. Of several layers the one that was named, or all that have points
// DXF       points, inserted blocks and full circles are trees, a circle as wide as the crown; the species is looked for
//           in the names of block and layer, attributes of blocks are columns. Other lines and texts are left out. The
//           drawing's unit ($INSUNITS) is understood
// Units     coordinates as in the file, its reference system beside them
// Decision  real numbers are told by the shortest text that gives them back
// Errors    no such file, nothing that GDAL reads, no feature, no such layer
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/result.h"
#include "exchange/tree_table.h"

namespace bosquet::exchange {

/// `layer` may be empty.
Result<std::unique_ptr<TreeTable>> vector_table(const std::filesystem::path& path, const std::string& layer);

}  // namespace bosquet::exchange
