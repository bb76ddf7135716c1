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

template <std::size_t N>
std::size_t class_of(double size, const std::array<double, N>& begins) {
  return static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), size) - begins.begin());
}

// Columns trunk_to_10_cm, trunk_10_to_20_cm, ..., trunk_from_80_cm.
template <std::size_t N>
std::string class_names(std::string_view what, std::string_view unit, const std::array<double, N>& begins) {
  std::string out = fmt::format(",{}_to_{}_{}", what, begins.front(), unit);
  for (std::size_t i = 1; i < N; ++i) out += fmt::format(",{}_{}_to_{}_{}", what, begins[i - 1], begins[i], unit);
  return out + fmt::format(",{}_from_{}_{}", what, begins.back(), unit);
}

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

std::vector<SpeciesRow> summarise(std::span<const TreeRecord> trees) {
  std::map<std::array<std::string, 3>, SpeciesRow> by_name;
  for (const TreeRecord& tree : trees) {
    SpeciesRow& sum = by_name[{tree.common, tree.botanical, tree.stands_for}];
    const double height = tree.shown_height_m(), crown = tree.shown_crown_m();
    sum.lowest_m = sum.trees == 0 ? height : std::min(sum.lowest_m, height);
    sum.highest_m = sum.trees == 0 ? height : std::max(sum.highest_m, height);
    ++sum.trees;
    ++sum.by_status[static_cast<std::size_t>(tree.status)];
    ++sum.by_height[class_of(height, kHeightClasses_m)];
    sum.mean_height_m += height;
    sum.mean_crown_diameter_m += crown;
    const double area = std::numbers::pi / 4 * crown * crown;
    sum.crown_area_m2 += area;
    if (tree.status != scene::TreeStatus::to_remove) sum.crown_area_kept_m2 += area;
    if (const auto trunk = tree.shown_trunk_m()) {
      const double d = *trunk;
      ++sum.trunks;
      ++sum.by_trunk[class_of(100 * d, kTrunkClasses_cm)];
      sum.mean_trunk_diameter_m += d;
      sum.basal_area_m2 += std::numbers::pi / 4 * d * d;
    }
  }
  std::vector<SpeciesRow> out;
  for (auto& [name, sum] : by_name) {
    const auto n = static_cast<double>(sum.trees);
    sum.species = name[0], sum.botanical = name[1], sum.stands_for = name[2];
    sum.mean_height_m /= n, sum.mean_crown_diameter_m /= n;
    if (sum.trunks > 0) sum.mean_trunk_diameter_m /= static_cast<double>(sum.trunks);
    out.push_back(std::move(sum));
  }
  return out;
}

Result<std::uint64_t> write_schedule(const std::filesystem::path& path, std::span<const TreeRecord> trees) {
  auto file = FileOutput::create(path);
  if (!file) return file.error();
  file->write(
      "id,species,botanical_name,stands_for,status,east_m,north_m,height_m,trunk_diameter_cm,crown_diameter_m,clear_"
      "stem_m,form,"
      "age_years,inventory_id,inventory_name\n");
  for (const TreeRecord& t : trees) {
    const auto trunk = t.shown_trunk_m();
    file->write(fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", t.id, csv_field(t.common), csv_field(t.botanical),
        csv_field(t.stands_for), scene::kTreeStatusNames[static_cast<std::size_t>(t.status)], fixed(t.map.x, 3),
        fixed(t.map.y, 3), metres(t.shown_height_m()), trunk ? centimetres(*trunk) : "", metres(t.shown_crown_m()),
        t.clear_stem_m > 0 ? metres(t.clear_stem_m) : "", t.form, t.grown ? fixed(t.grown->age_years, 0) : "",
        csv_field(t.inventory_id), csv_field(t.inventory_name)));
  }
  return file->commit();
}

Result<std::uint64_t> write_summary(const std::filesystem::path& path, std::span<const SpeciesRow> rows) {
  auto file = FileOutput::create(path);
  if (!file) return file.error();
  std::string line = "species,botanical_name,stands_for,trees";
  for (const std::string_view status : scene::kTreeStatusNames) line += fmt::format(",{}", status);
  line += ",mean_height_m,lowest_m,highest_m,mean_trunk_diameter_cm,mean_crown_diameter_m";
  line += class_names("trunk", "cm", kTrunkClasses_cm) + class_names("height", "m", kHeightClasses_m);
  file->write(line + ",basal_area_m2,crown_area_m2,crown_area_kept_m2\n");
  for (const SpeciesRow& r : rows) {
    line = fmt::format("{},{},{},{}", csv_field(r.species), csv_field(r.botanical), csv_field(r.stands_for), r.trees);
    for (const std::size_t n : r.by_status) line += fmt::format(",{}", n);
    line += fmt::format(",{},{},{},{},{}", metres(r.mean_height_m), metres(r.lowest_m), metres(r.highest_m),
                        r.trunks > 0 ? centimetres(r.mean_trunk_diameter_m) : "", metres(r.mean_crown_diameter_m));
    for (const std::size_t n : r.by_trunk) line += fmt::format(",{}", n);
    for (const std::size_t n : r.by_height) line += fmt::format(",{}", n);
    file->write(line + fmt::format(",{},{},{}\n", fixed(r.basal_area_m2, 3), fixed(r.crown_area_m2, 1),
                                   fixed(r.crown_area_kept_m2, 1)));
  }
  return file->commit();
}

}  // namespace bosquet::exchange
