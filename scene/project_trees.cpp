#include "scene/project_trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "scene/project_json.h"

namespace bosquet::scene {
namespace {

// More notes say no more.
constexpr std::size_t kMostNotes = 20;

// Every field of a tree but its id, species and geometry, with the column's name.
template <class T, class Visit>
void tree_columns(T& t, Visit& visit) {
  visit("key", t.key);
  visit("east_m", t.at.x);
  visit("north_m", t.at.y);
  visit("scale_height", t.scale_height);
  visit("scale_width", t.scale_width);
  visit("trunk_diameter_m", t.trunk_diameter_m);
  visit("clear_stem_m", t.clear_stem_m);
  visit("form", t.form.kind, crowns::kFormKindNames);
  visit("form_width_m", t.form.width_m);
  visit("form_depth_m", t.form.depth_m);
  visit("form_height_m", t.form.height_m);
  visit("form_rotation_deg", t.form.rotation_deg);
  visit("form_east_m", t.form.centre.x);
  visit("form_north_m", t.form.centre.y);
  visit("measured", t.measured);
  visit("status", t.status, kTreeStatusNames);
  visit("inventory_name", t.inventory_name);
  visit("inventory_id", t.inventory_id);
  visit("locked", t.locked);
  visit("overrides", t.overrides);
  visit("studio_edits", t.studio_edits);
}

Json json_of(const SharedList<ParameterOverride>& list) {
  Json all = Json::object();
  for (const ParameterOverride& o : list)
    std::visit(
        [&](const auto& v) {
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>)
            all[o.key] = json_number(v);
          else
            all[o.key] = v;
        },
        o.value);
  return all;
}

// The values of a row as SQLite keeps them, hashed by type and bits, and bound where there is a statement.
class RowSink {
 public:
  explicit RowSink(Statement* statement) : statement_(statement) {}

  void null() {
    hash_.add(0);
    if (statement_) statement_->bind_null(place_);
    ++place_;
  }
  void integer(std::int64_t v) {
    hash_.add(1).add(std::bit_cast<std::uint64_t>(v));
    if (statement_) statement_->bind(place_, v);
    ++place_;
  }
  void real(double v) {
    v += 0.0;  // the database keeps no negative zero
    hash_.add(2).add(std::bit_cast<std::uint64_t>(v));
    if (statement_) statement_->bind(place_, v);
    ++place_;
  }
  void text(std::string_view v) {
    hash_.add(3).add(v);
    if (statement_) statement_->bind(place_, v);
    ++place_;
  }
  void blob(std::span<const std::byte> v) {
    hash_.add(4).add(v);
    if (statement_) statement_->bind(place_, v);
    ++place_;
  }

  // Columns.
  void operator()(const char*, float v) { real(static_cast<double>(v)); }
  void operator()(const char*, const std::optional<float>& v) { v ? real(static_cast<double>(*v)) : null(); }
  void operator()(const char*, bool v) { integer(v); }
  void operator()(const char*, std::uint64_t v) { integer(std::bit_cast<std::int64_t>(v)); }
  void operator()(const char*, const std::string& v) { text(v); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char*, Enum v, std::span<const std::string_view> names) {
    text(names[static_cast<std::size_t>(v)]);
  }
  void operator()(const char*, const SharedList<ParameterOverride>& list) {
    if (list.empty()) return null();
    text(text_of(json_of(list)));
  }
  void operator()(const char*, const SharedList<std::string>& list) {
    if (list.empty()) return null();
    text(text_of(Json(list.all())));
  }

  Hash128 digest() const { return hash_.digest(); }

