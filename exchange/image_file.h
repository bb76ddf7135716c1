// Image files: PNG and JPEG, to and from bytes in memory or files.
//
// PNG       libpng, 8 bits, deflate level 3 (a tenth larger than level 9 at a fraction of its time); lossless
// JPEG      libjpeg, quality 90; alpha is dropped. Colour is stored at half resolution (4:2:0), normal maps must keep
//           it (4:4:4), as their directions live there.
// Reading   16-bit samples are cut to 8, palettes and bit masks expanded; channels come out as 1, 3 or 4 (grey with
//           alpha as 4)
// Errors    a file that is neither, is damaged, or larger than the limits: one message that names it
// Holds     no time stamps or text chunks: same image, same bytes
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/result.h"

namespace bosquet::exchange {

enum class ImageFormat { png, jpeg };
enum class Chroma { half, full };

using Bytes = std::vector<std::byte>;

/// The image has 1, 3 or 4 channels and is not empty.
Bytes encode_png(const Image& image);
Bytes encode_jpeg(const Image& image, Chroma chroma = Chroma::half);

/// Hostile input is safe: nothing over `max_pixels` is allocated. `name` is for messages.
inline constexpr std::size_t kMaxPixels = std::size_t{1} << 28;
Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name,
                           std::size_t max_pixels = kMaxPixels);

/// By the path's ending: .png, .jpg or .jpeg.
Result<void> write_image(const std::filesystem::path& path, const Image& image);
Result<Image> read_image(const std::filesystem::path& path);

}  // namespace bosquet::exchange
