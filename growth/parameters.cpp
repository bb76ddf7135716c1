#include "growth/parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace bosquet::growth {
namespace {

/// Refuses the first number out of its range.
struct RangeCheck {
  std::string where;
  std::string message;

  void refuse(std::string_view name, const std::string& value, double low, double high, std::string_view unit) {
    if (!message.empty()) return;
    message = fmt::format("{}: {} = {} is out of range, allowed is {} to {}{}{}", where, name, value, low, high,
                          unit.empty() ? "" : " ", unit);
  }
  void operator()(const Real& info, float v) {
    // Limits as a float holds them: 0.6 in a file is the float nearest to 0.6.
    const bool inside = v >= static_cast<float>(info.low) && v <= static_cast<float>(info.high);
    if (!inside) refuse(info.name, fmt::format("{}", v), info.low, info.high, info.unit);
  }
  void operator()(const Whole& info, int v) {
    if (v < info.low || v > info.high) refuse(info.name, fmt::format("{}", v), info.low, info.high, "");
  }
  void operator()(const Switch&, bool) {}
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& info, Enum v) {
    const int i = static_cast<int>(v);
    if (i < 0 || i >= static_cast<int>(info.names.size())) {
      refuse(info.name, fmt::format("{}", i), 0, static_cast<double>(info.names.size() - 1), "");
    }
  }
  template <class Item>
  void operator()(const Tables& info, const std::vector<Item>& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      RangeCheck inner{fmt::format("{}, {} {}", where, info.name, i + 1), {}};
      describe(items[i], inner);
      if (message.empty()) message = inner.message;
    }
  }
};

}  // namespace

Result<void> check(const Parameters& p, std::string_view what) {
  RangeCheck ranges{std::string(what), {}};
  describe(p, ranges);
  if (!ranges.message.empty()) return Error{ranges.message};

  // What keys promise each other must hold for every combination of order and phase that can be in force.
  if (p.phases.size() > 4) return Error{fmt::format("{}: {} phases, allowed are at most 4", what, p.phases.size())};
  const auto combination = [&](int order, std::size_t phases) -> Result<void> {
    float a = p.straightness, b = p.tropism, c = p.space;
    float s_v = p.gravimorphism_vertical, e_v = p.gravimorphism_offset;
    const auto apply = [&](const Overrides& o) {
      a = o.straightness.value_or(a), b = o.tropism.value_or(b), c = o.space.value_or(c);
      s_v = o.gravimorphism_vertical.value_or(s_v), e_v = o.gravimorphism_offset.value_or(e_v);
    };
    for (const Order& o : p.orders) {
      if (order >= o.from) apply(o.change);
    }
    for (std::size_t i = 0; i < phases; ++i) {
      if (concerns(p.phases[i], order)) apply(p.phases[i].change);
    }
    const std::string where =
        fmt::format("{}, order {}{}", what, order, phases ? fmt::format(", phase {}", phases) : "");
    if (std::abs(a + b + c - 1.0f) > 1e-3f) {
      return Error{fmt::format("{}: straightness {} + tropism {} + space {} = {}, the sum must be 1", where, a, b, c,
                               a + b + c)};
    }
    if (!(std::abs(e_v) < s_v)) {
      return Error{
          fmt::format("{}: gravimorphism_offset = {} puts the axis outside the bud ellipse, allowed is less than "
                      "gravimorphism_vertical = {} either way",
                      where, e_v, s_v)};
    }
    return {};
  };
  for (std::size_t phases = 0; phases <= p.phases.size(); ++phases) {
    for (int order = 0; order <= 12; ++order) {
      if (auto ok = combination(order, phases); !ok) return ok;
    }
  }
  for (std::size_t i = 1; i < p.phases.size(); ++i) {
    if (p.phases[i].from < p.phases[i - 1].from) {
      return Error{fmt::format("{}: phase {} begins at {}, before phase {} at {}", what, i + 1, p.phases[i].from, i,
                               p.phases[i - 1].from)};
    }
  }
  return {};
}

}  // namespace bosquet::growth