 private:
  Statement* statement_;
  Hasher128 hash_;
  int place_ = 0;
};

std::optional<SharedList<ParameterOverride>> overrides_of(const Json& json) {
  if (!json.is_object()) return {};
  std::vector<ParameterOverride> read;
  for (const auto& [key, value] : json.items()) {
    if (value.is_boolean())
      read.push_back({key, value.get<bool>()});
    else if (const auto n = value.is_number() ? number_of(value) : std::nullopt)
      read.push_back({key, *n});
    else if (value.is_string())
      read.push_back({key, value.get<std::string>()});
    else
      return {};
  }
  return SharedList<ParameterOverride>(std::move(read));
}

std::optional<SharedList<std::string>> texts_of(const Json& json) {
  if (!json.is_array()) return {};
  std::vector<std::string> read;
  for (const Json& one : json) {
    if (!one.is_string()) return {};
    read.push_back(one.get<std::string>());
  }
  return SharedList<std::string>(std::move(read));
}

// GeoPackage point: header without envelope, then well-known binary, all little-endian.
using Point = std::array<std::byte, 29>;

Point point(DVec2 place, std::int32_t srs) {
  Point out{};
  const char header[] = {'G', 'P', 0, 1};
  std::memcpy(out.data(), header, 4);
  std::memcpy(out.data() + 4, &srs, 4);
  const char wkb[] = {1, 1, 0, 0, 0};
  std::memcpy(out.data() + 8, wkb, 5);
  std::memcpy(out.data() + 13, &place.x, 8);
  std::memcpy(out.data() + 21, &place.y, 8);
  return out;
}

// A point of anybody's: with or without envelope, either byte order refused but ours, more than two ordinates taken.
std::optional<DVec2> place_of(std::span<const std::byte> blob) {
  if (blob.size() < 8 || blob[0] != std::byte{'G'} || blob[1] != std::byte{'P'}) return {};
  const auto flags = std::to_integer<unsigned>(blob[3]);
  constexpr std::array<std::size_t, 5> kEnvelope{0, 32, 48, 48, 64};
  const unsigned kind = flags >> 1 & 7;
  if (!(flags & 1) || kind >= kEnvelope.size()) return {};
  const std::size_t at = 8 + kEnvelope[kind];
  if (blob.size() < at + 21 || blob[at] != std::byte{1}) return {};
  std::uint32_t type = 0;
  std::memcpy(&type, blob.data() + at + 1, 4);
  if ((type & 0x0fffffff) % 1000 != 1) return {};
  DVec2 place;
  std::memcpy(&place.x, blob.data() + at + 5, 8);
  std::memcpy(&place.y, blob.data() + at + 13, 8);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return {};
  return place;
}

DVec2 projected(Vec2 at, const Georeference& place) { return place.south_west + DVec2(at) + 0.0; }

void put_row(RowSink& sink, const Tree& tree, const Georeference& place, const std::vector<std::string>& labels,
             std::int32_t srs) {
  sink.integer(tree.id);
  sink.blob(point(projected(tree.at, place), srs));
  sink.text(labels[tree.species]);
  tree_columns(tree, sink);
}

// Names and types of the columns, for SQL.
struct Columns {
  std::vector<std::pair<std::string, std::string>> all;

  void operator()(const char* name, float) { all.emplace_back(name, "REAL"); }
  void operator()(const char* name, const std::optional<float>&) { all.emplace_back(name, "REAL"); }
  void operator()(const char* name, bool) { all.emplace_back(name, "BOOLEAN"); }
  void operator()(const char* name, std::uint64_t) { all.emplace_back(name, "INTEGER"); }
  void operator()(const char* name, const std::string&) { all.emplace_back(name, "TEXT"); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* name, Enum, std::span<const std::string_view>) { all.emplace_back(name, "TEXT"); }
  template <class Item>
  void operator()(const char* name, const SharedList<Item>&) {
    all.emplace_back(name, "TEXT");
  }
};

std::vector<std::pair<std::string, std::string>> columns() {
  Columns found;
  found.all = {{"id", "INTEGER PRIMARY KEY NOT NULL"}, {"geom", "POINT"}, {"species", "TEXT"}};
  const Tree tree;
  tree_columns(tree, found);
  return found.all;
}

void add_word(std::string& list, std::string_view word) {
  if (!list.empty()) list += ", ";
  list += word;
}

// Reads the columns that a file has into a tree.
class RowSource {
 public:
  RowSource(Statement& row, const std::vector<int>& place) : row_(row), place_(place) {}

