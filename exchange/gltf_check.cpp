#include "exchange/gltf_check.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "core/vec.h"
#include "exchange/file_output.h"
#include "exchange/gltf_format.h"
#include "exchange/gltf_json.h"

namespace bosquet::exchange {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxBufferBytes = std::uint64_t{1} << 36;

std::uint64_t component_bytes(std::uint64_t type) {
  switch (type) {
    case kSignedByte:
    case kByte:
      return 1;
    case kSignedShort:
    case kShort:
      return 2;
    case kInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

std::uint64_t components(std::string_view type) {
  constexpr std::pair<std::string_view, std::uint64_t> kTypes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                                   {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, n] : kTypes)
    if (name == type) return n;
  return 0;
}

// a + b * c without overflow; the largest number when it does not fit.
std::uint64_t plus_times(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  if (b != 0 && c > kMost / b) return kMost;
  return a > kMost - b * c ? kMost : a + b * c;
}

struct Buffer {
  std::uint64_t length = 0;
  std::vector<std::byte> bytes;
  bool known = false;  ///< its bytes were read
};

struct View {
  std::uint64_t length = 0, stride = 0;
  std::span<const std::byte> bytes;
  std::vector<std::byte> unpacked;
  bool known = false;
};

struct Accessor {
  std::uint64_t view = 0, offset = 0, count = 0, component = 0, width = 0, stride = 0;
  bool normalized = false;
  bool fine = false;   ///< all numbers fit the view
  bool known = false;  ///< and its bytes can be read

  std::uint64_t size() const { return width * component_bytes(component); }
};

class Judge {
 public:
  Judge(const std::filesystem::path& path, const GltfJson& file) : path_(path), root_(file.root), file_(file) {}

  GltfCheck judge() {
    used_ = texts(member(root_, "extensionsUsed"));
    required_ = texts(member(root_, "extensionsRequired"));
    for (const std::string& name : required_)
      if (!has(used_, name)) fault("extension {} is required but not listed as used", name);
    read_buffers();
    read_views();
    read_accessors();
    for (std::size_t m = 0; m < length(list("meshes")); ++m) check_mesh(m);
    check_nodes();
    return std::move(out_);
  }

 private:
  template <class... Values>
  void fault(fmt::format_string<Values...> format, Values&&... values) {
    if (out_.faults.size() < kMostFaults)
      out_.faults.push_back(fmt::format(format, std::forward<Values>(values)...));
    else
      ++out_.more_faults;
  }

  const Json& list(const char* name) const { return member(root_, name); }
  static bool has(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  }
  // An extension that stands in the file must be named at its head.
  void meets(const char* name, const std::string& where) {
    if (!has(used_, name) && met_.insert(name).second) fault("{}: extension {} is not listed as used", where, name);
  }

  // --- bytes ---

  void read_buffers() {
    const Json& buffers = list("buffers");
    for (std::size_t b = 0; b < length(buffers); ++b) {
      Buffer& buffer = buffers_.emplace_back();
      buffer.length = whole(member(buffers[b], "byteLength"));
      if (buffer.length == 0) fault("buffer {}: byteLength is missing or 0", b);
      const Json& packed = member(member(buffers[b], "extensions"), "EXT_meshopt_compression");
      if (!packed.is_null()) meets("EXT_meshopt_compression", fmt::format("buffer {}", b));
      const Json& name = member(buffers[b], "uri");
      if (name.is_string()) {
        read_file_beside(b, name.get<std::string>(), buffer);
      } else if (b == 0 && file_.bin_offset > 0) {
        read_chunk(buffer);
      } else if (member(packed, "fallback") != Json(true)) {
        fault("buffer {}: it has neither a file nor data", b);
      }
      if (buffer.known && buffer.bytes.size() < buffer.length) {
        fault("buffer {}: {} bytes, but there are only {}", b, buffer.length, buffer.bytes.size());
        buffer.known = false;
      }
      data_bytes_ += buffer.bytes.size();
    }
  }

  void read_chunk(Buffer& buffer) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path_.c_str(), "rb"), std::fclose);
    buffer.bytes.resize(file_.bin_bytes);
    if (!file || ::fseeko(file.get(), static_cast<off_t>(file_.bin_offset), SEEK_SET) != 0 ||
        std::fread(buffer.bytes.data(), 1, buffer.bytes.size(), file.get()) != buffer.bytes.size())
      fault("buffer 0: its chunk cannot be read");
    else
      buffer.known = true;
  }

  void read_file_beside(std::size_t b, const std::string& name, Buffer& buffer) {
    if (name.rfind("data:", 0) == 0) return;
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
      unsigned code = 0;
      if (name[i] == '%' && i + 2 < name.size() && std::sscanf(name.c_str() + i + 1, "%2x", &code) == 1)
        plain += static_cast<char>(code), i += 2;
      else
        plain += name[i];
    }
    // Only what lies beside the file or below is looked at.
    const std::filesystem::path relative(plain);
    const bool inside = relative.is_relative() &&
                        std::none_of(relative.begin(), relative.end(), [](const auto& part) { return part == ".."; });
    if (!inside || plain.find("://") != std::string::npos) {
      fault("buffer {}: {} does not lie beside the file", b, name);
      return;
    }
    auto bytes = read_file(path_.parent_path() / relative, kMaxBufferBytes);
    if (!bytes) {
      fault("buffer {}: {}", b, bytes.error().message);
      return;
    }
    buffer.bytes = *std::move(bytes);
    buffer.known = true;
  }

  // The bytes [offset, offset + size) of a buffer; says what is wrong with them.
  std::optional<std::span<const std::byte>> slice(const Json& from, const std::string& where, std::uint64_t size) {
    const Json& number = member(from, "buffer");
    const std::uint64_t offset = whole(member(from, "byteOffset"));
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= buffers_.size()) {
      fault("{}: there is no buffer {}", where, number.dump());
      return {};
    }
    const Buffer& buffer = buffers_[number.get<std::size_t>()];
    if (plus_times(offset, size, 1) > buffer.length) {
      fault("{}: bytes {} to {} of a buffer of {}", where, offset, plus_times(offset, size, 1), buffer.length);
      return {};
    }
    if (!buffer.known) return {};
    return std::span(buffer.bytes).subspan(offset, size);
  }

  void read_views() {
    const Json& views = list("bufferViews");
    views_.resize(length(views));
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const std::string where = fmt::format("buffer view {}", v);
      View& view = views_[v];
      view.length = whole(member(views[v], "byteLength"));
      view.stride = whole(member(views[v], "byteStride"));
      if (view.length == 0) fault("{}: byteLength is missing or 0", where);
      if (view.stride != 0 && (view.stride < 4 || view.stride > 252 || view.stride % 4 != 0))
        fault("{}: a byteStride of {}; it is a multiple of 4 from 4 to 252", where, view.stride);
      if (const auto bytes = slice(views[v], where, view.length)) view.bytes = *bytes, view.known = true;
      const Json& packed = member(member(views[v], "extensions"), "EXT_meshopt_compression");
      if (!packed.is_null()) unpack(packed, where, view);
    }
  }

  void unpack(const Json& packed, const std::string& where, View& view) {
    meets("EXT_meshopt_compression", where);
    ++out_.packed_views;
    const std::uint64_t size = whole(member(packed, "byteLength")), stride = whole(member(packed, "byteStride")),
                        count = whole(member(packed, "count"));
    const std::string mode = text(member(packed, "mode")), filter = text(member(packed, "filter"));
    const auto bytes = slice(packed, where + ", packed", size);
    const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES", sequence = mode == "INDICES";
    const bool plain = view.known;  // beside it lies what it unpacks to
    view.known = false;
    if (!vertices && !triangles && !sequence) return fault("{}: there is no packing mode '{}'", where, mode);
    if (vertices ? stride == 0 || stride % 4 != 0 || stride > 256 : stride != 2 && stride != 4)
      return fault("{}: a stride of {} does not go with mode {}", where, stride, mode);
    if (triangles && count % 3 != 0) return fault("{}: {} indices are no triangles", where, count);
    if (view.stride != 0 && view.stride != stride)
      return fault("{}: a stride of {}, packed {}", where, view.stride, stride);
    if (count == 0 || plus_times(0, count, stride) != view.length)
      return fault("{}: {} bytes, packed {} times {}", where, view.length, count, stride);
    if (!bytes) return;
    // The least that so many elements take: two bits for 16 equal bytes, a byte for a triangle or an index. More would
    // be a bomb.
    const std::uint64_t least = vertices ? view.length / 64 : triangles ? count / 3 : count;
    if (least > size) return fault("{}: {} bytes cannot hold {} elements", where, size, count);
    unpacked_ += view.length;
    if (unpacked_ / 64 > data_bytes_) return fault("{}: the file's views unpack to over 64 times its data", where);
    view.unpacked.resize(view.length);
    const auto* data = reinterpret_cast<const unsigned char*>(bytes->data());
    const int failed = vertices    ? meshopt_decodeVertexBuffer(view.unpacked.data(), count, stride, data, size)
                       : triangles ? meshopt_decodeIndexBuffer(view.unpacked.data(), count, stride, data, size)
                                   : meshopt_decodeIndexSequence(view.unpacked.data(), count, stride, data, size);
    if (failed != 0) return fault("{}: its packed data cannot be unpacked (code {})", where, failed);
    if (!apply_filter(filter, where, view, count, stride, vertices)) return;
    if (plain && vertices && filter.empty() && !std::equal(view.bytes.begin(), view.bytes.end(), view.unpacked.begin()))
      fault("{}: the data for readers that cannot unpack differs from the unpacked", where);
    view.bytes = view.unpacked;
    view.known = true;
  }

  bool apply_filter(const std::string& filter, const std::string& where, View& view, std::uint64_t count,
                    std::uint64_t stride, bool vertices) {
    if (filter.empty() || filter == "NONE") return true;
    const bool oct = filter == "OCTAHEDRAL", quat = filter == "QUATERNION", exp = filter == "EXPONENTIAL";
    if (!vertices || !(oct ? stride == 4 || stride == 8 : quat ? stride == 8 : exp)) {
      fault("{}: filter {} does not go with a stride of {}", where, filter, stride);
      return false;
    }
    if (oct) meshopt_decodeFilterOct(view.unpacked.data(), count, stride);
    if (quat) meshopt_decodeFilterQuat(view.unpacked.data(), count, stride);
    if (exp) meshopt_decodeFilterExp(view.unpacked.data(), count, stride);
    return true;
  }

  // --- accessors ---

  void read_accessors() {
    const Json& accessors = list("accessors");
    accessors_.resize(length(accessors));
    out_.accessors = accessors_.size();
    for (std::size_t i = 0; i < accessors_.size(); ++i) read_accessor(i, accessors[i]);
  }

  void read_accessor(std::size_t i, const Json& from) {
    Accessor& a = accessors_[i];
    a.component = whole(member(from, "componentType"));
    a.width = components(text(member(from, "type")));
    a.count = whole(member(from, "count"));
    a.offset = whole(member(from, "byteOffset"));
    a.normalized = member(from, "normalized") == Json(true);
    if (component_bytes(a.component) == 0) return fault("accessor {}: there is no component type {}", i, a.component);
    if (a.width == 0) return fault("accessor {}: there is no type '{}'", i, text(member(from, "type")));
    if (a.count == 0) return fault("accessor {}: count is missing or 0", i);
    const Json& view_number = member(from, "bufferView");
    if (view_number.is_null()) return;  // all zero, or sparse
    if (!view_number.is_number_unsigned() || view_number.get<std::uint64_t>() >= views_.size())
      return fault("accessor {}: there is no buffer view {}", i, view_number.dump());
    a.view = view_number.get<std::uint64_t>();
    const View& view = views_[a.view];
    a.stride = view.stride != 0 ? view.stride : a.size();
    if (a.stride < a.size()) return fault("accessor {}: elements of {} bytes every {} bytes", i, a.size(), a.stride);
    if (a.offset % component_bytes(a.component) != 0)
      return fault("accessor {}: it begins at byte {}, no multiple of {}", i, a.offset, component_bytes(a.component));
    if (plus_times(plus_times(a.offset, a.size(), 1), a.count - 1, a.stride) > view.length)
      return fault("accessor {}: {} elements every {} bytes from {} on do not fit a view of {} bytes", i, a.count,
                   a.stride, a.offset, view.length);
    a.fine = true;
    a.known = view.known && member(from, "sparse").is_null();
  }

  // The accessor with this number, if it is a good one; says so if it is not there.
  const Accessor* accessor(const Json& number, const std::string& where) {
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= accessors_.size()) {
      fault("{}: there is no accessor {}", where, number.dump());
      return nullptr;
    }
    return &accessors_[number.get<std::size_t>()];
  }

  const std::byte* at(const Accessor& a, std::uint64_t k) const {
    return views_[a.view].bytes.data() + a.offset + k * a.stride;
  }
  template <class T>
  static T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  // Component c of element k, normalized ones in -1..1.
  double value(const Accessor& a, std::uint64_t k, std::uint64_t c) const {
    const std::byte* p = at(a, k) + c * component_bytes(a.component);
    const auto scaled = [&](double v, double most) { return a.normalized ? std::max(v / most, -1.0) : v; };
    switch (a.component) {
      case kSignedByte:
        return scaled(load<std::int8_t>(p), 127.0);
      case kByte:
        return scaled(load<std::uint8_t>(p), 255.0);
      case kSignedShort:
        return scaled(load<std::int16_t>(p), 32767.0);
      case kShort:
        return scaled(load<std::uint16_t>(p), 65535.0);
      case kInt:
        return load<std::uint32_t>(p);
      default:
        return static_cast<double>(load<float>(p));
    }
  }

  // The first element with a number that is not finite.
  std::optional<std::uint64_t> not_finite(const Accessor& a) const {
    if (a.component != kFloat) return {};
    for (std::uint64_t k = 0; k < a.count; ++k)
      for (std::uint64_t c = 0; c < a.width; ++c)
        if (!std::isfinite(load<float>(at(a, k) + 4 * c))) return k;
    return {};
  }

  // --- meshes ---

  void check_mesh(std::size_t m) {
    const Json& primitives = member(list("meshes")[m], "primitives");
    if (length(primitives) == 0) return fault("mesh {}: it has no primitives", m);
    for (std::size_t p = 0; p < length(primitives); ++p)
      check_primitive(primitives[p], fmt::format("mesh {}, primitive {}", m, p));
  }

  void check_primitive(const Json& primitive, const std::string& where) {
    const Json& attributes = member(primitive, "attributes");
    std::optional<std::uint64_t> vertices;
    if (attributes.is_object())
      for (const auto& [name, number] : attributes.items()) {
        const Accessor* a = accessor(number, where + ", " + name);
        if (!a) continue;
        if (!vertices) vertices = a->count;
        if (a->count != *vertices) fault("{}: {} has {} elements, others {}", where, name, a->count, *vertices);
        if (checked_.insert({number.get<std::size_t>(), name == "POSITION" ? 1 : name == "_WIND" ? 2 : 0}).second)
          check_attribute(name, number.get<std::size_t>());
      }
    if (!vertices) return fault("{}: it has no attributes", where);
    const Json& number = member(primitive, "indices");
    if (number.is_null()) return;
    const Accessor* a = accessor(number, where + ", indices");
    if (!a || !a->known) return;
    if (a->width != 1 || (a->component != kByte && a->component != kShort && a->component != kInt))
      return fault("{}: indices of a wrong type", where);
    const auto [most, fresh] = most_index_.try_emplace(number.get<std::size_t>(), 0);
    if (fresh)
      for (std::uint64_t k = 0; k < a->count; ++k)
        most->second = std::max(most->second, static_cast<std::uint64_t>(value(*a, k, 0)));
    if (most->second >= *vertices) fault("{}: index {} of only {} vertices", where, most->second, *vertices);
  }

  void check_attribute(const std::string& name, std::size_t number) {
    const Accessor& a = accessors_[number];
    if (!a.known) return;
    if (const auto k = not_finite(a)) return fault("accessor {} ({}): element {} is not finite", number, name, *k);
    if (name == "_WIND") return check_wind(a, number);
    if (name != "POSITION") return;
    if (a.width != 3) return fault("accessor {}: positions have three numbers", number);
    const Json &low = member(list("accessors")[number], "min"), &high = member(list("accessors")[number], "max");
    if (length(low) != 3 || length(high) != 3) return fault("accessor {}: positions need min and max", number);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!low[c].is_number() || !high[c].is_number()) return fault("accessor {}: min and max are no numbers", number);
      // The texts of floats may be rounded.
      const double l = low[c].get<double>(), h = high[c].get<double>();
      const double slack = a.component == kFloat ? 1e-6 * (std::abs(l) + std::abs(h)) : 0.0;
      // Bounds are of the stored numbers, normalized or not.
      Accessor stored = a;
      stored.normalized = false;
      for (std::uint64_t k = 0; k < a.count; ++k)
        if (const double v = value(stored, k, c); !(v >= l - slack && v <= h + slack))
          return fault("accessor {}: position {} has {} outside of {} to {}", number, k, v, l, h);
    }
  }

  // Ways, flutter and phase are shares of one.
  void check_wind(const Accessor& a, std::size_t number) {
    const bool whole = a.component == kByte || a.component == kShort;
    if (a.width != 4 || !(a.component == kFloat || (whole && a.normalized)))
      return fault("accessor {} (_WIND): four floats, normalized bytes or normalized shorts", number);
    for (std::uint64_t k = 0; k < a.count; ++k)
      for (std::uint64_t c = 0; c < 4; ++c)
        if (const double v = value(a, k, c); !(v >= 0.0 && v <= 1.0))
          return fault("accessor {} (_WIND): {} of element {} does not lie in 0 to 1", number, v, k);
  }

  // --- nodes ---

  void check_nodes() {
    const Json& nodes = list("nodes");
    const std::size_t n = length(nodes);
    std::vector<std::size_t> parent(n, n);
    const auto in_range = [&](const Json& number) {
      return number.is_number_unsigned() && number.get<std::uint64_t>() < n;
    };
    for (std::size_t i = 0; i < n; ++i) {
      const Json& children = member(nodes[i], "children");
      for (std::size_t c = 0; c < length(children); ++c) {
        if (!in_range(children[c])) {
          fault("node {}: there is no node {}", i, children[c].dump());
        } else if (std::size_t& of = parent[children[c].get<std::size_t>()]; of != n) {
          fault("node {}: it is a child of nodes {} and {}", children[c].dump(), of, i);
        } else {
          of = i;
        }
      }
      const Json& mesh = member(nodes[i], "mesh");
      if (!mesh.is_null() && (!mesh.is_number_unsigned() || mesh.get<std::uint64_t>() >= length(list("meshes"))))
        fault("node {}: there is no mesh {}", i, mesh.dump());
      check_instances(nodes[i], i);
    }
    circles(parent, "node {}: it is below itself");
    check_levels(nodes, in_range);
  }

  // Follows each chain upward once; a chain that meets itself is a circle.
  void circles(const std::vector<std::size_t>& parent, fmt::format_string<std::size_t&> message) {
    const std::size_t n = parent.size();
    std::vector<std::size_t> seen(n, n);
    for (std::size_t start = 0; start < n; ++start) {
      std::size_t i = start;
      while (i != n && seen[i] == n) seen[i] = start, i = parent[i];
      if (i != n && seen[i] == start) fault(message, i);
    }
  }

  void check_instances(const Json& node, std::size_t i) {
    const Json& extension = member(member(node, "extensions"), "EXT_mesh_gpu_instancing");
    if (extension.is_null()) return;
    const std::string where = fmt::format("node {}, instances", i);
    meets("EXT_mesh_gpu_instancing", where);
    if (!has(required_, "EXT_mesh_gpu_instancing") && met_.insert("instances required").second)
      fault("EXT_mesh_gpu_instancing is not listed as required: readers without it would show one instance");
    if (member(node, "mesh").is_null()) fault("{}: the node has no mesh", where);
    const Json& attributes = member(extension, "attributes");
    if (!attributes.is_object() || attributes.empty()) return fault("{}: there are no attributes", where);
    std::optional<std::uint64_t> count;
    for (const auto& [name, number] : attributes.items()) {
      const Accessor* a = accessor(number, where + ", " + name);
      if (!a) continue;
      if (!count) count = a->count, out_.instances += a->count;
      if (a->count != *count) fault("{}: {} for {} instances, others for {}", where, name, a->count, *count);
      const bool place = name == "TRANSLATION", turn = name == "ROTATION", size = name == "SCALE";
      if (!place && !turn && !size && (name.empty() || name[0] != '_'))
        fault("{}: there is no attribute {}; own names begin with _", where, name);
      if ((place || size) && !(a->width == 3 && a->component == kFloat)) fault("{}: {} has three floats", where, name);
      const bool small = (a->component == kSignedByte || a->component == kSignedShort) && a->normalized;
      if (turn && !(a->width == 4 && (a->component == kFloat || small)))
        fault("{}: ROTATION has four floats or normalized signed bytes or shorts", where);
      if (!a->known || !checked_.insert({number.get<std::size_t>(), turn}).second) continue;
      if (turn && a->width == 4) check_turns(*a, where);
      if (const auto k = not_finite(*a)) fault("{}: {} of instance {} is not finite", where, name, *k);
    }
  }

  void check_turns(const Accessor& a, const std::string& where) {
    const double slack = a.component == kSignedByte ? 0.03 : 0.002;
    for (std::uint64_t k = 0; k < a.count; ++k) {
      double squares = 0;
      for (std::uint64_t c = 0; c < 4; ++c) squares += value(a, k, c) * value(a, k, c);
      if (!(std::abs(std::sqrt(squares) - 1.0) <= slack))
        return fault("{}: the rotation of instance {} has length {:.4g}, not 1", where, k, std::sqrt(squares));
    }
  }

  template <class InRange>
  void check_levels(const Json& nodes, const InRange& in_range) {
    // The node whose coarser level a node is; more than one level up is a chain.
    const std::size_t n = length(nodes);
    std::vector<std::size_t> finer(n, n);
    for (std::size_t i = 0; i < n; ++i) {
      const Json& extension = member(member(nodes[i], "extensions"), "MSFT_lod");
      if (extension.is_null()) continue;
      meets("MSFT_lod", fmt::format("node {}", i));
      ++out_.nodes_with_levels;
      const Json& ids = member(extension, "ids");
      if (length(ids) == 0) fault("node {}, levels: there are no ids", i);
      std::set<std::size_t> seen;
      for (std::size_t k = 0; k < length(ids); ++k) {
        if (!in_range(ids[k])) {
          fault("node {}, levels: there is no node {}", i, ids[k].dump());
          continue;
        }
        const auto id = ids[k].get<std::size_t>();
        if (!seen.insert(id).second) fault("node {}, levels: node {} stands there twice", i, id);
        if (id == i) fault("node {}: it is a coarser level of itself", i);
        if (id != i && finer[id] == n) finer[id] = i;
      }
      const Json& coverage = member(member(nodes[i], "extras"), "MSFT_screencoverage");
      if (coverage.is_null()) continue;
      // One for each level, or also where nothing more is drawn.
      if (length(coverage) != length(ids) + 1 && length(coverage) != length(ids))
        fault("node {}: {} screen coverages for {} levels", i, length(coverage), length(ids) + 1);
      double before = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < length(coverage); ++k) {
        const double now = coverage[k].is_number() ? coverage[k].get<double>() : -1.0;
        if (!(now >= 0.0 && now <= before)) {
          fault("node {}: screen coverage {} is {}; they fall from level to level, none below 0", i, k,
                coverage[k].dump());
          break;
        }
        before = now;
      }
    }
    circles(finer, "node {}: its coarser levels lead back to it");
  }

  const std::filesystem::path& path_;
  const Json& root_;
  const GltfJson& file_;
  GltfCheck out_;
  std::vector<std::string> used_, required_;
  std::set<std::string> met_;
  std::set<std::pair<std::size_t, int>> checked_;    ///< accessors, and as what
  std::map<std::size_t, std::uint64_t> most_index_;  ///< of index accessors
  std::uint64_t data_bytes_ = 0, unpacked_ = 0;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
};

}  // namespace

Result<GltfCheck> check_gltf(const std::filesystem::path& path) {
  const auto file = read_gltf_json(path);
  if (!file) return file.error();
  return Judge(path, *file).judge();
}

}  // namespace bosquet::exchange
