// Sample trees: the growth parameters and statistics that the growth tests share.
#pragma once

#include <cmath>
#include <vector>

#include "growth/grow.h"
#include "growth/parameters.h"

namespace bosquet::growth {

/// A small broad-leaved tree that shows every claim: 12 m, about 1,000 internodes.
inline Parameters sample_parameters() {
  Parameters p;
  p.internode_length_m = 0.25f;
  p.occupancy_radius = 2.5f, p.perception_depth = 2.5f;
  p.apical_dominance = 0.5f, p.light_sensitivity = 1.0f;
  p.straightness = 0.4f, p.tropism = 0.2f, p.space = 0.4f;
  p.set_point_angle_deg = 50.0f, p.branching_angle_deg = 50.0f;
  return p;
}

inline GrowthInput sample_input(const Parameters& p, std::uint64_t seed, float height_m = 12.0f) {
  GrowthInput input;
  input.parameters = &p;
  input.max_height_m = height_m;
  input.seed = seed, input.key = 42;
  return input;
}

struct Sample {
  std::vector<double> values;
  void add(double v) { values.push_back(v); }
  double mean() const {
    double sum = 0;
    for (double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  /// Of the mean.
  double standard_error() const {
    const double m = mean();
    double sum = 0;
    for (double v : values) sum += (v - m) * (v - m);
    const auto n = static_cast<double>(values.size());
    return std::sqrt(sum / (n - 1) / n);
  }
};

/// Difference of two independent means in its standard errors.
inline double difference_in_errors(const Sample& low, const Sample& high) {
  const double a = low.standard_error(), b = high.standard_error();
  return (high.mean() - low.mean()) / std::sqrt(a * a + b * b);
}

}  // namespace bosquet::growth
