// CSV: rows of fields from text (RFC 4180), tolerant of what spreadsheets write.
//
// Format    fields parted by `separator`, rows by LF, CRLF or CR; a field may be quoted, then "" is a quote and line
//           breaks belong to it; blanks around an unquoted field are dropped; rows without any text are skipped
// Decision  a quote that is never closed, or whose closing quote stands in a later line with text right behind it (it
//           opened a field there), ends with its own line: it costs one row, not all that follow
// Holds     reading never fails; the cost is linear but for fields of up to kLongestField bytes
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bosquet::exchange {

class CsvReader {
 public:
  static constexpr std::size_t kLongestField = 1 << 16;  ///< of a quoted one; a longer one was never closed

  CsvReader(std::string_view text, char separator) : text_(text), separator_(separator) {}

  /// The next row's fields, or false at the end. `fields` is overwritten.
  bool next(std::vector<std::string>& fields);

  /// Where the row read last begins; the first line is 1.
  int line() const { return row_line_; }
  /// The row read last has a quote that is not closed.
  bool unclosed_quote() const { return unclosed_; }

 private:
  void read_field(std::string& field);
  bool read_quoted(std::string& field);

  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  int line_ = 1, row_line_ = 0;
  bool unclosed_ = false;
};

/// The commonest of , ; and tab outside quotes in the first line; a comma when there is none.
char guess_separator(std::string_view text);

}  // namespace bosquet::exchange
