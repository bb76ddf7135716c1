// Site frame: coordinates of a file as metres on the site.
//
// Frame     plan: (east, north) metres from the site's south-west corner; everything before the subtraction is double
// Decision  Corner given: it is the site's corner in the file's own coordinates. Both reference systems known: the file is
//           reprojected into the site's. Only the file's known: the site takes it over when it is projected and true to
//           scale within kTrueScale, else a plane through the middle of the points; with a size the site is centred on the
//           points, unless it has a corner already. The file's unknown: they are metres from the site's corner in map
//           coordinates or on the site, whichever puts more of them onto it; in map coordinates when the map's origin lies
//           on the site, as that of a plot measured from its own corner does
// Decision  GeoJSON is in degrees by its standard. Coordinates that cannot be, or that span more than a site may, are
//           metres of an unknown system
// Errors    systems between which no way is known
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec.h"
#include "scene/document.h"

namespace bosquet::exchange {

inline constexpr double kTrueScale = 0.005;
/// From the site's corner: what claims to lie farther away is a mistake.
inline constexpr float kFarthest_m = 1e6f;

struct FrameOf {
  std::string crs_wkt;          ///< of the file; empty when unknown
  bool crs_assumed = false;     ///< by the format, not by the file
  double metres_per_unit = 1;   ///< without a reference system
  std::optional<DVec2> corner;  ///< the site's, in the file's coordinates
  scene::Georeference site;
  std::optional<DVec2> size_m;  ///< of the site
};

struct OnSite {
  std::vector<DVec2> plan;                   ///< NaN for what cannot be told
  std::optional<scene::Georeference> place;  ///< that the site gets by this file, when it had none
  std::vector<std::string> notes;
};

Result<OnSite> onto_site(std::vector<DVec2> points, const FrameOf& frame);

}  // namespace bosquet::exchange
