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

}  // namespace

NumberText read_number(std::string_view text, bool decimal_comma) {
  NumberText out;
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
  const auto number = with_point(folded, decimal_comma);
  if (number && !number->empty() && plain_number(*number, out.value)) out.reading = NumberReading::number;
  return out;
}

}  // namespace bosquet::exchange
