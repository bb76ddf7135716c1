// Number text: numbers as people and spreadsheets write them.
//
// Model     decimal point or comma, thousands parted by blanks, apostrophes, points or commas, a unit of length behind.
//           Of point and comma the one that comes last is the decimal mark; one that comes more than once parts
//           thousands; a lone comma is the decimal mark when the file's numbers have it, or when other than three digits
//           follow it
// Holds     the same in every locale; only finite numbers are read
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bosquet::exchange {

enum class NumberReading { number, missing, text };

struct NumberText {
  NumberReading reading = NumberReading::missing;
  double value = 0;
  std::optional<double> metres;  ///< of the unit that stood behind it
};

NumberText read_number(std::string_view text, bool decimal_comma);

}  // namespace bosquet::exchange
