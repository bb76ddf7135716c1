// Pictures: any bytes as PNG or JPEG, of at most a million pixels.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "exchange/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  const auto image = exchange::decode_image(std::as_bytes(std::span(data, size)), "fuzz", 1'000'000);
  if (!image && image.error().message.empty()) std::abort();
  return 0;
}