  void operator()(const char* name, float& v) {
    if (const int c = next(); c >= 0) number(name, c, v);
  }
  void operator()(const char* name, std::optional<float>& v) {
    const int c = next();
    if (c < 0 || row_.is_null(c)) return;
    float read = 0;
    if (number(name, c, read)) v = read;
  }
  void operator()(const char* name, bool& v) {
    const int c = next();
    if (c < 0) return;
    if (!row_.is_integer(c)) return wrong(name);
    v = row_.integer(c) != 0;
  }
  void operator()(const char* name, std::uint64_t& v) {
    const int c = next();
    if (c < 0) return;
    if (!row_.is_integer(c)) return wrong(name);
    v = std::bit_cast<std::uint64_t>(row_.integer(c));
  }
  void operator()(const char* name, std::string& v) {
    const int c = next();
    if (c < 0 || row_.is_null(c)) return;
    if (!row_.is_text(c)) return wrong(name);
    v = row_.text(c);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* name, Enum& v, std::span<const std::string_view> names) {
    const int c = next();
    if (c < 0) return;
    const auto found = std::find(names.begin(), names.end(), row_.text(c));
    if (!row_.is_text(c) || found == names.end()) return wrong(name);
    v = static_cast<Enum>(found - names.begin());
  }
  void operator()(const char* name, SharedList<ParameterOverride>& list) {
    const auto json = json_text(name);
    if (!json) return;
    auto read = overrides_of(*json);
    if (!read) return wrong(name);
    list = *std::move(read);
  }
  void operator()(const char* name, SharedList<std::string>& list) {
    const auto json = json_text(name);
    if (!json) return;
    auto read = texts_of(*json);
    if (!read) return wrong(name);
    list = *std::move(read);
  }

  std::string wrong_columns;

 private:
  int next() { return place_[at_++]; }
  void wrong(const char* name) { add_word(wrong_columns, name); }
  bool number(const char* name, int c, float& v) {
    const double read = row_.number(c);
    if (!row_.is_number(c) || !(std::fabs(read) <= static_cast<double>(std::numeric_limits<float>::max())))
      return wrong(name), false;
    v = static_cast<float>(read);
    return true;
  }
  std::optional<Json> json_text(const char* name) {
    const int c = next();
    if (c < 0 || row_.is_null(c)) return {};
    auto json = row_.is_text(c) ? parse_json(row_.text(c)) : std::nullopt;
    if (!json) wrong(name);
    return json;
  }

  Statement& row_;
  const std::vector<int>& place_;
  std::size_t at_ = 0;
};

// A tree's fields as texts.
struct TextSink {
  std::vector<std::string> names, texts;

  void put(const char* name, std::string text) { names.emplace_back(name), texts.push_back(std::move(text)); }
  void operator()(const char* name, float v) { put(name, fmt::format("{}", v)); }
  void operator()(const char* name, const std::optional<float>& v) { put(name, v ? fmt::format("{}", *v) : ""); }
  void operator()(const char* name, bool v) { put(name, v ? "1" : "0"); }
  void operator()(const char* name, std::uint64_t v) { put(name, fmt::format("{}", v)); }
  void operator()(const char* name, const std::string& v) { put(name, v); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* name, Enum v, std::span<const std::string_view> words) {
    put(name, std::string(words[static_cast<std::size_t>(v)]));
  }
  void operator()(const char* name, const SharedList<ParameterOverride>& list) {
    put(name, list.empty() ? "" : text_of(json_of(list)));
  }
  void operator()(const char* name, const SharedList<std::string>& list) {
    put(name, list.empty() ? "" : text_of(Json(list.all())));
  }
};

// Puts a text into the field with this name.
struct TextSource {
  std::string_view name, text;
  bool done = false;

  template <class Number>
  bool number(Number& v) {
    Number read{};
    const auto [end, mistake] = std::from_chars(text.data(), text.data() + text.size(), read);
    if (mistake != std::errc() || end != text.data() + text.size()) return false;
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(read)) return false;
    v = read;
    return true;
  }
  void operator()(const char* field, float& v) {
    if (name == field) done = number(v);
  }
  void operator()(const char* field, std::optional<float>& v) {
    if (name == field) done = text.empty() || number(v.emplace());
  }
  void operator()(const char* field, bool& v) {
    if (name == field) done = text == "0" || text == "1", v = text == "1";
  }
  void operator()(const char* field, std::uint64_t& v) {
    if (name == field) done = number(v);
  }
  void operator()(const char* field, std::string& v) {
    if (name == field) done = true, v = text;
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const char* field, Enum& v, std::span<const std::string_view> words) {
    if (name != field) return;
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) return;
    v = static_cast<Enum>(found - words.begin()), done = true;
  }
  void operator()(const char* field, SharedList<ParameterOverride>& list) { list_of(field, list, overrides_of); }
  void operator()(const char* field, SharedList<std::string>& list) { list_of(field, list, texts_of); }

 private:
  template <class List, class Of>
  void list_of(const char* field, List& list, const Of& of) {
    if (name != field) return;
    if (text.empty()) return void(done = true);
    const auto json = parse_json(text);
    auto read = json ? of(*json) : std::nullopt;
    if (read) list = *std::move(read), done = true;
  }
};

