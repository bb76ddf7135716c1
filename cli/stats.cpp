#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/commands.h"
#include "cli/grown.h"
#include "cli/progress_display.h"
#include "core/parallel.h"
#include "distribution/pattern.h"

namespace bosquet::cli {
namespace {

using Json = nlohmann::ordered_json;

// Up to a quarter of the shorter side, where few circles leave the window.
std::vector<double> distances(Vec2 size) {
  const double most = 0.25 * static_cast<double>(std::min(size.x, size.y));
  std::vector<double> t;
  for (int i = 1; i <= 20; ++i) t.push_back(most * i / 20.0);
  return t;
}

// Fewer than two points have no pattern: lists are empty then.
Json pattern(const std::vector<Vec2>& points, const Box2& window, std::vector<double> t) {
  if (points.size() < 2) t.clear();
  const std::vector<double> isotropic = distribution::ripley_k(points, window, t);
  Json json;
  json["n"] = points.size();
  json["K_plain"] = distribution::ripley_k_plain(points, window, t);
  json["K_isotropic"] = isotropic;
  json["L"] = distribution::ripley_l(isotropic);
  json["g"] = distribution::pair_correlation(points, window, t);
  json["nearest_m"] = distribution::nearest_distances(points);
  return json;
}

double mean(const Json& values) {
  double sum = 0;
  for (const Json& v : values) sum += v.get<double>();
  return sum / static_cast<double>(values.size());
}

void print_table(const Json& json) {
  const Json &bases = json["bases"], &crowns = json["crown_centroids"];
  const auto n = bases["n"].get<std::size_t>();
  if (n < 2) {
    fmt::print("{}: a pattern needs two trees at least\n", n == 0 ? "no trees" : "1 tree");
    return;
  }
  fmt::print("{} trees on {:g} x {:g} m; nearest tree on average at {:.2f} m, nearest crown centroid at {:.2f} m\n", n,
             json["window_m"][0].get<double>(), json["window_m"][1].get<double>(), mean(bases["nearest_m"]),
             mean(crowns["nearest_m"]));
  fmt::print("K(t) - pi t^2 and L(t) - t are above 0 where trees are clustered, below 0 where they keep apart\n\n");
  fmt::print("{:>8} {:>14} {:>14} {:>12} {:>12} {:>10} {:>10}\n", "t m", "K-pit2 bases", "K-pit2 crowns", "L-t bases",
             "L-t crowns", "g bases", "g crowns");
  const auto at = [](const Json& pattern, const char* key, std::size_t i) { return pattern[key][i].get<double>(); };
  for (std::size_t i = 0; i < json["t_m"].size(); ++i) {
    const double t = json["t_m"][i], circle = std::numbers::pi * t * t;
    fmt::print("{:>8.2f} {:>14.2f} {:>14.2f} {:>12.3f} {:>12.3f} {:>10.3f} {:>10.3f}\n", t,
               at(bases, "K_isotropic", i) - circle, at(crowns, "K_isotropic", i) - circle, at(bases, "L", i) - t,
               at(crowns, "L", i) - t, at(bases, "g", i), at(crowns, "g", i));
  }
}

Result<Json> measure(const Options& options, Report& report, Progress& progress) {
  auto grown = grow_recipe(options, false, report, progress);
  if (!grown) return grown.error();
  const scene::Document& document = grown->document;
  const Vec2 size = document.terrain->size_m();
  const Box2 window{Vec2(0.0f), size};

  std::vector<Vec2> bases, crowns;
  std::map<std::string, std::vector<Vec2>> by_species;
  for (std::size_t i = 0; i < grown->trees.size(); ++i) {
    const scene::Tree& tree = (*document.trees)[i];
    bases.push_back(tree.at);
    // A crown may hang over the site's edge; the window is closed, so it counts at the edge.
    crowns.push_back(glm::clamp(tree.at + grown->trees[i].measures.crown_centroid, Vec2(0.0f), size));
    by_species[document.species_of(tree).name].push_back(tree.at);
  }
  const std::vector<double> t = distances(size);
  Json json;
  json["window_m"] = {size.x, size.y};
  json["t_m"] = t;
  json["bases"] = pattern(bases, window, t);
  json["crown_centroids"] = pattern(crowns, window, t);
  json["cross"] = Json::object();
  for (const auto& [a, from] : by_species)
    for (const auto& [b, to] : by_species)
      if (a != b) json["cross"][a + "->" + b]["K_isotropic"] = distribution::cross_k(from, to, window, t);
  return json;
}

}  // namespace

Result<void> run_stats(const Options& options) {
  Report report;
  Progress progress;
  std::optional<Result<Json>> json;
  {
    ProgressDisplay display(progress, options.quiet);
    run_with_threads(options.threads, [&] { json = measure(options, report, progress); });
  }
  print_warnings(report.warnings, options.quiet);
  if (!*json) return json->error();
  if (!options.report.empty()) {
    report.threads = working_threads();
    if (auto written = write_report(options.report, report); !written) return written;
  }
  if (options.json)
    fmt::print("{}\n", (**json).dump(2, ' ', false, Json::error_handler_t::replace));
  else
    print_table(**json);
  return {};
}

}  // namespace bosquet::cli
