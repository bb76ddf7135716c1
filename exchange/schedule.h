// Planting schedule: a table of the trees and a table of the species, as CSV.
//
// Format    UTF-8, comma, LF, fixed decimals (metres with two, trunk diameter in cm with one), quotes where needed
// Holds     rows in the order given; species in the order of their names; same rows, same bytes
// Errors    what FileOutput refuses
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

struct ScheduleRow {
  std::uint64_t id = 0;
  std::string species;    ///< common name
  std::string botanical;  ///< botanical name
  DVec2 plan{0.0};        ///< metres east and north of the site's south-west corner
  double height_m = 0, trunk_diameter_m = 0, crown_diameter_m = 0;
  std::string inventory_name;  ///< what the inventory called it; may be empty
};

struct SpeciesRow {
  std::string species, botanical;
  std::size_t trees = 0;
  double mean_height_m = 0, lowest_m = 0, highest_m = 0;
  double mean_trunk_diameter_m = 0, mean_crown_diameter_m = 0;
  double basal_area_m2 = 0;  ///< sum of the trunks' cross sections
};

/// One row per (species, botanical).
std::vector<SpeciesRow> summarise(std::span<const ScheduleRow> rows);

Result<std::uint64_t> write_schedule(const std::filesystem::path& path, std::span<const ScheduleRow> rows);
Result<std::uint64_t> write_summary(const std::filesystem::path& path, std::span<const SpeciesRow> rows);

/// A CSV field: quoted when it holds a comma, quote or line break.
std::string csv_field(std::string_view text);

}  // namespace bosquet::exchange
