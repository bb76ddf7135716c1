// Validation: the tables of docs/validation.md, which compare grown stands with published claims and measurements.
//
// kernel_effects, lansing_planted   patterns that kernels make (planting_statistics.h)
// uniformity    Ripley's K of tree bases and of crown centroids in clustered samples, as Longay 2014, figure 6.24
// lansing       the same for the real trees of Lansing Woods
// crown_bases   where living crowns begin in closed stands of one species, with canopy light on and off, beside
//               regional yield models
// thresholds    the same at CCF 300 for other shedding thresholds, beside what they do to a tree in the open
//
// Usage         validation [FILE.md] [TABLE...]: prints the tables asked for (default: all), or writes each between
//               its marks <!-- TABLE --> and <!-- /TABLE --> in FILE.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bench/planting_statistics.h"
#include "core/hash.h"
#include "core/random.h"
#include "distribution/pattern.h"
#include "exchange/recipe.h"
#include "scene/grown_scene.h"
#include "scene/species_names.h"

namespace {

using namespace bosquet;

[[noreturn]] void fail(const std::string& message) {
  fmt::print(stderr, "validation: {}\n", message);
  std::exit(1);
}

template <class T>
T value(Result<T> result) {
  if (!result) fail(result.error().message);
  return std::move(*result);
}

scene::GrownScene grow(const scene::Document& document, const scene::GrowOptions& options) {
  return value(scene::grow_scene(document, options, nullptr));
}

// ---------------------------------------------------------------------------------------------- uniformity of crowns

constexpr double kSearchRadius_m = 5.0;  // t in the source

// 60 trees of three species in five clusters on 30 x 30 m, with the source's voxels, free reach and no overhang.
scene::Document clustered_sample(std::uint64_t seed, float asymmetry_max) {
  constexpr int kClusters = 5, kTreesOfOne = 12;
  constexpr float kSide = 30.0f, kRadius = 4.0f;
  std::string recipe = fmt::format(
      "[site]\nsize_m = [{0}, {0}]\nseed = {1}\n[space]\nvoxel_m = 0.234375\nlayers = 20\nreach_factor = inf\n"
      "overhang_m = 0\n[light]\ncanopy_light = false\n[asymmetry]\nasymmetry_max = {2}\n",
      kSide, seed, asymmetry_max);
  RandomStream draw(seed, 0, Purpose::statistics);
  for (int c = 0; c < kClusters; ++c) {
    const float east = draw.uniform(kRadius, kSide - kRadius), north = draw.uniform(kRadius, kSide - kRadius);
    recipe += fmt::format(
        "[[planting]]\nname = \"cluster {}\"\nkind = \"fill\"\ncentre = [{}, {}]\nradius_m = {}\ncount = {}\n"
        "species = {{ english_oak = 1, silver_birch = 1, norway_spruce = 1 }}\nscale = [0.3, 1.0]\n",
        c, east, north, kRadius, kTreesOfOne);
  }
  return value(exchange::build_document(value(exchange::parse_recipe(recipe, "clustered sample")))).document;
}

struct Crowns {
  std::vector<Vec2> bases, centroids;
};
Crowns centroids(const scene::GrownScene& grown) {
  Crowns c;
  const Vec2 size = grown.document.terrain->size_m();
  for (std::size_t i = 0; i < grown.trees.size(); ++i) {
    c.bases.push_back((*grown.document.trees)[i].at);
    c.centroids.push_back(glm::clamp(c.bases.back() + grown.trees[i].measures.crown_centroid, Vec2(0.0f), size));
  }
  return c;
}

// Which stages of the model are on.
scene::GrowOptions stages(bool regions, bool asymmetry, bool light) {
  scene::GrowOptions options;
  options.regions = regions, options.asymmetry = asymmetry, options.light = light;
  return options;
}
const scene::GrowOptions kUnconstrained = stages(false, false, false), kConstrained = stages(true, false, false),
                         kAsymmetric = stages(true, true, false), kShaded = stages(true, true, true);

// K(t) - pi t^2 by the source's estimator.
double excess(const std::vector<Vec2>& points, Vec2 size) {
  const std::vector<double> t{kSearchRadius_m};
  return distribution::ripley_k_plain(points, Box2{Vec2(0.0f), size}, t)[0] -
         std::numbers::pi * kSearchRadius_m * kSearchRadius_m;
}

struct Sample {
  double bases = 0, unconstrained = 0, constrained = 0, asymmetric = 0;
};
Sample sample(std::uint64_t seed, float asymmetry_max) {
  const scene::Document document = clustered_sample(seed, asymmetry_max);
  const Vec2 size = document.terrain->size_m();
  const auto crowns = [&](const scene::GrowOptions& o) { return excess(centroids(grow(document, o)).centroids, size); };
  Sample s;
  s.constrained = crowns(kConstrained);
  s.asymmetric = crowns(kAsymmetric);
  s.unconstrained = crowns(kUnconstrained);
  std::vector<Vec2> bases;
  for (const scene::Tree& tree : *document.trees) bases.push_back(tree.at);
  s.bases = excess(bases, size);
  return s;
}

std::string uniformity() {
  constexpr int kSeeds = 20, kShown = 5;
  std::string out =
      "| sample | bases | crowns, unconstrained | constrained | constrained + asymmetry |\n|---|---|---|---|---|\n";
  std::map<float, std::vector<Sample>> all;
  for (const float cap : {1.0f, 0.35f})
    for (int seed = 1; seed <= kSeeds; ++seed) all[cap].push_back(sample(static_cast<std::uint64_t>(seed), cap));
  const auto row = [](const std::string& name, const Sample& s) {
    return fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name, s.bases, s.unconstrained, s.constrained,
                       s.asymmetric);
  };
  for (int n = 0; n < kShown; ++n) out += row(fmt::format("{}", n + 1), all[1.0f][static_cast<std::size_t>(n)]);
  Sample mean;
  for (const Sample& s : all[1.0f]) {
    mean.bases += s.bases / kSeeds, mean.unconstrained += s.unconstrained / kSeeds;
    mean.constrained += s.constrained / kSeeds, mean.asymmetric += s.asymmetric / kSeeds;
  }
  out += row(fmt::format("mean of {}", kSeeds), mean);

