// Project JSON: described parameters (core/parameter.h) as JSON objects, and back.
//
// Format    a key for each described field; numbers in the unit of files, a float by the shortest text that reads back
//           as the same float, infinity as the text "inf"; choices by name; colours as [r, g, b], sRGB 0..1; tables as
//           lists of objects
// Holds     a described struct read back equals the one written, bit by bit
// Errors    a value that is none, or out of its range, is left at its default and noted by key
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/parameter.h"
#include "core/vec.h"

namespace bosquet::scene {

using Json = nlohmann::ordered_json;

Json json_number(float value);
Json json_number(double value);
/// Nothing when it is no number; infinity is one, NaN is none.
std::optional<double> number_of(const Json& json);

/// Visitor that writes.
struct JsonWriter {
  Json& out;

  void operator()(const Real& r, float v) { put(r.name, json_number(v)); }
  void operator()(const Real& r, double v) { put(r.name, json_number(v)); }
  void operator()(const Whole& w, int v) { put(w.name, v); }
  void operator()(const Switch& s, bool v) { put(s.name, v); }
  void operator()(const Text& t, const std::string& v) { put(t.name, v); }
  void operator()(const Colour& c, const Vec3& v) {
    put(c.name, Json::array({json_number(v.x), json_number(v.y), json_number(v.z)}));
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& c, Enum v) { put(c.name, std::string(c.names[static_cast<std::size_t>(v)])); }
  template <class Item>
  void operator()(const Tables& t, const std::vector<Item>& items) {
    Json all = Json::array();
    for (const Item& item : items) {
      Json one = Json::object();
      JsonWriter writer{one};
      describe(item, writer);
      all.push_back(std::move(one));
    }
    put(t.name, std::move(all));
  }

 private:
  template <class Value>
  void put(std::string_view name, Value&& value) {
    out[std::string(name)] = std::forward<Value>(value);
  }
};

/// Visitor that reads. A missing key keeps what is there.
class JsonReader {
 public:
  /// Mistakes are added to `problems`, each beginning with `where`.
  JsonReader(const Json& in, std::string where, std::vector<std::string>& problems)
      : in_(in), where_(std::move(where)), problems_(problems) {}

  void operator()(const Real& info, float& value) {
    double wide = 0;
    if (real(info, wide)) value = static_cast<float>(wide);
  }
  void operator()(const Real& info, double& value) { real(info, value); }
  void operator()(const Whole& info, int& value);
  void operator()(const Switch& info, bool& value);
  void operator()(const Text& info, std::string& value);
  void operator()(const Colour& info, Vec3& value);
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Choice& info, Enum& value) { value = static_cast<Enum>(choice(info, static_cast<int>(value))); }
  template <class Item>
  void operator()(const Tables& info, std::vector<Item>& items) {
    const Json* list = find(info.name);
    if (!list) return;
    if (!list->is_array()) return wrong(info.name);
    items.clear();
    for (const Json& one : *list) {
      JsonReader reader(one, where_ + "." + std::string(info.name), problems_);
      describe(items.emplace_back(), reader);
    }
  }

  // Fields that no struct describes.
  void text(std::string_view name, std::string& value) { (*this)(Text{name, ""}, value); }
  void texts(std::string_view name, std::vector<std::string>& value);
  void flag(std::string_view name, bool& value) { (*this)(Switch{name, ""}, value); }
  void word(std::string_view name, std::uint64_t& value);  ///< a text of digits: JSON readers keep 53 bits
  void whole(std::string_view name, std::int32_t& value);
  void count(std::string_view name, std::size_t& value);
  void number(std::string_view name, float& value);
  void number(std::string_view name, double& value);
  void number(std::string_view name, std::optional<float>& value);  ///< null or missing: none
  void vector(std::string_view name, Vec2& value);
  void vector(std::string_view name, Vec3& value);
  void vector(std::string_view name, DVec2& value);
  void points(std::string_view name, std::vector<Vec2>& value);
  /// The value of a key, or null.
  const Json* find(std::string_view name) const;
  void wrong(std::string_view name) { problems_.push_back(where_ + "." + std::string(name)); }
  const std::string& where() const { return where_; }
  std::vector<std::string>& problems() { return problems_; }

 private:
  bool real(const Real& info, double& value);
  int choice(const Choice& info, int value);

  const Json& in_;
  std::string where_;
  std::vector<std::string>& problems_;
};

inline Json json_of(Vec2 v) { return Json::array({json_number(v.x), json_number(v.y)}); }
inline Json json_of(const Vec3& v) { return Json::array({json_number(v.x), json_number(v.y), json_number(v.z)}); }
inline Json json_of(DVec2 v) { return Json::array({json_number(v.x), json_number(v.y)}); }
Json json_of(const std::vector<Vec2>& points);

/// A described struct as an object.
template <class P>
Json described_json(const P& p) {
  Json out = Json::object();
  JsonWriter writer{out};
  describe(p, writer);
  return out;
}

/// Reads the object under `name` into a described struct; a missing one keeps what is there.
template <class P>
void read_described(JsonReader& in, std::string_view name, P& p) {
  const Json* json = in.find(name);
  if (!json) return;
  JsonReader reader(*json, in.where() + "." + std::string(name), in.problems());
  describe(p, reader);
}

/// One line of text. What is no UTF-8 (a name from somebody's file) is replaced.
std::string text_of(const Json& json);

/// Parses text that nests no deeper than ours does; nothing when it is no JSON.
std::optional<Json> parse_json(std::string_view text);

}  // namespace bosquet::scene
