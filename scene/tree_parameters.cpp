#include "scene/tree_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace bosquet::scene {
namespace {

constexpr std::string_view kPrefix = "growth.";

/// Sets the described field that a key names.
struct Setter {
  std::string_view key;
  const ParameterOverride& given;
  bool found = false;
  std::string wrong{};  ///< what kind of value is allowed instead

  template <class Value>
  const Value* value(std::string_view name, const char* kind) {
    if (name != key) return nullptr;
    found = true;
    const Value* held = std::get_if<Value>(&given.value);
    if (!held) wrong = kind;
    return held;
  }
  void operator()(const Real& info, float& field) {
    if (const double* v = value<double>(info.name, "a number")) field = static_cast<float>(*v);
  }
  void operator()(const Whole& info, int& field) {
    if (const double* v = value<double>(info.name, "a whole number")) {
      if (*v >= info.low && *v <= info.high && *v == static_cast<double>(static_cast<int>(*v)))
        field = static_cast<int>(*v);
      else
        wrong = fmt::format("a whole number from {} to {}", info.low, info.high);
    }
  }
  void operator()(const Switch& info, bool& field) {
    if (const bool* v = value<bool>(info.name, "true or false")) field = *v;
  }
  template <class Enum>
  void operator()(const Choice& info, Enum& field) {
    if (const std::string* v = value<std::string>(info.name, "one of its names")) {
      const auto at = std::find(info.names.begin(), info.names.end(), *v);
      if (at == info.names.end())
        wrong = fmt::format("{}", fmt::join(info.names, ", "));
      else
        field = static_cast<Enum>(at - info.names.begin());
    }
  }
  template <class Item>
  void operator()(const Tables&, std::vector<Item>&) {}
};

/// Every described field as a value by key.
struct Lister {
  std::vector<ParameterOverride> all;

  void add(std::string_view name, std::variant<double, bool, std::string> value) {
    all.push_back({std::string(kPrefix) + std::string(name), std::move(value)});
  }
  void operator()(const Real& info, float v) { add(info.name, static_cast<double>(v)); }
  void operator()(const Whole& info, int v) { add(info.name, static_cast<double>(v)); }
  void operator()(const Switch& info, bool v) { add(info.name, v); }
  template <class Enum>
  void operator()(const Choice& info, Enum v) {
    add(info.name, std::string(info.names[static_cast<std::size_t>(v)]));
  }
  template <class Item>
  void operator()(const Tables&, const std::vector<Item>&) {}
};

}  // namespace

Result<growth::Parameters> with_overrides(const growth::Parameters& species,
                                          const SharedList<ParameterOverride>& overrides, std::string_view what) {
  growth::Parameters parameters = species;
  for (const ParameterOverride& given : overrides) {
    if (!given.key.starts_with(kPrefix))
      return Error{fmt::format("{}: '{}' cannot be changed for one tree; growth parameters can ('growth.NAME')", what,
                               given.key)};
    Setter set{std::string_view(given.key).substr(kPrefix.size()), given};
    describe(parameters, set);
    if (!set.found) return Error{fmt::format("{}: there is no growth parameter '{}'", what, set.key)};
    if (!set.wrong.empty()) return Error{fmt::format("{}: {} must be {}", what, given.key, set.wrong)};
  }
  if (auto checked = growth::check(parameters, what); !checked) return checked.error();
  return parameters;
}

SharedList<ParameterOverride> overrides_between(const growth::Parameters& species, const growth::Parameters& edited) {
  Lister from, to;
  describe(species, from);
  describe(edited, to);
  std::vector<ParameterOverride> out;
  for (std::size_t i = 0; i < to.all.size(); ++i)
    if (from.all[i] != to.all[i]) out.push_back(std::move(to.all[i]));
  return out;
}

}  // namespace bosquet::scene
