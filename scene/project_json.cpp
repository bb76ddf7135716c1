#include "scene/project_json.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace bosquet::scene {
namespace {

constexpr int kMostDepth = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Vector>
bool read_vector(const Json& json, Vector& value) {
  if (!json.is_array() || json.size() != static_cast<std::size_t>(Vector::length())) return false;
  for (int i = 0; i < Vector::length(); ++i) {
    const auto number = number_of(json[static_cast<std::size_t>(i)]);
    if (!number) return false;
    value[i] = static_cast<typename Vector::value_type>(*number);
  }
  return true;
}

}  // namespace

Json json_number(float value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  // 0.3f is 0.3 in the file, not 0.30000001192092896, where that reads back as the same float.
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double wide = 0;
  std::from_chars(text, end, wide);
  return static_cast<float>(wide) == value ? wide : static_cast<double>(value);
}

Json json_number(double value) {
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

std::optional<double> number_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json.is_string() && json == "inf") return kInfinity;
  if (json.is_string() && json == "-inf") return -kInfinity;
  return {};
}

Json json_of(const std::vector<Vec2>& points) {
  Json all = Json::array();
  for (Vec2 p : points) all.push_back(json_of(p));
  return all;
}

const Json* JsonReader::find(std::string_view name) const {
  if (!in_.is_object()) return nullptr;
  const auto found = in_.find(std::string(name));
  return found == in_.end() ? nullptr : &*found;
}

bool JsonReader::real(const Real& info, double& value) {
  const Json* json = find(info.name);
  if (!json) return false;
  const auto number = number_of(*json);
  if (!number || !(*number >= info.low && *number <= info.high)) return wrong(info.name), false;
  value = *number;
  return true;
}

void JsonReader::operator()(const Whole& info, int& value) {
  const Json* json = find(info.name);
  if (!json) return;
  if (!json->is_number_integer()) return wrong(info.name);
  const auto number = json->get<double>();
  if (!(number >= info.low && number <= info.high)) return wrong(info.name);
  value = json->get<int>();
}

void JsonReader::operator()(const Switch& info, bool& value) {
  const Json* json = find(info.name);
  if (!json) return;
  if (!json->is_boolean()) return wrong(info.name);
  value = json->get<bool>();
}

void JsonReader::operator()(const Text& info, std::string& value) {
  const Json* json = find(info.name);
  if (!json) return;
  if (!json->is_string()) return wrong(info.name);
  value = json->get<std::string>();
}

void JsonReader::operator()(const Colour& info, Vec3& value) {
  const Json* json = find(info.name);
  Vec3 colour;
  if (!json) return;
  if (!read_vector(*json, colour)) return wrong(info.name);
  for (int i = 0; i < 3; ++i)
    if (!(colour[i] >= 0.0f && colour[i] <= 1.0f)) return wrong(info.name);
  value = colour;
}

int JsonReader::choice(const Choice& info, int value) {
  const Json* json = find(info.name);
  if (!json) return value;
  for (std::size_t i = 0; json->is_string() && i < info.names.size(); ++i)
    if (json->get_ref<const std::string&>() == info.names[i]) return static_cast<int>(i);
  wrong(info.name);
  return value;
}

void JsonReader::texts(std::string_view name, std::vector<std::string>& value) {
  const Json* json = find(name);
  if (!json) return;
  if (!json->is_array()) return wrong(name);
  value.clear();
  for (const Json& one : *json) {
    if (!one.is_string()) return wrong(name);
    value.push_back(one.get<std::string>());
  }
}

void JsonReader::word(std::string_view name, std::uint64_t& value) {
  const Json* json = find(name);
  if (!json) return;
  if (!json->is_string()) return wrong(name);
  const auto& text = json->get_ref<const std::string&>();
  std::uint64_t read = 0;
  const auto [end, mistake] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (mistake != std::errc() || end != text.data() + text.size()) return wrong(name);
  value = read;
}

void JsonReader::whole(std::string_view name, std::int32_t& value) {
  (*this)(Whole{name, std::numeric_limits<int>::lowest(), std::numeric_limits<int>::max(), ""}, value);
}

void JsonReader::count(std::string_view name, std::size_t& value) {
  const Json* json = find(name);
  if (!json) return;
  if (!json->is_number_unsigned()) return wrong(name);
  value = json->get<std::size_t>();
}

void JsonReader::number(std::string_view name, float& value) {
  (*this)(Real{name, "", -kInfinity, kInfinity, ""}, value);
}

void JsonReader::number(std::string_view name, double& value) {
  (*this)(Real{name, "", -kInfinity, kInfinity, ""}, value);
}

void JsonReader::number(std::string_view name, std::optional<float>& value) {
  const Json* json = find(name);
  if (!json || json->is_null()) return;
  float read = 0;
  const std::size_t before = problems_.size();
  number(name, read);
  if (problems_.size() == before) value = read;
}

void JsonReader::vector(std::string_view name, Vec2& value) {
  const Json* json = find(name);
  if (json && !read_vector(*json, value)) wrong(name);
}

void JsonReader::vector(std::string_view name, Vec3& value) {
  const Json* json = find(name);
  if (json && !read_vector(*json, value)) wrong(name);
}

void JsonReader::vector(std::string_view name, DVec2& value) {
  const Json* json = find(name);
  if (json && !read_vector(*json, value)) wrong(name);
}

void JsonReader::points(std::string_view name, std::vector<Vec2>& value) {
  const Json* json = find(name);
  if (!json) return;
  if (!json->is_array()) return wrong(name);
  value.clear();
  for (const Json& one : *json) {
    Vec2 p{0.0f};
    if (!read_vector(one, p)) return wrong(name);
    value.push_back(p);
  }
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::optional<Json> parse_json(std::string_view text) {
  bool deep = false;
  Json json = Json::parse(
      text.begin(), text.end(),
      [&](int depth, Json::parse_event_t, Json&) { return !(deep = deep || depth > kMostDepth); }, false);
  if (deep || json.is_discarded()) return {};
  return json;
}

}  // namespace bosquet::scene
