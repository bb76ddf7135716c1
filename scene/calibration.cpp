#include "scene/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/scalar.h"
#include "core/stopwatch.h"
#include "growth/age.h"
#include "growth/grow.h"
#include "growth/radii.h"

namespace bosquet::scene {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::array<float, 4> kAges{10.0f, 30.0f, 60.0f, 100.0f};
constexpr std::array<float, 2> kOtherDetails{0.5f, 2.0f};
constexpr int kTreesOfOtherDetails = 6;
constexpr float kLeastN = 1.1f, kGreatestN = 4.0f;  // as pipe_exponent's range

// One tree as it stood at one time. Its trunk is kept as pipes, so that any exponent can be tried.
struct Moment {
  growth::Measures measures;
  int season = 0;
  float pipes = 0, tip_m = 0;

  float trunk_m(float exponent) const { return tip_m * pow(pipes, 1.0f / exponent); }
};
using Life = std::vector<Moment>;  // at each age, then mature

Moment moment(growth::Skeleton& skeleton, std::optional<int> season) {
  Moment m;
  m.season = season.value_or(skeleton.seasons);
  m.measures = growth::measure(skeleton, season.value_or(-1));
  m.tip_m = skeleton.tip_diameter_m;
  if (const int at = growth::breast_height_internode(skeleton); at >= 0) {
    // With the exponent 1 a diameter in tips is the number of pipes.
    const float exponent = std::exchange(skeleton.pipe_exponent, 1.0f);
    m.pipes =
        2.0f * growth::radii(skeleton, season.value_or(-1))[static_cast<std::size_t>(at)] / skeleton.tip_diameter_m;
    skeleton.pipe_exponent = exponent;
  }
  return m;
}

Life grow_alone(const Species& species, float detail, std::uint64_t key, const std::vector<float>& ages,
                const Progress* progress, double& seconds) {
  growth::GrowthInput input;
  input.parameters = &species.growth;
  input.max_height_m = species.shape.mature_height_m;
  input.detail = detail;
  input.seed = kSeed;
  input.key = key;
  Stopwatch watch;
  growth::Skeleton skeleton = growth::grow(input, progress);
  seconds = watch.seconds();
  Life life;
  for (float age : ages) {
    const float height = growth::height_share_at_age(species.growth, age) * species.shape.mature_height_m;
    life.push_back(moment(skeleton, growth::season_at_height(skeleton, height)));
  }
  life.push_back(moment(skeleton, {}));
  return life;
}

struct Stand {
  std::vector<Life> lives;
  double milliseconds = 0;

