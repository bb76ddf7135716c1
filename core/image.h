// Image: rows of 8-bit pixels, first row at the top, channels interleaved (1 grey, 3 RGB, 4 RGBA). Colour images hold
// sRGB; normal maps and other data are linear.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bosquet {

struct Image {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> pixels;

  Image() = default;
  Image(int columns, int rows, int channel_count)
      : width(columns),
        height(rows),
        channels(channel_count),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) *
               static_cast<std::size_t>(channel_count)) {}

  bool empty() const { return pixels.empty(); }
  std::uint8_t* at(int x, int y) { return pixels.data() + offset(x, y); }
  const std::uint8_t* at(int x, int y) const { return pixels.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

}  // namespace bosquet
