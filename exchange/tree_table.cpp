#include "exchange/tree_table.h"

#include <fmt/format.h>

#include "exchange/csv.h"

namespace bosquet::exchange {
namespace {

bool valid_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const int follow = c < 0x80                ? 0
                       : c >= 0xc2 && c < 0xe0 ? 1
                       : c >= 0xe0 && c < 0xf0 ? 2
                       : c >= 0xf0 && c < 0xf5 ? 3
                                               : -1;
    if (follow < 0 || i + static_cast<std::size_t>(follow) >= text.size()) return false;
    for (int k = 1; k <= follow; ++k)
      if ((static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0xc0) != 0x80) return false;
    i += static_cast<std::size_t>(follow) + 1;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (unsigned char c : text) {
    if (c < 0x80) {
      out += static_cast<char>(c);
    } else {
      out += static_cast<char>(0xc0 | (c >> 6));
      out += static_cast<char>(0x80 | (c & 0x3f));
    }
  }
  return out;
}

class CsvTable : public TreeTable {
 public:
  bool open(std::string_view text) {
    text_ = text;
    separator_ = guess_separator(text);
    decimal_comma = separator_ != ',';
    rows_ = CsvReader(text_, separator_);
    return rows_.next(columns);
  }
  bool open_latin1(std::string_view text) {
    converted_ = from_latin1(text);
    notes.push_back("not UTF-8, read as Latin-1");
    return open(converted_);
  }

  bool next(TableRow& row) override {
    row.place.reset();
    row.problem.clear();
    if (!rows_.next(row.fields)) return false;
    row.line = rows_.line();
    if (rows_.unclosed_quote()) {
      row.problem = "a quote is not closed";
      return true;
    }
    while (row.fields.size() > columns.size() && row.fields.back().empty()) row.fields.pop_back();
    if (row.fields.size() > columns.size())
      row.problem = fmt::format("{} fields, but the header has {}", row.fields.size(), columns.size());
    row.fields.resize(columns.size());
    return true;
  }

  void restart() override {
    rows_ = CsvReader(text_, separator_);
    std::vector<std::string> header;
    rows_.next(header);
  }

 private:
  std::string converted_;
  std::string_view text_;
  char separator_ = ',';
  CsvReader rows_{{}, ','};
};

}  // namespace

Result<std::unique_ptr<TreeTable>> csv_table(std::string_view text, const std::string& name) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return Error{fmt::format("{} is UTF-16 text; save it as UTF-8", name)};
  if (text.find('\0') != std::string_view::npos) return Error{fmt::format("{} is no text file", name)};
  auto table = std::make_unique<CsvTable>();
  if (!(valid_utf8(text) ? table->open(text) : table->open_latin1(text)))
    return Error{fmt::format("{} is empty: a header row and a row for each tree are needed", name)};
  return std::unique_ptr<TreeTable>(std::move(table));
}

}  // namespace bosquet::exchange
