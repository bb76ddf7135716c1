// Crown shell: a crown as a few dozen ragged patches on its surface, for trees too far for single cards.
//
// Model     directions spread evenly over a sphere (Fibonacci lattice) divide the foliage, seen from the crown's middle
//           in units of its half extents, into as many parts as there are patches. A patch stands where its part is
//           dense and far out, faces outward and a little its own way, bears the part's mean colour and shows a foliage mass (foliage_mass.h)
// Decision  patches are made as large, and as bright, as gives the crown the silhouette and the mean colour that the
//           level raster measures of the full foliage, from three sides and from above
// Units     metres, tree frame
// Holds     same foliage, same bits, on every machine
// Cost      about 2 ms for a crown of 6,000 triangles
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/triangle_mesh.h"
#include "geometry/lod_raster.h"

namespace bosquet::geometry {

/// At most `patches` patches of two triangles; none for no foliage. `leaf` is the skin of `foliage`, `mass` of the shell.
/// Where the foliage has wind weights a patch has their mean, and the phase of a leaf in it.
TriangleMesh crown_shell(const TriangleMesh& foliage, const RasterSkin& leaf, const RasterSkin& mass,
                         std::size_t patches, std::uint64_t key);

}  // namespace bosquet::geometry
