#include "exchange/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>

#include "exchange/gltf_format.h"

namespace bosquet::exchange {

using Json = nlohmann::json;

namespace {

struct JsonText {
  std::string text;
  std::uint64_t file_bytes = 0, bin_offset = 0, bin_bytes = 0;
};

// The JSON chunk of a .glb, or the whole of a .gltf.
Result<JsonText> read_json_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) return Error{fmt::format("there is no file {}", name)};
  if (!std::filesystem::is_regular_file(status))
    return Error{fmt::format("cannot read {}: it is no regular file", name)};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return Error{fmt::format("cannot read {}: {}", name, std::strerror(errno))};

  JsonText out;
  out.file_bytes = std::filesystem::file_size(path, failed);
  if (failed) return Error{fmt::format("cannot read {}: {}", name, failed.message())};
  std::uint32_t header[5] = {};
  const std::size_t words = std::fread(header, 4, 5, file.get());
  std::uint64_t length = out.file_bytes;
  if (words > 0 && header[0] == kGlbMagic) {
    if (words < 5 || header[4] != kJsonChunk) return Error{fmt::format("{} is a .glb without a JSON chunk", name)};
    if (header[1] != 2) return Error{fmt::format("{} is glTF version {}; version 2 is read", name, header[1])};
    if (header[2] > out.file_bytes || header[3] > header[2] - 20)
      return Error{fmt::format("{} is cut short: it says {} bytes and has {}", name, header[2], out.file_bytes)};
    length = header[3];
  } else {
    std::rewind(file.get());
  }
  if (length > kMaxJsonBytes)
    return Error{fmt::format("{}: {} bytes of JSON; at most {} are read", name, length, kMaxJsonBytes)};
  out.text.resize(length);
  if (std::fread(out.text.data(), 1, length, file.get()) != length)
    return Error{fmt::format("cannot read all of {}", name)};
  // Behind the JSON of a .glb may come one chunk of data.
  std::uint32_t chunk[2] = {};
  if (words == 5 && header[0] == kGlbMagic && header[2] - 20 - length >= 8 &&
      std::fread(chunk, 4, 2, file.get()) == 2 && chunk[1] == kBinChunk) {
    out.bin_offset = 28 + length;
    out.bin_bytes = chunk[0];
    if (out.bin_bytes > header[2] - out.bin_offset)
      return Error{fmt::format("{} is cut short: its data chunk says {} bytes and the file has {} for it", name,
                               out.bin_bytes, header[2] - out.bin_offset)};
  }
  return out;
}

// How deep brackets nest, strings apart: what parses such text, prints or copies it by recursion.
int nesting(std::string_view json) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (quoted) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

Result<GltfJson> read_gltf_json(const std::filesystem::path& path) {
  const std::string name = path.string();
  auto json = read_json_text(path);
  if (!json) return json.error();
  if (nesting(json->text) > kMaxDepth)
    return Error{fmt::format("{}: JSON nested deeper than {} levels is not read", name, kMaxDepth)};
  GltfJson out;
  out.root = Json::parse(json->text, nullptr, false);
  if (out.root.is_discarded() || !out.root.is_object())
    return Error{fmt::format("{} is no glTF: its JSON cannot be read", name)};
  const std::string version = text(member(member(out.root, "asset"), "version"));
  if (version.empty()) return Error{fmt::format("{} is no glTF: it has no asset.version", name)};
  if (version.rfind("2.", 0) != 0) return Error{fmt::format("{} is glTF version {}; version 2 is read", name, version)};
  out.file_bytes = json->file_bytes;
  out.bin_offset = json->bin_offset;
  out.bin_bytes = json->bin_bytes;
  return out;
}

const Json& member(const Json& object, const char* name) {
  static const Json kNothing;
  if (!object.is_object()) return kNothing;
  const auto it = object.find(name);
  return it == object.end() ? kNothing : *it;
}
const Json& element(const Json& array, const Json& index) {
  static const Json kNothing;
  if (!array.is_array() || !index.is_number_unsigned()) return kNothing;
  const auto i = index.get<std::uint64_t>();
  return i < array.size() ? array[i] : kNothing;
}
std::size_t length(const Json& array) { return array.is_array() ? array.size() : 0; }
std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }
std::uint64_t whole(const Json& value) { return value.is_number_unsigned() ? value.get<std::uint64_t>() : 0; }
std::vector<std::string> texts(const Json& array) {
  std::vector<std::string> out;
  if (array.is_array())
    for (const Json& value : array) out.push_back(text(value));
  return out;
}

}  // namespace bosquet::exchange