// Sizes beyond these are nobody's tree.
constexpr float kLeastKeptScale = 0.001f, kMostKeptScale = 100.0f;

class TreeReader {
 public:
  TreeReader(Database& database, const Document& document) : document_(document) {
    for (std::size_t i = 0; const std::string& label : species_labels(document)) species_.emplace(label, i++);
    // Columns in our order, as far as the file has them.
    const std::vector<std::string> there = database.columns("trees");
    for (const auto& [name, type] : columns()) {
      const bool has = std::find(there.begin(), there.end(), name) != there.end();
      place_.push_back(has ? static_cast<int>(columns_++) : -1);
      if (has) add_word(select_, name);
    }
  }

  bool readable() const { return place_[0] == 0; }
  const std::string& select() const { return select_; }

  void take(Statement& row, ReadTrees& out) {
    Tree tree;
    const std::int64_t id = row.integer(0);
    Hasher128 hash;
    for (int c = 0; c < static_cast<int>(columns_); ++c) add_value(hash, row, c);
    if (id < 1 || id > std::numeric_limits<std::int32_t>::max()) {
      note(out, fmt::format("a tree with the id {} was left out", id));
      out.whole = false;
      return;
    }
    tree.id = static_cast<std::int32_t>(id);
    tree.key = hash_text("tree") + static_cast<std::uint64_t>(id);  // of trees that another program added

    const std::vector<int> rest(place_.begin() + 3, place_.end());
    RowSource source(row, rest);
    tree_columns(tree, source);
    std::string wrong = source.wrong_columns;
    const auto mistake = [&](const char* name) { add_word(wrong, name); };
    for (float* scale : {&tree.scale_height, &tree.scale_width})
      if (!(*scale >= kLeastKeptScale && *scale <= kMostKeptScale)) *scale = 1.0f, mistake("scale");
    if (place_[2] >= 0) {
      const auto found = species_.find(std::string(row.text(place_[2])));
      if (found != species_.end())
        tree.species = found->second;
      else
        mistake("species");
    }
    if (const auto place = place_[1] >= 0 ? place_of(row.bytes(place_[1])) : std::nullopt) {
      // The geometry counts where it is not what the columns say.
      if (*place != projected(tree.at, document_.place)) tree.at = Vec2(*place - document_.place.south_west);
    } else {
      mistake("geom");
    }
    if (!wrong.empty()) note(out, fmt::format("tree {}: no usable {}; a usual one stands in", tree.id, wrong));
    out.trees.push_back(std::move(tree));
    out.hashes.push_back(hash.digest());
  }

 private:
  static void add_value(Hasher128& hash, const Statement& row, int c) {
    if (row.is_null(c))
      hash.add(0);
    else if (row.is_integer(c))
      hash.add(1).add(std::bit_cast<std::uint64_t>(row.integer(c)));
    else if (row.is_number(c))
      hash.add(2).add(std::bit_cast<std::uint64_t>(row.number(c)));
    else if (row.is_text(c))
      hash.add(3).add(row.text(c));
    else
      hash.add(4).add(row.bytes(c));
  }
  static void note(ReadTrees& out, std::string words) {
    if (out.notes.size() < kMostNotes) out.notes.push_back(std::move(words));
  }

  const Document& document_;
  std::map<std::string, std::size_t> species_;
  std::vector<int> place_;  // of each column in the row, or -1
  std::size_t columns_ = 0;
  std::string select_;
};

