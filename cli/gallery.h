// Gallery: a sheet of species, each young, middle-aged and old, with and without leaves, beside a person.
//
// Model     every species' tree grows once, free-standing, and is shown as it stood at each age; elevations are parallel
//           projections from the south, so heights can be read off
// Layout    the tallest species first; species stand side by side while the row's scale stays large enough. A row has
//           one scale, told by lines every 5 m (1 m for low rows) and by a person of 1.75 m
// Decision  evergreens lose their leaves too in the second picture: it is there to show the wood
// Errors    unknown species; a size no row fits in; no graphics (kind cannot_finish)
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "core/result.h"
#include "geometry/season.h"
#include "scene/species.h"

namespace bosquet::cli {

/// Key of every tree of the sheet.
inline constexpr std::uint64_t kGalleryKey = 1;

struct GalleryOptions {
  std::vector<float> ages;  ///< years; empty: 10, middle and last of the species' own [[size]] rows
  geometry::Season season = geometry::Season::summer;
  float detail = 1.0f;
  std::uint64_t seed = 1;
  int width = 3200, height = 4800;  ///< pixels the sheet may take; it is as high as its rows
};

Result<Image> draw_gallery(const std::vector<scene::Species>& species, const GalleryOptions& options,
                           Progress* progress);

}  // namespace bosquet::cli
