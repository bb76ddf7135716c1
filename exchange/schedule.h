// Planting schedule: a table of the trees and a table of the species, as CSV.
//
// Format    UTF-8, comma, LF, fixed decimals (metres with two, places in the site's reference system with three, trunk
//           diameter in cm with one), quotes where needed; what is not known is empty
// Model     sizes as the trees stand when they were grown, else as the document says them. A species' table counts its
//           trees by status, by classes of trunk (cm, the lower end belongs to the class) and of height (m)
// Holds     rows in the order given; species in the order of their names; same rows, same bytes
// Errors    what FileOutput refuses
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "exchange/tree_records.h"

namespace bosquet::exchange {

/// Where classes begin, after the one from 0.
inline constexpr std::array kTrunkClasses_cm{10.0, 20.0, 40.0, 60.0, 80.0};
inline constexpr std::array kHeightClasses_m{5.0, 10.0, 15.0, 20.0, 25.0};

struct SpeciesRow {
  std::string species, botanical;
  std::string stands_for;  ///< the inventory's name of trees that are drawn as this species
  std::size_t trees = 0;
  std::array<std::size_t, scene::kTreeStatusNames.size()> by_status{};
  double mean_height_m = 0, lowest_m = 0, highest_m = 0;
  std::size_t trunks = 0;  ///< whose diameter is known
  double mean_trunk_diameter_m = 0, mean_crown_diameter_m = 0;
  std::array<std::size_t, kTrunkClasses_cm.size() + 1> by_trunk{};
  std::array<std::size_t, kHeightClasses_m.size() + 1> by_height{};
  double basal_area_m2 = 0;       ///< sum of the trunks' cross sections
  double crown_area_m2 = 0;       ///< sum of the crowns' discs
  double crown_area_kept_m2 = 0;  ///< without the trees that are to be removed
};

/// One row per (species, botanical, stands_for).
std::vector<SpeciesRow> summarise(std::span<const TreeRecord> trees);

Result<std::uint64_t> write_schedule(const std::filesystem::path& path, std::span<const TreeRecord> trees);
Result<std::uint64_t> write_summary(const std::filesystem::path& path, std::span<const SpeciesRow> rows);

/// A CSV field: quoted when it holds a comma, quote or line break.
std::string csv_field(std::string_view text);

}  // namespace bosquet::exchange
