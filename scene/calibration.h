// Calibration: what free-standing trees of a species become, beside what its file says of them.
//
// Model     trees of `trees` seeds stand alone, without crown region, asymmetry or others' light, and stop at
//           mature_height_m, which is given. What emerges is measured: crown base T_h, crown width C_w and trunk width of
//           [shape], and crown and trunk at the ages of the [[size]] rows.
// Model     the pipe exponent n makes the mean trunk at 1.3 m what the last [[size]] row asks: mean d_e M^(1/n) = D with
//           M pipes at breast height (growth/radii.h), falling in n, solved by bisection
// Model     g and p of the age curve H_mature (1 - exp(-g t))^p: least squares of the rows' relative height errors
// Decision  mature_height_m is the height that growth ends at, not the tree's at 100 years: give a few per cent more than
//           the last row's height, or the curve cannot reach it; a curve that stands still long before also fits badly
// Decision  a mean size may miss its row by 20 % from 45 years on, by 30 % from 20 on; younger trees are reported
// Decision  other details are measured on the first few trees, beside the same ones at detail 1: they show that n and
//           silhouette hold, and are not written
// Units     metres; [[size]] rows give trunks in cm, as tables of trees do
// Errors    cancelled (kind cannot_finish); a species text in which a number's place cannot be found
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "growth/measure.h"
#include "scene/species.h"

namespace bosquet::scene {

struct CalibrationOptions {
  int trees = 20;
  bool other_details = true;  ///< measure detail 0.5 and 2 too
};

/// Exponents outside these make a tree whose twigs or trunk are wrong.
inline constexpr float kLeastExponent = 1.7f, kGreatestExponent = 2.6f;

/// How far a mean may be from its row at this age, as a share; nothing: only reported.
std::optional<float> allowed_deviation(float age_years);

/// The trees at one age.
struct AgeMeasures {
  float age_years = 0;
  std::optional<OpenGrownSize> target;  ///< the file's row; missing when the file has none
  growth::Measures mean;                ///< trunk with the calibrated exponent
  float trunk_of_file_m = 0;            ///< with the file's exponent
  float season = 0;
};

/// Mature trees at another detail, as shares of what the same trees are at detail 1.
struct DetailMeasures {
  float detail = 1;
  float crown_width = 1, crown_base = 1;
  std::optional<float> pipe_exponent;  ///< that makes the trunks they have at detail 1 with the calibrated one
};

struct Calibration {
  std::vector<AgeMeasures> ages;  ///< of the [[size]] rows, or 10, 30, 60 and 100 years
  growth::Measures mature;        ///< trunk with the calibrated exponent
  float trunk_of_file_m = 0;      ///< mature, with the file's exponent
  float crown_spread = 0;         ///< standard deviation of the mature crown width over its mean
  float seasons = 0;
  float pipe_exponent = 2;                    ///< solved, or the file's when it has no [[size]] rows
  bool exponent_solved = false;               ///< some exponent from 1.1 to 4 makes the trunk
  std::vector<DetailMeasures> other_details;  ///< 0.5 and 2
  std::optional<growth::Parameters> fitted;   ///< the species' with fitted age_rate_per_year and age_shape
  double milliseconds = 0;                    ///< to grow one tree on one core, median
};

Result<Calibration> calibrate(const Species& species, const CalibrationOptions& options, Progress* progress = nullptr);

/// A species file's text with the measured numbers in [shape] trunk_height_m, crown_width_m and trunk_width_m and in
/// [growth] pipe_exponent; everything else stays as it is, comments and layout too.
Result<std::string> calibrated_text(std::string_view text, const Calibration& calibration);

/// `text` with `table`.`key` = `value`; a key that is missing is added behind the table's header.
Result<std::string> with_number(std::string_view text, std::string_view table, std::string_view key,
                                std::string_view value);

}  // namespace bosquet::scene