// The pages of a damaged table may come in any order, and twice.
void put_in_order(ReadTrees& read) {
  const auto out_of_order = [](const Tree& a, const Tree& b) { return a.id >= b.id; };
  if (std::adjacent_find(read.trees.begin(), read.trees.end(), out_of_order) == read.trees.end()) return;
  read.whole = false;
  std::map<std::int32_t, std::size_t> place;
  for (std::size_t i = 0; i < read.trees.size(); ++i) place.emplace(read.trees[i].id, i);
  ReadTrees ordered;
  for (const auto& [id, i] : place)
    ordered.trees.push_back(std::move(read.trees[i])), ordered.hashes.push_back(read.hashes[i]);
  read.trees = std::move(ordered.trees), read.hashes = std::move(ordered.hashes);
}

}  // namespace

std::string tree_table() {
  std::string sql;
  for (const auto& [name, type] : columns()) add_word(sql, fmt::format("{} {}", name, type));
  return "CREATE TABLE trees (" + sql + ")";
}

std::vector<std::string> tree_field_names() {
  TextSink sink;
  const Tree tree;
  tree_columns(tree, sink);
  return sink.names;
}

std::vector<std::string> tree_fields(const Tree& tree) {
  TextSink sink;
  tree_columns(tree, sink);
  return sink.texts;
}

bool set_tree_field(Tree& tree, std::string_view name, std::string_view text) {
  TextSource source{name, text};
  tree_columns(tree, source);
  return source.done;
}

std::vector<std::string> species_labels(const Document& document) {
  std::vector<std::string> labels;
  for (const auto& species : document.species) {
    std::string label = species->name;
    for (int n = 2; std::find(labels.begin(), labels.end(), label) != labels.end(); ++n)
      label = fmt::format("{} ({})", species->name, n);
    labels.push_back(std::move(label));
  }
  return labels;
}

Result<TreeRows> TreeRows::writer(Database& database, const Document& document, std::int32_t srs) {
  std::string names, places;
  for (const auto& [name, type] : columns()) {
    add_word(names, name);
    add_word(places, "?");
  }
  auto put = database.prepare(fmt::format("INSERT OR REPLACE INTO trees ({}) VALUES ({})", names, places));
  if (!put) return put.error();
  auto remove = database.prepare("DELETE FROM trees WHERE id = ?");
  if (!remove) return remove.error();
  TreeRows rows(std::move(*put), std::move(*remove));
  rows.place_ = document.place;
  rows.labels_ = species_labels(document);
  rows.srs_ = srs;
  return rows;
}

Result<void> TreeRows::put(const Tree& tree) {
  RowSink sink(&put_);
  put_row(sink, tree, place_, labels_, srs_);
  return put_.run();
}

Result<void> TreeRows::remove(std::int32_t id) {
  remove_.bind(0, std::int64_t{id});
  return remove_.run();
}

Hash128 TreeRows::hash(const Tree& tree, const Georeference& place, const std::vector<std::string>& labels,
                       std::int32_t srs) {
  RowSink sink(nullptr);
  put_row(sink, tree, place, labels, srs);
  return sink.digest();
}

ReadTrees read_trees(Database& database, const Document& document) {
  ReadTrees out;
  TreeReader reader(database, document);
  auto forward = reader.readable() ? database.prepare("SELECT " + reader.select() + " FROM trees ORDER BY id")
                                   : Result<Statement>(Error{});
  if (!forward) return out.whole = false, out;
  while (forward->step()) reader.take(*forward, out);
  if (!forward->failed()) return put_in_order(out), out;

  // A damaged page ends the scan; what lies behind it is read from the other end.
  out.whole = false;
  ReadTrees behind;
  if (auto backward = database.prepare("SELECT " + reader.select() + " FROM trees ORDER BY id DESC"))
    while (backward->step()) {
      if (!out.trees.empty() && backward->integer(0) <= out.trees.back().id) break;
      reader.take(*backward, behind);
    }
  out.trees.insert(out.trees.end(), behind.trees.rbegin(), behind.trees.rend());
  out.hashes.insert(out.hashes.end(), behind.hashes.rbegin(), behind.hashes.rend());
  out.notes.insert(out.notes.end(), behind.notes.begin(), behind.notes.end());
  return put_in_order(out), out;
}

}  // namespace bosquet::scene
