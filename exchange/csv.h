// CSV: rows of fields from text (RFC 4180), tolerant of what spreadsheets write.
//
// Format    fields parted by `separator`, rows by LF, CRLF or CR; a field may be quoted, then "" is a quote and line
//           breaks belong to it; blanks around an unquoted field are dropped; rows without any text are skipped
// Holds     reading never fails: a quote that is not closed ends with the text
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bosquet::exchange {

class CsvReader {
 public:
  CsvReader(std::string_view text, char separator) : text_(text), separator_(separator) {}

  /// The next row's fields, or false at the end. `fields` is overwritten.
  bool next(std::vector<std::string>& fields);

  /// Where the row read last begins; the first line is 1.
  int line() const { return row_line_; }

 private:
  void read_field(std::string& field);

  std::string_view text_;
  char separator_;
  std::size_t at_ = 0;
  int line_ = 1, row_line_ = 0;
};

/// The commonest of , ; and tab outside quotes in the first line; a comma when there is none.
char guess_separator(std::string_view text);

}  // namespace bosquet::exchange
