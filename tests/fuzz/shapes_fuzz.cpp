// Areas and outlines: any bytes as GeoJSON, with and without a site that they are cut to.
#include <cstdint>
#include <cstdlib>

#include "exchange/footprints.h"
#include "exchange/shapes.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  static fuzz::TemporaryFile file(".geojson");
  const auto& path = file.put(data, size);
  exchange::ShapeOptions options;
  options.attributes = {"kind", "width_m", "level_m"};
  options.size_m = DVec2(100.0, 80.0);
  const auto shapes = exchange::read_shapes(path, {}, options);
  if (!shapes && shapes.error().message.empty()) std::abort();
  const auto outlines = exchange::read_footprints(path, {});
  if (!outlines && outlines.error().message.empty()) std::abort();
  return 0;
}
