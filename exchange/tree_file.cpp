#include "exchange/tree_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "exchange/file_output.h"

namespace bosquet::exchange {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kFormat = 1, kMostJsonDepth = 8;
constexpr std::uint64_t kMostTreeBytes = std::uint64_t{1} << 30;
constexpr std::size_t kMostInternodes = 5'000'000;
constexpr double kMostSize_m = 1000.0, kMostRadius_m = 5.0, kMostNumber = 1e9;

// Described parameters as JSON.
struct Writer {
  OrderedJson out = OrderedJson::object();
  void operator()(const Real& r, float v) { out[std::string(r.name)] = v; }
  void operator()(const Real& r, double v) { out[std::string(r.name)] = v; }
  void operator()(const Whole& w, int v) { out[std::string(w.name)] = v; }
  void operator()(const Switch& s, bool v) { out[std::string(s.name)] = v; }
  void operator()(const Text& t, const std::string& v) { out[std::string(t.name)] = v; }
  void operator()(const Colour& c, const Vec3& v) { out[std::string(c.name)] = {v.x, v.y, v.z}; }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& c, Enum v) {
    out[std::string(c.name)] = std::string(c.names[static_cast<std::size_t>(v)]);
  }
  template <class Item>
  void operator()(const Tables& t, const std::vector<Item>& items) {
    OrderedJson all = OrderedJson::array();
    for (const Item& item : items) {
      Writer one;
      describe(item, one);
      all.push_back(std::move(one.out));
    }
    out[std::string(t.name)] = std::move(all);
  }
};

// Fields of a skeleton, visited by writer and reader alike.
template <class S, class Visit>
void for_each_array(S& s, const Visit& visit) {
  visit("parent", s.parent), visit("axis", s.axis), visit("order", s.order);
  visit("radius", s.radius), visit("born", s.born), visit("shed", s.shed);
  visit("light", s.light), visit("vigor", s.vigor), visit("pipes", s.pipes);
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : name_(path.string()) {}

  Result<SavedTree> read(const std::vector<std::byte>& bytes) {
    bool deep = false;
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const OrderedJson json = OrderedJson::parse(
        text, text + bytes.size(),
        [&](int depth, OrderedJson::parse_event_t, OrderedJson&) { return !(deep = deep || depth > kMostJsonDepth); },
        false);
    if (deep) return wrong("it is nested deeper than a tree is");
    if (!json.is_object() || !json.contains("bosquet_tree")) return wrong("it is no tree that bosquet saved");
    if (json["bosquet_tree"] != kFormat) return wrong("it is of a format that this version does not know");

    SavedTree tree;
    if (!json.contains("species") || !json["species"].is_string()) return wrong("its species is missing");
    tree.species = json["species"].get<std::string>();
    if (!whole(json, "seed", tree.seed) || !whole(json, "key", tree.key)) return wrong("its seed or key is no number");
    if (!json.contains("skeleton") || !json["skeleton"].is_object()) return wrong("its skeleton is missing");
    if (json.contains("size") && json["size"].is_object()) {
      real(json["size"], "scale_height", 0, 100, tree.scale_height);
      real(json["size"], "scale_width", 0, 100, tree.scale_width);
    }
    if (auto done = skeleton(json["skeleton"], tree.skeleton); !done) return done.error();
    return tree;
  }

 private:
  static bool whole(const OrderedJson& json, const char* key, std::uint64_t& out) {
    if (!json.contains(key) || !json[key].is_string()) return false;
    const std::string text = json[key].get<std::string>();
    const auto [end, ok] = std::from_chars(text.data(), text.data() + text.size(), out);
    return ok == std::errc() && end == text.data() + text.size();
  }
  static bool real(const OrderedJson& json, const char* key, double low, double high, float& out) {
    if (!json.contains(key) || !json[key].is_number()) return false;
    const double v = json[key].get<double>();
    if (!(v >= low && v <= high)) return false;
    out = static_cast<float>(v);
    return true;
  }

  Result<void> skeleton(const OrderedJson& json, growth::Skeleton& s) {
    if (!json.contains("distal") || !json["distal"].is_array()) return wrong("skeleton.distal is missing");
    const OrderedJson& distal = json["distal"];
    const std::size_t n = distal.size() / 3;
    if (n == 0 || distal.size() % 3 != 0 || n > kMostInternodes)
      return wrong("skeleton.distal must hold x, y, z in turn");
    for (std::size_t i = 0; i < n; ++i) {
      Vec3 p;
      for (int a = 0; a < 3; ++a) {
        const OrderedJson& v = distal[3 * i + static_cast<std::size_t>(a)];
        if (!v.is_number() || !(std::fabs(v.get<double>()) <= kMostSize_m)) return wrong(element("distal", i));
        p[a] = v.get<float>();
      }
      s.distal.push_back(p);
    }
    std::string problem;
    for_each_array(s, [&](const char* key, auto& values) {
      using Value = typename std::remove_reference_t<decltype(values)>::value_type;
      if (!problem.empty()) return;
      const bool optional = std::string_view(key) == "pipes";
      if (optional && (!json.contains(key) || json[key].empty())) return;
      if (!json.contains(key) || !json[key].is_array() || json[key].size() != n) {
        problem = fmt::format("skeleton.{} must hold {} values", key, n);
        return;
      }
      for (std::size_t i = 0; i < n; ++i) {
        const OrderedJson& v = json[key][i];
        const double number = v.is_number() ? v.get<double>() : std::numeric_limits<double>::quiet_NaN();
        const bool fits = std::is_floating_point_v<Value>
                              ? std::fabs(number) <= kMostNumber
                              : v.is_number_integer() &&
                                    number >= static_cast<double>(std::numeric_limits<Value>::lowest()) &&
                                    number <= static_cast<double>(std::numeric_limits<Value>::max());
        if (!fits) {
          problem = element(key, i);
          return;
        }
        values.push_back(v.get<Value>());
      }
    });
    if (!problem.empty()) return wrong(problem);
    for (std::size_t i = 0; i < n; ++i) {
      if (s.parent[i] < -1 || s.parent[i] >= static_cast<std::int32_t>(i)) return wrong(element("parent", i));
      if (s.radius[i] < 0 || static_cast<double>(s.radius[i]) > kMostRadius_m) return wrong(element("radius", i));
    }
    float seasons = 0;
    if (!real(json, "seasons", 0, 65534, seasons) ||
        !real(json, "internode_length_m", 1e-4, 10, s.internode_length_m) ||
        !real(json, "detail", 0.01, 100, s.detail) || !real(json, "tip_diameter_m", 1e-5, 1, s.tip_diameter_m) ||
        !real(json, "pipe_exponent", 1, 10, s.pipe_exponent))
      return wrong("a number of its skeleton (seasons, internode_length_m, detail, ...) is missing or out of range");
    s.seasons = static_cast<int>(seasons);
    return {};
  }

  static std::string element(const char* key, std::size_t i) {
    return fmt::format("value {} of skeleton.{} is none", i, key);
  }
  Error wrong(const std::string& what) const { return {fmt::format("cannot read {}: {}", name_, what)}; }

  std::string name_;
};

}  // namespace

