// Number text: numbers as people and spreadsheets write them.
//
// Model     decimal point or comma, thousands parted by blanks, apostrophes, points or commas, a unit of length behind.
//           Of point and comma the one that comes last is the decimal mark; one that comes more than once parts
//           thousands; a lone comma is the decimal mark when the file's numbers have it, or when other than three digits
//           follow it. "1.234" among numbers like "2,5", and "1,234" among numbers like "2.5", may be either: they are
//           doubtful, and not read
// Holds     the same in every locale; only finite numbers are read
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace bosquet::exchange {

enum class NumberReading { number, missing, text, doubtful };

/// What the numbers around one tell of a lone mark that three digits follow.
struct NumberMarks {
  bool decimal_comma = false;   ///< a lone comma is the decimal mark
  bool point_doubtful = false;  ///< a point before three digits may part thousands
  bool comma_doubtful = false;  ///< a comma likewise
};

struct NumberText {
  NumberReading reading = NumberReading::missing;
  double value = 0;
  std::optional<double> metres;  ///< of the unit that stood behind it
};

NumberText read_number(std::string_view text, const NumberMarks& marks);

/// The decimal marks seen in a column, to tell its doubtful numbers.
struct SeenMarks {
  std::size_t commas = 0;        ///< lone commas that may be decimal marks
  std::size_t clear_commas = 0;  ///< those that cannot part thousands
  std::size_t clear_points = 0;  ///< likewise

  void look(std::string_view text);
};

/// `column` as it was seen, in a file whose columns were seen as `all` together.
NumberMarks marks_of(const SeenMarks& column, const SeenMarks& all, bool decimal_comma);

}  // namespace bosquet::exchange
