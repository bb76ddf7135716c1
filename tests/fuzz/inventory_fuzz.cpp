// Inventories: CSV by text, or GeoJSON by a file, as the first byte says.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "exchange/inventory.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  if (size == 0) return 0;
  exchange::InventoryOptions options;
  options.size_m = DVec2(100.0, 100.0);
  if (data[0] != '{') {
    const auto read = exchange::parse_inventory({reinterpret_cast<const char*>(data), size}, "fuzz.csv", options);
    if (!read && read.error().message.empty()) std::abort();
    return 0;
  }
  static fuzz::TemporaryFile file(".geojson");
  const auto read = exchange::read_inventory(file.put(data, size), options);
  if (!read && read.error().message.empty()) std::abort();
  return 0;
}
