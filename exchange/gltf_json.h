// glTF JSON: the JSON of a .glb or .gltf file that may be anything, and ways to look into it without trusting it.
//
// Errors    no regular file, no glTF 2.0, cut short, over kMaxJsonBytes or nested deeper than kMaxDepth: one message that
//           names the file
// Header    includes nlohmann/json.hpp: for the sources of exchange/ that read glTF alone
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/result.h"

namespace bosquet::exchange {

inline constexpr std::uint64_t kMaxJsonBytes = std::uint64_t{1} << 30;
inline constexpr int kMaxDepth = 64;  ///< what parses, prints or copies JSON does so by recursion

struct GltfJson {
  nlohmann::json root;  ///< an object with asset.version 2.x
  std::uint64_t file_bytes = 0;
  std::uint64_t bin_offset = 0;  ///< of the data of a .glb's second chunk; 0: there is none
  std::uint64_t bin_bytes = 0;
};

Result<GltfJson> read_gltf_json(const std::filesystem::path& path);

/// What is not as it should be is missing: null, 0, empty.
const nlohmann::json& member(const nlohmann::json& object, const char* name);
const nlohmann::json& element(const nlohmann::json& array, const nlohmann::json& index);
std::size_t length(const nlohmann::json& array);
std::string text(const nlohmann::json& value);
std::uint64_t whole(const nlohmann::json& value);
std::vector<std::string> texts(const nlohmann::json& array);

}  // namespace bosquet::exchange
