// World file: where on the map a picture lies, told by a text file beside it.
//
// Format    six numbers, a line each: A, D, B, E (map units to the right and down the picture for a pixel) and C, F (the
//           map coordinates of the middle of the upper left pixel). "plan.png" has plan.pgw, plan.pngw or plan.wld, a .jpg
//           .jgw, a .tif .tfw, in any case
// Units     metres of the site's reference system; a picture in degrees or feet cannot be told apart by the file but for
//           the tiny size that degrees make
// Decision  a turned picture is not turned: its notes say so. Pixels that are not square are scaled by their width
// Errors    a file that is there and holds no six numbers, or pixels without a size
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/document.h"

namespace bosquet::exchange {

/// The file beside a picture; nothing when there is none.
std::optional<std::filesystem::path> world_file_of(const std::filesystem::path& picture);

struct PicturePlace {
  DVec2 south_west{0.0};  ///< map coordinates of the picture's lower left corner
  double width = 0.0;     ///< in units of the map
  std::vector<std::string> notes;
};

/// For a picture of so many pixels.
Result<PicturePlace> read_world_file(const std::filesystem::path& file, int width_px, int height_px);

/// What of the place of an underlay is to be taken from its world file.
struct FromWorldFile {
  bool width = true, corner = true;
};

/// Lays the underlay where its world file says, if it has one. One that would lie beside the site keeps its corner at
/// the site's, with a note. `notes` gets what is to be told; false when there is no world file.
Result<bool> lay_by_world_file(scene::Underlay& underlay, const FromWorldFile& wanted, const scene::Georeference& site,
                               DVec2 size_m, std::vector<std::string>& notes);

}  // namespace bosquet::exchange