Result<std::uint64_t> write_tree(const SavedTree& tree, const growth::Parameters& growth,
                                 const std::filesystem::path& path) {
  OrderedJson json;
  json["bosquet_tree"] = kFormat;
  json["species"] = tree.species;
  json["seed"] = std::to_string(tree.seed);
  json["key"] = std::to_string(tree.key);
  json["size"] = {{"scale_height", tree.scale_height}, {"scale_width", tree.scale_width}};
  Writer parameters;
  describe(growth, parameters);
  json["growth"] = std::move(parameters.out);

  const growth::Skeleton& s = tree.skeleton;
  OrderedJson skeleton;
  skeleton["seasons"] = s.seasons;
  skeleton["internode_length_m"] = s.internode_length_m;
  skeleton["detail"] = s.detail;
  skeleton["tip_diameter_m"] = s.tip_diameter_m;
  skeleton["pipe_exponent"] = s.pipe_exponent;
  OrderedJson distal = OrderedJson::array();
  for (const Vec3& p : s.distal)
    for (int a = 0; a < 3; ++a) distal.push_back(p[a]);
  skeleton["distal"] = std::move(distal);
  for_each_array(s, [&](const char* key, const auto& values) { skeleton[key] = values; });
  json["skeleton"] = std::move(skeleton);
  return write_file(path, json.dump() + "\n");
}

Result<SavedTree> read_tree(const std::filesystem::path& path) {
  auto bytes = read_file(path, kMostTreeBytes);
  if (!bytes) return bytes.error();
  return Reader(path).read(*bytes);
}

}  // namespace bosquet::exchange
