// Ground recipe: the tables [site] and [terrain] of a recipe as plain values, and the ground made of them.
//
// Format    docs/recipe.md
// Order     elevation, map, noise, strokes, water level, the boundary, then areas, exclusions and paths in the order of the
//           file; what comes later lies on top
// Place     with an elevation raster the site's corner is `dem_south_west` or, without, the site's own `south_west`, or,
//           without either, such that the site's middle is the raster's; its reference system is that of [site], else the
//           raster's. Without size_m the site is as large as the boundary or, without, as the raster
// Errors    of the files, of a raster that does not cover the site, of areas that cannot be; what was filled, reprojected,
//           cut or guessed is a warning
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/polygon.h"
#include "core/result.h"
#include "scene/document.h"
#include "scene/toml_table.h"
#include "terrain/brush.h"
#include "terrain/perlin.h"
#include "terrain/pond.h"

namespace bosquet::exchange {

struct AreaRecipe {
  terrain::Area area;
  bool kind_given = false, cover_given = false;
  std::vector<Vec2> polygon, points;  ///< either, or a file
  float width_m = 2.0f;               ///< of lines
  std::filesystem::path file;
  std::string layer, where, kind_from;  ///< in the file
  std::optional<float> level_m;         ///< of water
  terrain::PondRules pond;
};

struct GroundRecipe {
  terrain::PerlinNoise noise{.amplitude_m = 0.0f};
  std::filesystem::path dem;
  DVec2 dem_south_west{0.0};  ///< the site's corner in the raster's coordinates
  bool dem_corner_given = false;
  std::optional<DVec2> dem_heights_m;  ///< of the raster's smallest and largest number
  std::optional<DVec2> dem_size_m;     ///< of a raster without georeference
  std::filesystem::path map;           ///< masks, areas and ponds cell by cell (ground_rasters.h)
  std::vector<terrain::Area> map_areas;
  std::vector<terrain::Stroke> strokes;
  std::optional<float> water_level_m;
  std::vector<AreaRecipe> areas;  ///< with exclusions and paths

  bool site_corner_given = false, sun_place_given = false;  ///< in [site]
  std::vector<Vec2> boundary;
  std::filesystem::path boundary_file;

  /// Whether the site's size can be told from the data.
  bool has_extent() const { return !dem.empty() || !boundary_file.empty() || !boundary.empty(); }
  /// Files that it reads.
  std::vector<std::filesystem::path> files() const;
};

/// Reads what [site] says of the ground, and [terrain]. Relative files are looked for in `folder`.
void read_site_ground(scene::TomlTable& site, const std::filesystem::path& folder, GroundRecipe& ground);
void read_ground(scene::TomlTable& terrain, const std::filesystem::path& folder, GroundRecipe& ground);

struct Ground {
  terrain::Terrain terrain;
  scene::Georeference place;
  std::vector<std::string> warnings;
};

/// `size_m` is (0, 0) when the recipe does not say it.
Result<Ground> make_ground(const GroundRecipe& recipe, Vec2 size_m, const scene::Georeference& place,
                           std::uint64_t seed);

}  // namespace bosquet::exchange
