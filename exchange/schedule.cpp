#include "exchange/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "exchange/file_output.h"

namespace bosquet::exchange {
namespace {

// Fixed decimals without "-0.00", whatever the locale (fmt asks none).
std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}
std::string metres(double m) { return fixed(m, 2); }
std::string centimetres(double m) { return fixed(100 * m, 1); }

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::vector<SpeciesRow> summarise(std::span<const ScheduleRow> rows) {
  std::map<std::pair<std::string, std::string>, SpeciesRow> by_name;
  for (const ScheduleRow& row : rows) {
    SpeciesRow& sum = by_name[{row.species, row.botanical}];
    sum.lowest_m = sum.trees == 0 ? row.height_m : std::min(sum.lowest_m, row.height_m);
    sum.highest_m = sum.trees == 0 ? row.height_m : std::max(sum.highest_m, row.height_m);
    ++sum.trees;
    sum.mean_height_m += row.height_m;
    sum.mean_trunk_diameter_m += row.trunk_diameter_m;
    sum.mean_crown_diameter_m += row.crown_diameter_m;
    sum.basal_area_m2 += std::numbers::pi / 4 * row.trunk_diameter_m * row.trunk_diameter_m;
  }
  std::vector<SpeciesRow> out;
  for (auto& [name, sum] : by_name) {
    const auto n = static_cast<double>(sum.trees);
    sum.species = name.first, sum.botanical = name.second;
    sum.mean_height_m /= n, sum.mean_trunk_diameter_m /= n, sum.mean_crown_diameter_m /= n;
    out.push_back(std::move(sum));
  }
  return out;
}

Result<std::uint64_t> write_schedule(const std::filesystem::path& path, std::span<const ScheduleRow> rows) {
  auto file = FileOutput::create(path);
  if (!file) return file.error();
  file->write("id,species,botanical_name,east_m,north_m,height_m,trunk_diameter_cm,crown_diameter_m,inventory_name\n");
  for (const ScheduleRow& r : rows)
    file->write(fmt::format("{},{},{},{},{},{},{},{},{}\n", r.id, csv_field(r.species), csv_field(r.botanical),
                            metres(r.plan.x), metres(r.plan.y), metres(r.height_m), centimetres(r.trunk_diameter_m),
                            metres(r.crown_diameter_m), csv_field(r.inventory_name)));
  return file->commit();
}

Result<std::uint64_t> write_summary(const std::filesystem::path& path, std::span<const SpeciesRow> rows) {
  auto file = FileOutput::create(path);
  if (!file) return file.error();
  file->write(
      "species,botanical_name,trees,mean_height_m,lowest_m,highest_m,mean_trunk_diameter_cm,mean_crown_diameter_m,"
      "basal_area_m2\n");
  for (const SpeciesRow& r : rows)
    file->write(fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(r.species), csv_field(r.botanical), r.trees,
                            metres(r.mean_height_m), metres(r.lowest_m), metres(r.highest_m),
                            centimetres(r.mean_trunk_diameter_m), metres(r.mean_crown_diameter_m),
                            fixed(r.basal_area_m2, 3)));
  return file->commit();
}

}  // namespace bosquet::exchange