  out += fmt::format("\n| seeds 1 to {} | K smaller in | needed | |\n|---|---|---|---|\n", kSeeds);
  const auto test = [&](const std::string& claim, float cap, const auto& holds) {
    const auto n = std::count_if(all[cap].begin(), all[cap].end(), holds);
    out += fmt::format("| {} | {} of {} | 16 | {} |\n", claim, n, kSeeds, n >= 16 ? "holds" : "**fails**");
  };
  test("crowns, constrained, against bases", 1.0f, [](const Sample& s) { return s.constrained < s.bases; });
  test("constrained + asymmetry against constrained", 1.0f,
       [](const Sample& s) { return s.asymmetric < s.constrained; });
  test("constrained + asymmetry against bases", 1.0f, [](const Sample& s) { return s.asymmetric < s.bases; });
  test("the same two with asymmetry_max = 0.35: against constrained", 0.35f,
       [](const Sample& s) { return s.asymmetric < s.constrained; });
  test("constrained against unconstrained", 1.0f, [](const Sample& s) { return s.constrained < s.unconstrained; });
  return out;
}

// ----------------------------------------------------------------------------------------------------- Lansing Woods

std::string lansing() {
  auto recipe = value(exchange::read_recipe(BOSQUET_SOURCE_DIR "/examples/lansing_woods.toml"));
  const scene::Document document = value(exchange::build_document(recipe)).document;
  const Vec2 size = document.terrain->size_m();
  const Box2 window{Vec2(0.0f), size};
  const std::vector<double> t{2, 3, 5, 10};
  std::string out = "| K(t) - pi t^2, m2, isotropic |";
  for (const double m : t) out += fmt::format(" t = {} m |", m);
  out += " plain, t = 5 m |\n|---|---|---|---|---|---|\n";
  const auto row = [&](const std::string& name, const std::vector<Vec2>& points) {
    out += fmt::format("| {} |", name);
    const auto k = distribution::ripley_k(points, window, t);
    for (std::size_t n = 0; n < t.size(); ++n) out += fmt::format(" {:.2f} |", k[n] - std::numbers::pi * t[n] * t[n]);
    out += fmt::format(" {:.2f} |\n", excess(points, size));
  };
  std::vector<Vec2> bases;
  for (const scene::Tree& tree : *document.trees) bases.push_back(tree.at);
  row("bases", bases);
  for (const auto& [name, options] : {std::pair{"crowns, unconstrained", kUnconstrained},
                                      {"constrained", kConstrained},
                                      {"constrained + asymmetry", kAsymmetric},
                                      {"constrained + asymmetry + canopy light", kShaded}})
    row(name, centroids(grow(document, options)).centroids);
  return out;
}

// -------------------------------------------------------------------------------------- crown bases in closed stands