  template <class Value>
  float mean(std::size_t age, const Value& value) const {
    float sum = 0.0f;
    for (const Life& life : lives) sum += value(life[age]);
    return sum / static_cast<float>(lives.size());
  }
  float mean_trunk(std::size_t age, float exponent) const {
    return mean(age, [&](const Moment& m) { return m.trunk_m(exponent); });
  }
};

Stand grow_stand(const Species& species, float detail, int trees, const std::vector<float>& ages, Progress* progress) {
  const auto n = static_cast<std::size_t>(trees);
  Stand stand;
  stand.lives.resize(n);
  std::vector<double> seconds(n);
  parallel_for(n, [&](std::size_t i) {
    if (progress && progress->cancelled()) return;
    stand.lives[i] = grow_alone(species, detail, i + 1, ages, progress, seconds[i]);
    if (progress) progress->advance();
  });
  std::nth_element(seconds.begin(), seconds.begin() + trees / 2, seconds.end());
  stand.milliseconds = 1000.0 * seconds[n / 2];
  return stand;
}

growth::Measures mean_measures(const Stand& stand, std::size_t age, float exponent) {
  const auto mean = [&](float growth::Measures::*member) {
    return stand.mean(age, [&](const Moment& m) { return m.measures.*member; });
  };
  growth::Measures m;
  m.height_m = mean(&growth::Measures::height_m);
  m.crown_diameter_m = mean(&growth::Measures::crown_diameter_m);
  m.crown_base_m = mean(&growth::Measures::crown_base_m);
  m.lowest_limb_m = mean(&growth::Measures::lowest_limb_m);
  m.widest_point = mean(&growth::Measures::widest_point);
  m.trunk_diameter_m = stand.mean_trunk(age, exponent);
  m.internodes = static_cast<int>(
      stand.mean(age, [](const Moment& one) { return static_cast<float>(one.measures.internodes); }) + 0.5f);
  return m;
}

// The mean trunk falls as n rises.
std::optional<float> solve_mean_trunk(const Stand& stand, std::size_t age, float trunk_m) {
  if (stand.mean_trunk(age, kLeastN) < trunk_m || stand.mean_trunk(age, kGreatestN) > trunk_m) return {};
  float low = kLeastN, high = kGreatestN;
  for (int step = 0; step < 24; ++step) {
    const float middle = 0.5f * (low + high);
    (stand.mean_trunk(age, middle) > trunk_m ? low : high) = middle;
  }
  return 0.5f * (low + high);
}

// A pattern search from the file's numbers: two of them, and a smooth valley.
growth::Parameters fit_age_curve(const Species& species) {
  growth::Parameters p = species.growth;
  const auto error = [&](float rate, float shape) {
    p.age_rate_per_year = rate, p.age_shape = shape;
    float sum = 0.0f;
    for (const OpenGrownSize& row : species.sizes) {
      const float height = growth::height_share_at_age(p, row.age_years) * species.shape.mature_height_m;
      const float miss = height / row.height_m - 1.0f;
      sum += miss * miss;
    }
    return sum;
  };
  float rate = species.growth.age_rate_per_year, shape = species.growth.age_shape, best = error(rate, shape);
  for (float step = 0.5f; step > 1e-5f; step *= 0.5f) {
    for (bool better = true; better;) {
      better = false;
      // Along a valley that runs askew both must change at once.
      for (const auto& [a, b] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
        const float r = std::clamp(rate * (1.0f + step * static_cast<float>(a)), 0.001f, 1.0f);
        const float s = std::clamp(shape * (1.0f + step * static_cast<float>(b)), 0.2f, 4.0f);
        if (const float e = error(r, s); e < best) best = e, rate = r, shape = s, better = true;
      }
    }
  }
  p.age_rate_per_year = rate, p.age_shape = shape;
  return p;
}

}  // namespace

std::optional<float> allowed_deviation(float age_years) {
  if (age_years >= 45.0f) return 0.2f;
  if (age_years >= 20.0f) return 0.3f;
  return {};
}

Result<Calibration> calibrate(const Species& species, const CalibrationOptions& options, Progress* progress) {
  std::vector<float> ages;
  for (const OpenGrownSize& row : species.sizes) ages.push_back(row.age_years);
  if (ages.empty()) ages.assign(kAges.begin(), kAges.end());
  const std::size_t mature = ages.size();

  const int others = options.other_details ? std::min(options.trees, kTreesOfOtherDetails) : 0;
  if (progress)
    progress->begin("free-standing trees",
                    static_cast<std::size_t>(options.trees) + kOtherDetails.size() * static_cast<std::size_t>(others));
  const Stand stand = grow_stand(species, 1.0f, options.trees, ages, progress);
  const auto cancelled = [&] { return progress && progress->cancelled(); };
  if (cancelled()) return cannot_finish("cancelled; nothing was written");

  Calibration c;
  c.milliseconds = stand.milliseconds;
  c.pipe_exponent = species.growth.pipe_exponent;
  if (!species.sizes.empty()) {
    const auto n = solve_mean_trunk(stand, species.sizes.size() - 1, 0.01f * species.sizes.back().trunk_cm);
    c.exponent_solved = n.has_value();
    c.pipe_exponent = n.value_or(c.pipe_exponent);
    c.fitted = fit_age_curve(species);
  }
  const auto season = [&](std::size_t age) {
    return stand.mean(age, [](const Moment& m) { return static_cast<float>(m.season); });
  };
  for (std::size_t a = 0; a < ages.size(); ++a) {
    AgeMeasures at;
    at.age_years = ages[a];
    if (!species.sizes.empty()) at.target = species.sizes[a];
    at.mean = mean_measures(stand, a, c.pipe_exponent);
    at.trunk_of_file_m = stand.mean_trunk(a, species.growth.pipe_exponent);
    at.season = season(a);
    c.ages.push_back(at);
  }
  c.mature = mean_measures(stand, mature, c.pipe_exponent);
  c.trunk_of_file_m = stand.mean_trunk(mature, species.growth.pipe_exponent);
  c.seasons = season(mature);
  const float variance = stand.mean(mature, [&](const Moment& m) {
    const float off = m.measures.crown_diameter_m - c.mature.crown_diameter_m;
    return off * off;
  });
  c.crown_spread = std::sqrt(variance) / std::max(c.mature.crown_diameter_m, 1e-3f);

  const Stand same{{stand.lives.begin(), stand.lives.begin() + others}, 0.0};
  for (float detail : kOtherDetails) {
    if (others == 0) break;
    const Stand other = grow_stand(species, detail, others, ages, progress);
    if (cancelled()) return cannot_finish("cancelled; nothing was written");
    const growth::Measures now = mean_measures(other, mature, c.pipe_exponent),
                           before = mean_measures(same, mature, c.pipe_exponent);
    DetailMeasures d;
    d.detail = detail;
    d.crown_width = now.crown_diameter_m / std::max(before.crown_diameter_m, 1e-3f);
    d.crown_base = now.crown_base_m / std::max(before.crown_base_m, 1e-3f);
    if (c.exponent_solved)
      d.pipe_exponent = solve_mean_trunk(other, ages.size() - 1, same.mean_trunk(ages.size() - 1, c.pipe_exponent));
    c.other_details.push_back(d);
  }
  return c;
}

