#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "cli/commands.h"
#include "cli/progress_display.h"
#include "cli/species_source.h"
#include "core/parallel.h"
#include "core/stopwatch.h"
#include "core/write_protection.h"
#include "exchange/file_output.h"
#include "scene/calibration.h"

namespace bosquet::cli {
namespace {

using scene::AgeMeasures;
using scene::Calibration;
using scene::Species;

constexpr float kSilhouetteBand = 0.1f;  // of crown width between details
constexpr float kWidestBand = 0.1f;

float deviation(float grown, float wanted) { return wanted > 0.0f ? grown / wanted - 1.0f : 0.0f; }

// "grown wanted +12%", with ! behind what is out of its band.
std::string beside(float grown, float wanted, std::optional<float> band) {
  const float off = deviation(grown, wanted);
  const bool fails = band && std::abs(off) > *band;
  return fmt::format("{:>6.1f} {:>5.4g} {:>+4.0f}%{}", grown, wanted, 100.0f * off, fails ? '!' : ' ');
}

// What of a row is out of its band, in words; nothing when all is well.
std::vector<std::string> failures(const AgeMeasures& at) {
  const auto band = scene::allowed_deviation(at.age_years);
  if (!band || !at.target) return {};
  std::vector<std::string> failed;
  const auto check = [&](std::string_view what, float grown, float wanted) {
    const float off = deviation(grown, wanted);
    if (std::abs(off) > *band) failed.push_back(fmt::format("{} {:+.0f}%", what, 100.0f * off));
  };
  check("height", at.mean.height_m, at.target->height_m);
  check("crown", at.mean.crown_diameter_m, at.target->crown_m);
  check("trunk", 100.0f * at.mean.trunk_diameter_m, at.target->trunk_cm);
  return failed;
}

void print_row(const AgeMeasures& at) {
  const growth::Measures& m = at.mean;
  std::string sizes;
  if (at.target) {
    const auto band = scene::allowed_deviation(at.age_years);
    sizes = fmt::format("{} {} {}", beside(m.height_m, at.target->height_m, band),
                        beside(m.crown_diameter_m, at.target->crown_m, band),
                        beside(100.0f * m.trunk_diameter_m, at.target->trunk_cm, band));
  } else {
    sizes = fmt::format("{:>6.1f}{:14}{:>6.1f}{:14}{:>6.1f}{:13}", m.height_m, "", m.crown_diameter_m, "",
                        100.0f * m.trunk_diameter_m, "");
  }
  std::string widest = fmt::format("{:.2f}", m.widest_point);
  if (at.target && at.target->widest_point > 0.0f)
    widest += fmt::format("/{:.2f}{}", at.target->widest_point,
                          std::abs(m.widest_point - at.target->widest_point) > kWidestBand ? "!" : "");
  std::string verdict = "reported";
  if (at.target && scene::allowed_deviation(at.age_years)) verdict = failures(at).empty() ? "ok" : "FAIL";
  if (!at.target) verdict = "no [[size]]";
  fmt::print("{:>5.0f} {} {:>5.1f} {:>5.1f} {:>10} {:>5.2f} {:>8} {:>6.0f}  {}\n", at.age_years, sizes, m.crown_base_m,
             m.lowest_limb_m, widest, m.height_m / std::max(m.crown_diameter_m, 0.01f), m.internodes, at.season,
             verdict);
}

// What is wrong with the whole tree, and what its author should know.
struct Verdict {
  std::vector<std::string> failed, advice;
};

Verdict judge(const Species& species, const Calibration& c) {
  Verdict v;
  for (const AgeMeasures& at : c.ages)
    if (const auto failed = failures(at); !failed.empty())
      v.failed.push_back(fmt::format("at {:g} years {}", at.age_years, fmt::join(failed, ", ")));
  for (const auto& d : c.other_details)
    if (const float off = d.crown_width - 1.0f; std::abs(off) > kSilhouetteBand)
      v.failed.push_back(fmt::format("at detail {:g} the crown is {:+.0f}% wide", d.detail, 100.0f * off));
  const float height = species.shape.mature_height_m;
  if (c.mature.height_m < 0.97f * height)
    v.failed.push_back(
        fmt::format("growth ends at {:.1f} m, before mature_height_m = {:g}", c.mature.height_m, height));
  if (species.sizes.empty()) {
    v.advice.push_back("the file has no [[size]] rows to compare with");
    return v;
  }
  if (!c.exponent_solved)
    v.failed.push_back("no pipe_exponent makes the last row's trunk: change tip_diameter_m or the branching");
  else if (c.pipe_exponent < scene::kLeastExponent || c.pipe_exponent > scene::kGreatestExponent)
    v.failed.push_back(fmt::format("pipe_exponent {:.2f} is outside {:g} to {:g}", c.pipe_exponent,
                                   scene::kLeastExponent, scene::kGreatestExponent));
  const auto& last = species.sizes.back();
  if (height < 1.02f * last.height_m)
    v.advice.push_back(fmt::format("mature_height_m = {:g} should stand a few per cent above the {:g} m at {:g} years",
                                   height, last.height_m, last.age_years));
  return v;
}

void print_number(std::string_view key, const std::string& measured, float in_file) {
  fmt::print("  {:<26} {:>7}   file {:>6g}", key, measured, in_file);
}

// Whether every band is kept; unknown without rows to compare with.
enum class Outcome { passes, fails, unknown };

Outcome print_report(const Species& species, const Calibration& c, const scene::CalibrationOptions& options,
                     double seconds) {
  fmt::print("{} ({}): {} trees standing alone, {:.0f} ms each, {:.1f} s\n", species.name, species.botanical_name,
             options.trees, c.milliseconds, seconds);
  fmt::print("{:>5} {:^20}{:^20}{:^20}{:>5} {:>5} {:>10} {:>5} {:>8} {:>6}\n", "", "height m", "crown m", "trunk cm",
             "base", "limb", "widest", "H/C", "inter-", "");
  fmt::print("{:>5} {:>6} {:>5} {:>7} {:>6} {:>5} {:>7} {:>6} {:>5} {:>7} {:>4} {:>5} {:>10} {:>5} {:>8} {:>6}\n",
             "years", "grown", "file", "", "grown", "file", "", "grown", "file", "", "m", "m", "share/file", "",
             "nodes", "season");
  for (const AgeMeasures& at : c.ages) print_row(at);
  const growth::Measures& m = c.mature;
  fmt::print(
      "{:>5} {:>6.1f}{:14}{:>6.1f}  +-{:>2.0f} %{:7}{:>6.1f}{:13}{:>5.1f} {:>5.1f} {:>10.2f} {:>5.2f} {:>8} {:>6.0f}\n",
      "end", m.height_m, "", m.crown_diameter_m, 100.0f * c.crown_spread, "", 100.0f * m.trunk_diameter_m, "",
      m.crown_base_m, m.lowest_limb_m, m.widest_point, m.height_m / std::max(m.crown_diameter_m, 0.01f), m.internodes,
      c.seasons);

  print_number("[shape] trunk_height_m", fmt::format("{:.1f}", m.crown_base_m), species.shape.trunk_height_m);
  for (const auto& d : c.other_details)
    fmt::print("   detail {:g}: {:+.1f}%", d.detail, 100.0f * (d.crown_base - 1.0f));
  fmt::print("\n");
  print_number("[shape] crown_width_m", fmt::format("{:.1f}", m.crown_diameter_m), species.shape.crown_width_m);
  for (const auto& d : c.other_details)
    fmt::print("   detail {:g}: {:+.1f}%", d.detail, 100.0f * (d.crown_width - 1.0f));
  fmt::print("\n");
  print_number("[shape] trunk_width_m", fmt::format("{:.2f}", m.trunk_diameter_m), species.shape.trunk_width_m);
  fmt::print("\n");
  print_number("[growth] pipe_exponent", c.exponent_solved ? fmt::format("{:.3f}", c.pipe_exponent) : "-",
               species.growth.pipe_exponent);
  for (const auto& d : c.other_details)
    fmt::print("   detail {:g}: {}", d.detail, d.pipe_exponent ? fmt::format("{:.3f}", *d.pipe_exponent) : "-");
  fmt::print("\n");
  if (c.fitted) {
    print_number("[growth] age_rate_per_year", fmt::format("{:.4f}", c.fitted->age_rate_per_year),
                 species.growth.age_rate_per_year);
    fmt::print("   fits the heights best, with\n");
    print_number("[growth] age_shape", fmt::format("{:.3f}", c.fitted->age_shape), species.growth.age_shape);
    fmt::print("\n");
  }

  const Verdict verdict = judge(species, c);
  for (const std::string& advice : verdict.advice) fmt::print("  note: {}\n", advice);
  if (!verdict.failed.empty())
    fmt::print("  FAIL: {}\n", fmt::join(verdict.failed, "; "));
  else if (!species.sizes.empty())
    fmt::print("  PASS\n");
  fmt::print("\n");
  if (!verdict.failed.empty()) return Outcome::fails;
  return species.sizes.empty() ? Outcome::unknown : Outcome::passes;
}

Result<void> write_calibrated(const SpeciesSource& source, const Calibration& c, const std::filesystem::path& target) {
  auto text = scene::calibrated_text(source.text, c);
  if (!text) return Error{fmt::format("{}: {}", source.species.name, text.error().message)};
  auto written = exchange::write_file(target, *text);
  if (!written) return written.error();
  // What was written must say what was measured: a file laid out in some unforeseen way is told, not believed.
  auto again = scene::read_species_file(target);
  if (!again) return again.error();
  if (std::abs(again->shape.crown_width_m - c.mature.crown_diameter_m) > 0.06f)
    return Error{fmt::format("{}: [shape] crown_width_m could not be replaced; is it written in a table [shape]?",
                             target.string())};
  return {};
}

Result<void> calibrate_one(const std::string& name, const Options& options, Progress& progress, Outcome& outcome,
                           const std::filesystem::path& target) {
  auto source = species_source(name);
  if (!source) return source.error();
  const scene::CalibrationOptions how{options.calibration_trees, !options.quick};
  Stopwatch watch;
  auto calibration = scene::calibrate(source->species, how, &progress);
  if (!calibration) return calibration.error();
  outcome = print_report(source->species, *calibration, how, watch.seconds());
  std::fflush(stdout);
  return target.empty() ? Result<void>() : write_calibrated(*source, *calibration, target);
}

}  // namespace

Result<void> run_calibrate(const Options& options) {
  const bool all = options.names.empty();
  const std::vector<std::string> names = all ? scene::builtin_species_names() : options.names;
  const std::filesystem::path output = options.outputs.empty() ? "" : options.outputs.front();
  std::error_code ec;
  const bool folder = !output.empty() && std::filesystem::is_directory(output, ec);
  if (names.size() > 1 && !output.empty() && !folder)
    return Error{fmt::format("{}: must be a folder for the files of {} species", output.string(), names.size())};

  if (!options.outputs.empty() && !folder && output.extension() != ".toml")
    return Error{fmt::format("'{}': must end in .toml, or be a folder", output.string())};
  const std::filesystem::path parent = output.parent_path();
  if (!parent.empty() && !std::filesystem::is_directory(parent, ec))
    return Error{fmt::format("cannot write {}: there is no folder {}", output.string(), parent.string())};

  // Known before anything grows: species files are people's own work.
  const auto file_of = [&](const std::string& name) {
    return folder ? output / (std::filesystem::path(name).stem().string() + ".toml") : output;
  };
  for (const std::string& name : output.empty() ? std::vector<std::string>() : names) {
    const std::filesystem::path target = file_of(name);
    if (std::filesystem::exists(target, ec) && !options.replace)
      return Error{
          fmt::format("{}: is there already and would be lost; take another name, or say --replace", target.string())};
    if (auto fine = check_replaceable(target); !fine) return fine;
  }

  Progress progress;
  ProgressDisplay display(progress, true);
  std::vector<std::string> failed, unknown;
  Result<void> done;
  run_with_threads(options.threads, [&] {
    for (const std::string& name : names) {
      Outcome outcome = Outcome::unknown;
      const std::string stem = std::filesystem::path(name).stem();
      done = calibrate_one(name, options, progress, outcome, file_of(name));
      if (!done) return;
      if (outcome == Outcome::fails) failed.push_back(stem);
      if (outcome == Outcome::unknown) unknown.push_back(stem);
    }
  });
  if (!done) return done;
  if (names.size() > 1) {
    const std::size_t passing = names.size() - failed.size() - unknown.size();
    fmt::print("{} of {} species pass", passing, names.size());
    if (!failed.empty()) fmt::print("; not: {}", fmt::join(failed, ", "));
    if (!unknown.empty()) fmt::print("; without [[size]] rows: {}", fmt::join(unknown, ", "));
    fmt::print("\n");
  }
  return {};
}

}  // namespace bosquet::cli