// What stands with a mean trunk of 30 cm and a height of 25 m measure.
struct YieldModel {
  const char* species;
  double open_crown_m;   // C of an open-grown tree with D 30 (Hasenauer 1997), for the crown competition factor
  double stand_crown_m;  // C in a stand (TreeGrOSS, north-west Germany)
  double crown_base_m;   // the same
  double ratio[2];       // crown ratio at CCF 200 and 400 (Hasenauer and Monserud 1996)
};
constexpr YieldModel kModels[] = {
    {"english_oak", 8.1, 6.1, 16, {0.52, 0.48}},     {"silver_birch", 8.2, 5.5, 12.5, {0.54, 0.51}},
    {"norway_spruce", 6.5, 4.5, 14, {0.53, 0.46}},   {"scots_pine", 7.0, 4.7, 18, {0.31, 0.28}},
    {"european_beech", 10.3, 6.6, 13, {0.66, 0.60}}, {"norway_maple", 9.2, 0, 14, {0.54, 0.51}},
    {"small_leaved_lime", 7.2, 0, 0, {0.54, 0.51}},
};

// A square stand of one species: a jittered grid at the crown competition factor asked for, heights within 10 %.
scene::Document closed_stand(const YieldModel& model, double ccf) {
  constexpr float kSide = 50.0f, kHeight = 25.0f, kTrunk = 0.30f;
  scene::Document document =
      value(exchange::build_document(value(exchange::parse_recipe(
                fmt::format("[site]\nsize_m = [{0}, {0}]\nseed = 9\n[asymmetry]\nasymmetry_max = 0.35\n", kSide),
                "stand"))))
          .document;
  auto species = std::make_shared<const scene::Species>(value(scene::builtin_species(model.species)));
  document.species = std::vector<std::shared_ptr<const scene::Species>>(1, std::move(species));
  const double crown_area = 0.25 * std::numbers::pi * model.open_crown_m * model.open_crown_m;
  const auto spacing = static_cast<float>(std::sqrt(100.0 * crown_area / ccf));
  const int rows = static_cast<int>(kSide / spacing);
  std::vector<scene::Tree> trees;
  for (int n = 0; n < rows * rows; ++n) {
    RandomStream draw(9, static_cast<std::uint64_t>(n), Purpose::planting);
    scene::Tree tree;
    tree.id = n + 1;
    tree.key = mix_bits(static_cast<std::uint64_t>(n) + 1);
    const Vec2 place(static_cast<float>(n % rows) + 0.5f, static_cast<float>(n / rows) + 0.5f);
    const float east = draw.uniform(-0.25f, 0.25f), north = draw.uniform(-0.25f, 0.25f);
    tree.at = (place + Vec2(east, north)) * (kSide / static_cast<float>(rows));
    const float size = draw.uniform(0.9f, 1.1f);
    scene::set_measured_size(tree, *document.species[0], kHeight * size, kTrunk * size, {});
    trees.push_back(tree);
  }
  document.trees = std::make_shared<const scene::Trees>(std::move(trees));
  return document;
}

struct StandMeasures {
  int trees = 0;
  double height = 0, crown = 0, base = 0, limb = 0, edge_base = 0;
};
StandMeasures measure_stand(const scene::Document& document, bool light) {
  const scene::GrownScene grown = grow(document, stages(true, true, light));
  constexpr float kInside = 13.0f;  // from the stand's edge on
  const Vec2 size = document.terrain->size_m();
  StandMeasures m;
  int at_edge = 0;
  for (std::size_t i = 0; i < grown.trees.size(); ++i) {
    const Vec2 at = (*document.trees)[i].at;
    const growth::Measures& tree = grown.trees[i].measures;
    const float inside = std::min({at.x, at.y, size.x - at.x, size.y - at.y});
    if (inside < 4.0f) ++at_edge, m.edge_base += tree.crown_base_m;
    if (inside < kInside) continue;
    ++m.trees, m.height += tree.height_m, m.crown += tree.crown_diameter_m;
    m.base += tree.crown_base_m, m.limb += tree.lowest_limb_m;
  }
  m.edge_base /= std::max(1, at_edge);
  for (double* sum : {&m.height, &m.crown, &m.base, &m.limb}) *sum /= std::max(1, m.trees);
  return m;
}

