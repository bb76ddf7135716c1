#include "bench/planting_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "distribution/pattern.h"
#include "distribution/sowing.h"

namespace bosquet {
namespace {

using namespace distribution;
using Curve = std::vector<double>;
using Patterns = std::vector<std::vector<Vec2>>;  // of each species

constexpr int kSimulations = 199;

// A planting of the whole of a flat square site; only the shares of the species and their kernels count.
Patterns planted(float side_m, float cell_m, float min_spacing_m, const std::vector<std::string>& names,
                 const std::vector<std::size_t>& counts, const std::vector<Interaction>& interactions,
                 std::uint64_t seed) {
  std::vector<Species> species;
  Sowing what{.seed = seed, .block = 1, .first_index = 0, .mix = {}};
  std::size_t all = 0;
  for (std::size_t n = 0; n < names.size(); ++n) {
    species.push_back({names[n], 0.4f, {.min_spacing_m = min_spacing_m, .scale_min = 0.5f, .scale_max = 0.95f}});
    what.mix.push_back({static_cast<std::uint32_t>(n), static_cast<float>(counts[n])});
    all += counts[n];
  }
  const auto site = terrain::make_terrain(terrain::Heightfield(*terrain::make_lattice({side_m, side_m})));
  auto planting = Planting::make(site, species, interactions, cell_m);
  Patterns patterns(names.size());
  for (const StandingTree& tree : sow(*planting, what, Box2{Vec2(0.0f), Vec2(side_m)}, all).trees)
    patterns[tree.species].push_back(tree.at);
  return patterns;
}

// ---------------------------------------------------------------------------------------------- what kernels effect

constexpr float kSide_m = 60.0f;
constexpr std::size_t kTrees = 120;
const Box2 kWindow{Vec2(0.0f), Vec2(kSide_m)};
const Curve kDistances{2, 4, 6, 8};

// ------------------------------------------------------------------------------------------------------ Lansing Woods

constexpr float kLansing_m = 281.7f;
constexpr float kLansingCell_m = 1.0f;
constexpr std::uint64_t kTestSeed = 200'000;  // kernels were fitted with other seeds
const std::vector<std::string> kKinds{"hickory", "maple", "whiteoak", "redoak", "blackoak", "misc"};

// Fitted by a random search for the least sum of squared deviations of mean L from the wood's.
std::vector<Interaction> lansing_kernels() {
  constexpr auto draws = KernelKind::clustering, repels = KernelKind::inhibition;
  return {{"hickory", "hickory", draws, 45, 3.2f},       {"maple", "maple", draws, 24, 3},
          {"whiteoak", "whiteoak", draws, 16, 3},        {"redoak", "redoak", draws, 12, 3.5f},
          {"blackoak", "blackoak", draws, 21, 13},       {"misc", "misc", draws, 29, 35},
          {"hickory", "maple", repels, 90, 1.09f},       {"maple", "hickory", repels, 21, 2.5f},
          {"hickory", "whiteoak", repels, 11.5f, 1.13f}, {"whiteoak", "hickory", repels, 48, 1.2f},
          {"maple", "whiteoak", repels, 12, 1.34f},      {"whiteoak", "maple", repels, 6, 1.6f}};
}

Patterns lansing_woods() {
  std::ifstream file(BOSQUET_SOURCE_DIR "/examples/data/lansing_woods.csv");
  Patterns patterns(kKinds.size());
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream fields(line);
    std::string east, north, kind;
    std::getline(fields, east, ','), std::getline(fields, north, ','), std::getline(fields, kind);
    const auto found = std::find(kKinds.begin(), kKinds.end(), kind);
    if (found == kKinds.end()) std::abort();  // our own file
    patterns[static_cast<std::size_t>(found - kKinds.begin())].push_back({std::stof(east), std::stof(north)});
  }
  return patterns;
}

// L of the six kinds, then cross-L of the three commonest pairs.
std::vector<Curve> lansing_curves(const Patterns& patterns, const Curve& t) {
  const Box2 window{Vec2(0.0f), Vec2(kLansing_m)};
  std::vector<Curve> curves;
  for (const auto& points : patterns) curves.push_back(ripley_l(ripley_k(points, window, t)));
  for (const auto& [a, b] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 2u}})
    curves.push_back(ripley_l(cross_k(patterns[a], patterns[b], window, t)));
  return curves;
}

double largest_deviation(const Curve& curve, const Curve& mean) {
  double most = 0.0;
  for (std::size_t n = 0; n < curve.size(); ++n) most = std::max(most, std::abs(curve[n] - mean[n]));
  return most;
}

struct RankTest {
  Curve mean;                               // of the simulated
  double own = 0, median = 0, most_of = 0;  // D of the pattern, and of half and 95 % of the simulated
  double p = 0;
};
RankTest rank_test(const Curve& real, const std::vector<std::vector<Curve>>& simulated, std::size_t which) {
  RankTest test;
  test.mean.resize(real.size());
  Curve all(real.size());
  for (std::size_t n = 0; n < real.size(); ++n) {
    for (const auto& s : simulated) test.mean[n] += s[which][n] / kSimulations;
    all[n] = (test.mean[n] * kSimulations + real[n]) / (kSimulations + 1);
  }
  Curve deviations;
  for (const auto& s : simulated) deviations.push_back(largest_deviation(s[which], all));
  std::sort(deviations.begin(), deviations.end());
  test.own = largest_deviation(real, all);
  test.median = deviations[kSimulations / 2], test.most_of = deviations[kSimulations * 95 / 100];
  const auto as_far = std::count_if(deviations.begin(), deviations.end(), [&](double d) { return d >= test.own; });
  test.p = static_cast<double>(as_far + 1) / (kSimulations + 1);
  return test;
}

}  // namespace

