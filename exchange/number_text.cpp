#include "exchange/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/letters.h"
#include "exchange/inventory_columns.h"

namespace bosquet::exchange {
namespace {

// Words for "not measured" in real inventories.
bool means_missing(std::string_view text) {
  if (text.empty()) return true;
  if (text.size() > 16) return false;
  const std::string word = folded_letters(text);
  for (const char* known :
       {"na", "n/a", "null", "none", "nan", "-", "--", "?", "unknown", "unbekannt", "k.a.", "inconnu"})
    if (word == known) return true;
  return false;
}

bool digit(char c) { return c >= '0' && c <= '9'; }

// The usual case: a plain number with a point.
bool plain_number(std::string_view text, double& value) {
  const char *begin = text.data(), *end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [stop, failed] = std::from_chars(begin, end, value);
  return failed == std::errc() && stop == end && std::isfinite(value);
}

// Decimal mark and thousands' marks as from_chars wants them; nothing when they make no sense.
std::optional<std::string> with_point(std::string_view text, bool decimal_comma) {
  const auto points = std::count(text.begin(), text.end(), '.'), commas = std::count(text.begin(), text.end(), ',');
  const auto point = text.rfind('.'), comma = text.rfind(',');
  char decimal = 0;
  if (points && commas)
    decimal = point > comma ? '.' : ',';
  else if (points == 1)
    decimal = '.';
  else if (commas == 1 && (decimal_comma || text.size() - comma - 1 != 3))
    decimal = ',';
  else if (commas == 1)
    return {};  // 1,234 is two numbers
  if (decimal && std::count(text.begin(), text.end(), decimal) > 1) return {};
  std::string out;
  int since_mark = -1;  // digits behind the last thousands' mark
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == decimal) {
      if (since_mark >= 0 && since_mark != 3) return {};
      since_mark = -1;
      out += '.';
    } else if (c == '.' || c == ',' || c == '\'' || c == ' ') {
      if (i == 0 || !digit(text[i - 1]) || (since_mark >= 0 && since_mark != 3)) return {};
      since_mark = 0;
    } else {
      if (since_mark >= 0 && digit(c)) ++since_mark;
      out += c;
    }
  }
  if (since_mark >= 0 && since_mark != 3) return {};
  return out;
}

// One mark between one to three digits and exactly three, which may part thousands: the mark, else 0.
char thousands_like_mark(std::string_view text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  const auto at = text.find_first_of(".,");
  if (at == std::string_view::npos || at < 1 || at > 3 || text[0] == '0') return 0;
  std::size_t end = at + 1;
  while (end < text.size() && digit(text[end])) ++end;
  const bool digits = std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), digit);
  const bool ends = end == text.size() || (text[end] != '.' && text[end] != ',' && text[end] != '\'');
  return digits && end == at + 4 && ends ? text[at] : 0;
}

}  // namespace

void SeenMarks::look(std::string_view text) {
  const auto mark = text.find_first_of(".,");
  if (mark == std::string_view::npos || mark == 0 || !digit(text[mark - 1])) return;
  const auto last = text.find_last_of(".,");
  if (std::count(text.begin(), text.end(), text[last]) > 1) return;  // it parts thousands
  if (last + 1 >= text.size() || !digit(text[last + 1])) return;
  const bool clear = thousands_like_mark(text) == 0;
  if (text[last] == ',') ++commas, clear_commas += clear;
  if (text[last] == '.') clear_points += clear;
}

NumberMarks marks_of(const SeenMarks& column, const SeenMarks& all, bool decimal_comma) {
  // A column's own numbers tell more than those of others.
  const bool own_points = column.clear_points > 0 && column.clear_commas == 0;
  const bool own_commas = column.clear_commas > 0 && column.clear_points == 0;
  NumberMarks marks{decimal_comma, false, false};
  marks.point_doubtful = !own_points && (decimal_comma ? all.commas > 0 : all.clear_commas > 0);
  marks.comma_doubtful = !own_commas && (column.clear_points > 0 || (all.clear_points > 0 && all.clear_commas == 0));
  return marks;
}

NumberText read_number(std::string_view text, const NumberMarks& marks) {
  NumberText out;
  if (marks.point_doubtful || marks.comma_doubtful)
    if (const char mark = thousands_like_mark(text);
        (mark == '.' && marks.point_doubtful) || (mark == ',' && marks.comma_doubtful)) {
      out.reading = NumberReading::doubtful;
      return out;
    }
  if (plain_number(text, out.value)) {
    out.reading = NumberReading::number;
    return out;
  }
  if (means_missing(text)) return out;
  out.reading = NumberReading::text;

  std::string folded = folded_letters(text);
  std::size_t end = folded.size();
  while (end > 0 &&
         ((folded[end - 1] >= 'a' && folded[end - 1] <= 'z') || folded[end - 1] == '"' || folded[end - 1] == '\''))
    --end;
  if (end < folded.size()) {
    std::string unit = folded.substr(end);
    if (unit == "\"") unit = "in";
    if (unit == "'") unit = "ft";
    out.metres = metres_of_unit(unit);
    if (!out.metres) return out;
    folded.resize(end);
  }
  while (!folded.empty() && folded.back() == ' ') folded.pop_back();
  const auto number = with_point(folded, marks.decimal_comma);
  if (number && !number->empty() && plain_number(*number, out.value)) out.reading = NumberReading::number;
  return out;
}

}  // namespace bosquet::exchange
