#include "exchange/csv.h"

#include <algorithm>

namespace bosquet::exchange {
namespace {

bool blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

bool CsvReader::next(std::vector<std::string>& fields) {
  while (at_ < text_.size()) {
    std::size_t n = 0;
    bool any = false;
    row_line_ = line_;
    unclosed_ = false;
    // Strings are kept from row to row: a hundred thousand rows then need a handful of allocations.
    for (bool more = true; more;) {
      if (n == fields.size()) fields.emplace_back();
      read_field(fields[n]);
      any = any || !fields[n].empty();
      ++n;
      more = at_ < text_.size() && text_[at_] == separator_;
      if (more) ++at_;
    }
    fields.resize(n);
    // The row's end: CR, LF or both.
    if (at_ < text_.size() && text_[at_] == '\r') {
      ++at_;
      if (at_ >= text_.size() || text_[at_] != '\n') ++line_;
    }
    if (at_ < text_.size() && text_[at_] == '\n') ++at_, ++line_;
    if (any) return true;
  }
  return false;
}

// From an opening quote to behind its closing one; false, and nothing read, when it is not closed.
bool CsvReader::read_quoted(std::string& field) {
  const std::size_t limit = std::min(text_.size(), at_ + kLongestField);
  int breaks = 0;
  for (std::size_t i = at_ + 1; i < limit; ++i) {
    const char c = text_[i];
    if (c == '"' && (i + 1 >= text_.size() || text_[i + 1] != '"')) {
      // What stands behind it in its line.
      std::size_t next = i + 1;
      while (next < text_.size() && blank(text_[next]) && text_[next] != separator_) ++next;
      const bool clean =
          next >= text_.size() || text_[next] == separator_ || text_[next] == '\n' || text_[next] == '\r';
      if (breaks > 0 && !clean) break;
      at_ = i + 1, line_ += breaks;
      return true;
    }
    if (c == '"') ++i;
    if (c == '\n' || (c == '\r' && (i + 1 >= text_.size() || text_[i + 1] != '\n'))) ++breaks;
    field += c;
  }
  field.clear();
  return false;
}

void CsvReader::read_field(std::string& field) {
  field.clear();
  while (at_ < text_.size() && blank(text_[at_]) && text_[at_] != separator_) ++at_;
  if (at_ < text_.size() && text_[at_] == '"' && !read_quoted(field)) unclosed_ = true, ++at_;
  // An unquoted field, or whatever follows a closing quote.
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
  std::size_t end = at_;
  while (end > begin && blank(text_[end - 1])) --end;
  field.append(text_.substr(begin, end - begin));
}

char guess_separator(std::string_view text) {
  std::size_t commas = 0, semicolons = 0, tabs = 0;
  bool quoted = false;
  for (char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '\n' || c == '\r') break;
    commas += c == ',', semicolons += c == ';', tabs += c == '\t';
  }
  if (semicolons > commas && semicolons >= tabs) return ';';
  return tabs > commas ? '\t' : ',';
}

}  // namespace bosquet::exchange