std::string kernel_effects() {
  std::vector<Curve> random(kSimulations);
  parallel_for(kSimulations, [&](std::size_t run) {
    RandomStream stream(77, run, Purpose::statistics);
    std::vector<Vec2> points(kTrees);
    for (Vec2& p : points) p.x = stream.uniform(0, kSide_m), p.y = stream.uniform(0, kSide_m);
    random[run] = ripley_k(points, kWindow, kDistances);
  });
  std::string out = "| K(t) - pi t^2, m2, isotropic |";
  for (const double t : kDistances) out += fmt::format(" t = {} m |", t);
  out += "\n|---|---|---|---|---|\n";
  const auto row = [&](const std::string& name, const auto& cell) {
    out += fmt::format("| {} |", name);
    for (std::size_t n = 0; n < kDistances.size(); ++n) out += ' ' + cell(n) + " |";
    out += '\n';
  };
  const auto beyond_random = [&](std::size_t n, double k) {
    return k - std::numbers::pi * kDistances[n] * kDistances[n];
  };
  row(fmt::format("least and largest of {} random patterns", kSimulations), [&](std::size_t n) {
    const auto [low, high] =
        std::minmax_element(random.begin(), random.end(), [&](const Curve& a, const Curve& b) { return a[n] < b[n]; });
    return fmt::format("{:.1f} to {:.1f}", beyond_random(n, (*low)[n]), beyond_random(n, (*high)[n]));
  });
  const std::vector<Interaction> none, cluster{{"a", "a", KernelKind::clustering, 6, 20}},
      apart{{"a", "a", KernelKind::inhibition, 5, 100}},
      both{{"a", "a", KernelKind::clustering, 6, 20},
           {"b", "b", KernelKind::clustering, 6, 20},
           {"a", "b", KernelKind::inhibition, 6, 20},
           {"b", "a", KernelKind::inhibition, 6, 20}};
  const auto k_row = [&](const std::string& name, const Curve& k) {
    row(name, [&](std::size_t n) { return fmt::format("{:.1f}", beyond_random(n, k[n])); });
  };
  const auto one = [&](const std::vector<Interaction>& kernels) {
    return ripley_k(planted(kSide_m, 0.25f, 0.0f, {"a"}, {kTrees}, kernels, 1)[0], kWindow, kDistances);
  };
  const auto cross = [&](const std::vector<Interaction>& kernels) {
    const Patterns p = planted(kSide_m, 0.25f, 0.0f, {"a", "b"}, {kTrees, kTrees}, kernels, 1);
    return cross_k(p[0], p[1], kWindow, kDistances);
  };
  k_row("planted without kernels", one(none));
  k_row("clustering, 6 m, effect 20", one(cluster));
  k_row("inhibition of its own kind, 5 m, effect 100", one(apart));
  k_row("two species without kernels, cross-K", cross(none));
  k_row("both clustered, inhibiting each other, cross-K", cross(both));
  return out;
}

std::string lansing_planted() {
  Curve t;
  for (int m = 2; m <= 20; ++m) t.push_back(m);
  const Patterns wood = lansing_woods();
  std::vector<std::size_t> counts;
  for (const auto& points : wood) counts.push_back(points.size());
  const std::vector<Curve> real = lansing_curves(wood, t);
  const auto simulate = [&](const std::vector<Interaction>& kernels) {
    std::vector<std::vector<Curve>> simulated(kSimulations);
    parallel_for(kSimulations, [&](std::size_t run) {
      simulated[run] =
          lansing_curves(planted(kLansing_m, kLansingCell_m, 0.5f, kKinds, counts, kernels, kTestSeed + run), t);
    });
    return simulated;
  };
  const auto by_kernels = simulate(lansing_kernels()), at_random = simulate({});

  std::string out = "| of | on | kernel | active radius m | effect |\n|---|---|---|---|---|\n";
  for (const Interaction& i : lansing_kernels())
    out += fmt::format("| {} | {} | {} | {:g} | {:g} |\n", i.of, i.on,
                       kKernelKindNames[static_cast<std::size_t>(i.kind)], i.active_radius_m, i.effect);
  out +=
      "\n| L(t) - t, m: wood / mean of planted | t = 2 m | 5 m | 10 m | 20 m | D of the wood | median and 95 % of "
      "planted | "
      "p | | p without kernels |\n|---|---|---|---|---|---|---|---|---|---|\n";
  const std::array<const char*, 9> names{"hickory",          "maple", "whiteoak",         "redoak",
                                         "blackoak",         "misc",  "hickory on maple", "hickory on whiteoak",
                                         "maple on whiteoak"};
  for (std::size_t c = 0; c < names.size(); ++c) {
    const RankTest test = rank_test(real[c], by_kernels, c);
    out += fmt::format("| {} |", names[c]);
    for (const double m : {2.0, 5.0, 10.0, 20.0}) {
      const auto n = static_cast<std::size_t>(m - t.front());
      out += fmt::format(" {:.2f} / {:.2f} |", real[c][n] - t[n], test.mean[n] - t[n]);
    }
    out += fmt::format(" {:.2f} | {:.2f}, {:.2f} | {:.3f} | {} | {:.3f} |\n", test.own, test.median, test.most_of,
                       test.p, test.p >= 0.05 / 9 ? "holds" : "**fails**", rank_test(real[c], at_random, c).p);
  }
  return out;
}

}  // namespace bosquet