Result<std::string> with_number(std::string_view text, std::string_view table, std::string_view key,
                                std::string_view value) {
  const auto trimmed = [](std::string_view s) {
    const auto first = s.find_first_not_of(" \t\r");
    return first == s.npos ? std::string_view() : s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
  };
  const std::string header = fmt::format("[{}]", table);
  bool inside = false;
  std::size_t behind_header = text.npos;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    const std::string_view code = trimmed(line);
    if (code.starts_with('[')) {
      inside = trimmed(code.substr(0, code.find('#'))) == header;
      if (inside) behind_header = std::min(end + 1, text.size());
    } else if (const auto equals = line.find('='); inside && equals != line.npos && !code.starts_with('#')) {
      if (trimmed(line.substr(0, equals)) == key) {
        // From behind "= " to the comment or the end of the line; blanks stay.
        const std::size_t from = std::min(line.find_first_not_of(" \t", equals + 1), line.size());
        const std::size_t to = std::min(line.find_first_of(" \t\r#", from), line.size());
        return fmt::format("{}{}{}", text.substr(0, begin + from), value, text.substr(begin + to));
      }
    }
    begin = end + 1;
  }
  if (behind_header == text.npos)
    return Error{fmt::format("there is no table {} to write {} = {} into", header, key, value)};
  const bool whole_line = behind_header > 0 && text[behind_header - 1] == '\n';
  return fmt::format("{}{}{} = {}\n{}", text.substr(0, behind_header), whole_line ? "" : "\n", key, value,
                     text.substr(behind_header));
}

Result<std::string> calibrated_text(std::string_view text, const Calibration& c) {
  const auto rounded = [](double value, double step) { return fmt::format("{:g}", std::round(value / step) * step); };
  struct Number {
    std::string_view table, key;
    std::string value;
  };
  const growth::Measures& m = c.mature;
  std::string result(text);
  for (const Number& number :
       {Number{"shape", "trunk_width_m", rounded(static_cast<double>(m.trunk_diameter_m), 0.01)},
        Number{"shape", "trunk_height_m", rounded(static_cast<double>(m.crown_base_m), 0.1)},
        Number{"shape", "crown_width_m", rounded(static_cast<double>(m.crown_diameter_m), 0.1)},
        Number{"growth", "pipe_exponent", rounded(static_cast<double>(c.pipe_exponent), 0.001)}}) {
    auto next = with_number(result, number.table, number.key, number.value);
    if (!next) return next.error();
    result = std::move(*next);
  }
  return result;
}

}  // namespace bosquet::scene