std::string crown_bases() {
  std::string out =
      "| species | CCF | light | inner trees | height m | crown base m | lowest limb m | crown ratio | model's ratio | "
      "model's base m | crown width m | model's m | base at the edge m "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const YieldModel& model : kModels) {
    if (!scene::builtin_species(model.species)) continue;
    for (const double ccf : {200.0, 300.0, 400.0}) {
      const scene::Document document = closed_stand(model, ccf);
      for (const bool light : {true, false}) {
        const StandMeasures m = measure_stand(document, light);
        const double ratio = model.ratio[0] + (model.ratio[1] - model.ratio[0]) * (ccf - 200) / 200;
        const auto told = [](double v, int digits) {
          return v > 0 ? fmt::format("{:.{}f}", v, digits) : std::string("-");
        };
        out += fmt::format(
            "| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {} | {:.1f} | {} | {:.1f} |\n",
            model.species, ccf, light ? "on" : "off", m.trees, m.height, m.base, m.limb, 1.0 - m.base / m.height, ratio,
            told(model.crown_base_m, 1), m.crown, told(model.stand_crown_m, 1), m.edge_base);
      }
    }
  }
  return out;
}

// ---------------------------------------------------------------------------------- what lower thresholds would do

std::string thresholds() {
  constexpr double kCcf = 300.0;
  const std::vector<std::pair<const char*, std::vector<float>>> trials{
      {"english_oak", {0.15f}},    {"silver_birch", {0.1f}}, {"norway_spruce", {0.5f}},
      {"european_beech", {0.07f}}, {"norway_maple", {0.1f}}, {"small_leaved_lime", {0.1f}}};
  std::string out =
      "| species | shedding_threshold | crown base m | crown ratio | model's ratio | crown width m | in the open: "
      "crown "
      "base m | crown width m |\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& [name, values] : trials) {
    const auto* model = std::find_if(std::begin(kModels), std::end(kModels),
                                     [&](const YieldModel& m) { return name == std::string(m.species); });
    scene::Document stand = closed_stand(*model, kCcf);
    const scene::Species own = *stand.species[0];
    std::vector<float> tried{own.growth.shedding_threshold};
    tried.insert(tried.end(), values.begin(), values.end());
    for (const float threshold : tried) {
      scene::Species species = own;
      species.growth.shedding_threshold = threshold;
      stand.species =
          std::vector<std::shared_ptr<const scene::Species>>(1, std::make_shared<const scene::Species>(species));
      const StandMeasures m = measure_stand(stand, true);

      // Five trees of full size in the open, one after the other.
      constexpr int kLone = 5;
      double base = 0, crown = 0;
      for (int n = 0; n < kLone; ++n) {
        scene::Document lone = stand;
        scene::Tree tree;
        tree.id = 1;
        tree.key = mix_bits(static_cast<std::uint64_t>(n) + 77);
        tree.at = 0.5f * lone.terrain->size_m();
        lone.trees = std::make_shared<const scene::Trees>(std::vector{tree});
        const growth::Measures measures = grow(lone, kShaded).trees[0].measures;
        base += measures.crown_base_m / kLone, crown += measures.crown_diameter_m / kLone;
      }
      out += fmt::format("| {} | {:g}{} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} |\n", name, threshold,
                         threshold == own.growth.shedding_threshold ? " (its own)" : "", m.base,
                         1.0 - m.base / m.height, 0.5 * (model->ratio[0] + model->ratio[1]), m.crown, base, crown);
    }
  }
  return out;
}

// --------------------------------------------------------------------------------------------------------- the page

const std::vector<std::pair<std::string, std::function<std::string()>>> kTables{
    {"kernel_effects", bosquet::kernel_effects},
    {"lansing_planted", bosquet::lansing_planted},
    {"uniformity", uniformity},
    {"lansing", lansing},
    {"crown_bases", crown_bases},
    {"thresholds", thresholds}};

// Puts a table between its marks.
void insert(std::string& page, const std::string& name, const std::string& table) {
  const std::string from = fmt::format("<!-- {} -->\n", name), to = fmt::format("<!-- /{} -->", name);
  const std::size_t begin = page.find(from), end = page.find(to);
  if (begin == std::string::npos || end == std::string::npos) fail(fmt::format("the page has no marks '{}'", name));
  page.replace(begin + from.size(), end - begin - from.size(), table);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::string file;
  if (!words.empty() && words[0].ends_with(".md")) file = words[0], words.erase(words.begin());
  std::string page;
  if (!file.empty()) {
    std::ifstream in(file);
    page.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) fail(file + " cannot be read");
  }
  for (const std::string& word : words)
    if (std::none_of(kTables.begin(), kTables.end(), [&](const auto& t) { return t.first == word; }))
      fail(fmt::format("no table is named '{}'", word));
  for (const auto& [name, make] : kTables) {
    if (!words.empty() && std::find(words.begin(), words.end(), name) == words.end()) continue;
    const std::string table = make();
    if (file.empty())
      fmt::print("## {}\n\n{}\n", name, table), std::fflush(stdout);
    else
      insert(page, name, table);
  }
  if (!file.empty() && !(std::ofstream(file) << page)) fail(file + " cannot be written");
}
