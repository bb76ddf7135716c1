// Height maps: any bytes as a raster file.
#include <cstdint>
#include <cstdlib>

#include "exchange/elevation.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  static fuzz::TemporaryFile file(".tif");
  exchange::ElevationOptions options;
  options.max_cells = 1 << 16;
  const auto read = exchange::read_elevation(file.put(data, size), options);
  if (!read && read.error().message.empty()) std::abort();
  return 0;
}
