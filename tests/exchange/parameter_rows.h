// Parameter rows: a described struct as rows of a Markdown table, as docs/recipe.md shows them.
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <vector>

#include "core/parameter.h"

namespace bosquet {

struct ParameterRows {
  std::vector<std::string> rows;

  void operator()(const Real& r, double v) {
    add(r.name, r.unit, fmt::format("{:g} to {:g}", r.low, r.high), fmt::format("{:g}", v), r.meaning);
  }
  void operator()(const Real& r, float v) {
    add(r.name, r.unit, fmt::format("{:g} to {:g}", r.low, r.high), fmt::format("{:g}", v), r.meaning);
  }
  void operator()(const Whole& w, int v) {
    add(w.name, "whole number", fmt::format("{} to {}", w.low, w.high), fmt::format("{}", v), w.meaning);
  }
  void operator()(const Switch& s, bool v) { add(s.name, "true/false", "", v ? "true" : "false", s.meaning); }
  void operator()(const Text& t, const std::string& v) { add(t.name, "text", "", v, t.meaning); }
  void operator()(const Colour& c, const Vec3& v) {
    std::string hex;
    for (int i = 0; i < 3; ++i) hex += fmt::format("{:02X}", static_cast<int>(v[i] * 255.0f + 0.5f));
    add(c.name, "colour", "", hex, c.meaning);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& c, Enum v) {
    add(c.name, "choice", fmt::format("{}", fmt::join(c.names, ", ")),
        std::string(c.names[static_cast<std::size_t>(v)]), c.meaning);
  }
  template <class Item>
  void operator()(const Tables& t, const std::vector<Item>&) {
    add(t.name, "tables", "", "", t.meaning);
  }

 private:
  void add(std::string_view name, std::string_view unit, const std::string& range, const std::string& value,
           std::string_view meaning) {
    rows.push_back(fmt::format("| `{}` | {} | {} | {} | {} |", name, unit, range, value, meaning));
  }
};

}  // namespace bosquet
