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

void CsvReader::read_field(std::string& field) {
  field.clear();
  while (at_ < text_.size() && blank(text_[at_]) && text_[at_] != separator_) ++at_;
  if (at_ < text_.size() && text_[at_] == '"') {
    for (++at_; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
        ++at_;
      } else if (c == '\n') {
        ++line_;
      }
      field += c;
    }
    ++at_;  // the closing quote
  }
  // An unquoted field, or whatever follows a closing quote.
  const std::size_t begin = std::min(at_, text_.size());
  at_ = begin;
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
