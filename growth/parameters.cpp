#include "growth/parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace bosquet::growth {
namespace {

/// Refuses the first number out of its range.
struct RangeCheck {
  std::string where;
  std::optional<Mistake> mistake{};

  void refuse(std::string_view name, const std::string& value, double low, double high, std::string_view unit) {
    if (mistake) return;
    mistake = Mistake{fmt::format("{}: {} = {} is out of range, allowed is {} to {}{}{}", where, name, value, low, high,
                                  unit.empty() ? "" : " ", unit),
                      name,
                      {}};
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
      RangeCheck inner{fmt::format("{}, {} {}", where, info.name, i + 1)};
      describe(items[i], inner);
      if (mistake || !inner.mistake) continue;
      mistake = std::move(inner.mistake);
      mistake->table = info.name, mistake->index = i;
    }
  }
};

/// Numbers that must fit together, and the table that last set one of them.
struct Together {
  float straightness, tropism, space;
  float vertical, offset;
  std::string_view weights_table, ellipse_table;
  std::size_t weights_index = 0, ellipse_index = 0;

  explicit Together(const Parameters& p)
      : straightness(p.straightness),
        tropism(p.tropism),
        space(p.space),
        vertical(p.gravimorphism_vertical),
        offset(p.gravimorphism_offset) {}

  void apply(const Overrides& o, std::string_view table, std::size_t index) {
    if (o.straightness || o.tropism || o.space) weights_table = table, weights_index = index;
    if (o.gravimorphism_vertical || o.gravimorphism_offset) ellipse_table = table, ellipse_index = index;
    straightness = o.straightness.value_or(straightness);
    tropism = o.tropism.value_or(tropism);
    space = o.space.value_or(space);
    vertical = o.gravimorphism_vertical.value_or(vertical);
    offset = o.gravimorphism_offset.value_or(offset);
  }
};

/// What is wrong with the numbers in force for an order once so many phases have begun.
std::optional<Mistake> wrong_together(const Parameters& p, std::string_view what, int order, std::size_t phases) {
  Together n(p);
  for (std::size_t i = 0; i < p.orders.size(); ++i) {
    if (order >= p.orders[i].from) n.apply(p.orders[i].change, "order", i);
  }
  for (std::size_t i = 0; i < phases; ++i) {
    if (concerns(p.phases[i], order)) n.apply(p.phases[i].change, "phase", i);
  }
  const std::string where = fmt::format("{}, order {}{}", what, order, phases ? fmt::format(", phase {}", phases) : "");
  const float sum = n.straightness + n.tropism + n.space;
  if (std::abs(sum - 1.0f) > 1e-3f) {
    return Mistake{fmt::format("{}: straightness {} + tropism {} + space {} = {}, the sum must be 1", where,
                               n.straightness, n.tropism, n.space, sum),
                   "straightness", n.weights_table, n.weights_index};
  }
  if (!(std::abs(n.offset) < n.vertical)) {
    return Mistake{fmt::format("{}: gravimorphism_offset = {} puts the axis outside the bud ellipse, allowed is less "
                               "than gravimorphism_vertical = {} either way",
                               where, n.offset, n.vertical),
                   "gravimorphism_offset", n.ellipse_table, n.ellipse_index};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Mistake> find_mistake(const Parameters& p, std::string_view what) {
  RangeCheck ranges{std::string(what)};
  describe(p, ranges);
  if (ranges.mistake) return ranges.mistake;

  constexpr std::size_t kMostPhases = 4;
  if (p.phases.size() > kMostPhases) {
    return Mistake{fmt::format("{}: {} phases, allowed are at most {}", what, p.phases.size(), kMostPhases), "from",
                   "phase", kMostPhases};
  }
  for (std::size_t i = 0; i < p.phases.size(); ++i) {
    const Phase& phase = p.phases[i];
    if (phase.from_order > phase.to_order) {
      return Mistake{fmt::format("{}: phase {} changes no axes: from_order = {} is above to_order = {}", what, i + 1,
                                 phase.from_order, phase.to_order),
                     "from_order", "phase", i};
    }
    if (i > 0 && phase.from < p.phases[i - 1].from) {
      return Mistake{fmt::format("{}: phase {} begins at {}, before phase {} at {}", what, i + 1, phase.from, i,
                                 p.phases[i - 1].from),
                     "from", "phase", i};
    }
  }
  // What keys promise each other must hold for every combination of order and phase that can be in force.
  for (std::size_t phases = 0; phases <= p.phases.size(); ++phases) {
    for (int order = 0; order <= 12; ++order) {
      if (auto mistake = wrong_together(p, what, order, phases)) return mistake;
    }
  }
  return std::nullopt;
}

Result<void> check(const Parameters& parameters, std::string_view what) {
  if (auto mistake = find_mistake(parameters, what)) return Error{mistake->message};
  return {};
}

}  // namespace bosquet::growth
