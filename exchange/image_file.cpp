#include "exchange/image_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
// after cstdio
#include <jpeglib.h>

#include "exchange/file_output.h"

namespace bosquet::exchange {
namespace {

constexpr int kPngLevel = 3;
constexpr int kJpegQuality = 90;
constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;

// --- PNG ---

void append_png(png_structp png, png_bytep data, png_size_t n) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  const auto* from = reinterpret_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), from, from + n);
}

// libpng's simplified reader does the whole of palettes, 16 bits, transparency and interlacing.
Result<Image> decode_png(std::span<const std::byte> bytes, const std::string& name, std::size_t max_pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
    return Error{fmt::format("{} is not a PNG that can be read: {}", name, png.message)};
  const std::size_t pixels = std::size_t{png.width} * png.height;
  if (pixels > max_pixels || png.width > 1u << 20 || png.height > 1u << 20) {
    const auto error =
        fmt::format("{} has {} x {} pixels; at most {} are read", name, png.width, png.height, max_pixels);
    png_image_free(&png);
    return Error{error};
  }
  const bool alpha = png.format & PNG_FORMAT_FLAG_ALPHA, colour = png.format & PNG_FORMAT_FLAG_COLOR;
  png.format = alpha ? PNG_FORMAT_RGBA : colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height), alpha ? 4 : colour ? 3 : 1);
  if (!png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr))
    return Error{fmt::format("{} is damaged: {}", name, png.message)};
  return image;
}

// --- JPEG ---

// libjpeg's way out of an error is a long jump; nothing with a destructor may live between setjmp and the jump.
struct JpegFailure {
  jpeg_error_mgr base;
  std::jmp_buf out;
  char text[JMSG_LENGTH_MAX];
};

void fail_jpeg(j_common_ptr common) {
  auto* failure = reinterpret_cast<JpegFailure*>(common->err);
  common->err->format_message(common, failure->text);
  std::longjmp(failure->out, 1);
}
void silent_jpeg(j_common_ptr) {}

bool read_jpeg_header(jpeg_decompress_struct& jpeg, JpegFailure& failure, std::span<const std::byte> bytes) {
  if (setjmp(failure.out)) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  return true;
}

bool read_jpeg_rows(jpeg_decompress_struct& jpeg, JpegFailure& failure, Image& image) {
  if (setjmp(failure.out)) return false;
  jpeg.out_color_space = image.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.at(0, static_cast<int>(jpeg.output_scanline));
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

Result<Image> decode_jpeg(std::span<const std::byte> bytes, const std::string& name, std::size_t max_pixels) {
  JpegFailure failure{};
  jpeg_decompress_struct jpeg{};
  jpeg.err = jpeg_std_error(&failure.base);
  failure.base.error_exit = fail_jpeg;
  failure.base.output_message = silent_jpeg;
  struct Cleanup {
    jpeg_decompress_struct& jpeg;
    ~Cleanup() { jpeg_destroy_decompress(&jpeg); }
  } cleanup{jpeg};

  if (!read_jpeg_header(jpeg, failure, bytes))
    return Error{fmt::format("{} is not a JPEG that can be read: {}", name, failure.text)};
  if (std::size_t{jpeg.image_width} * jpeg.image_height > max_pixels)
    return Error{fmt::format("{} has {} x {} pixels; at most {} are read", name, jpeg.image_width, jpeg.image_height,
                             max_pixels)};
  Image image(static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height),
              jpeg.num_components == 1 ? 1 : 3);
  if (!read_jpeg_rows(jpeg, failure, image)) return Error{fmt::format("{} is damaged: {}", name, failure.text)};
  if (failure.base.num_warnings > 0) return Error{fmt::format("{} is damaged: its data end early or are wrong", name)};
  return image;
}

bool starts_with(std::span<const std::byte> bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

Result<ImageFormat> format_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".jpg" || ending == ".jpeg") return ImageFormat::jpeg;
  return Error{fmt::format("{}: an image file ends in .png, .jpg or .jpeg", path.string())};
}

}  // namespace

Bytes encode_png(const Image& image) {
  assert(!image.empty() && (image.channels == 1 || image.channels == 3 || image.channels == 4));
  Bytes bytes;
  bytes.reserve(image.pixels.size() / 2);
  // Only running out of memory can fail here; libpng then ends by its own long jump, past nothing of ours.
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append_png, nullptr);
  png_set_compression_level(png, kPngLevel);
  const int colour = image.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : image.channels == 3 ? PNG_COLOR_TYPE_RGB
                                           : PNG_COLOR_TYPE_RGB_ALPHA;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8, colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.at(0, y));
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

Bytes encode_jpeg(const Image& image, Chroma chroma) {
  assert(!image.empty() && (image.channels == 1 || image.channels == 3 || image.channels == 4));
  assert(image.width <= JPEG_MAX_DIMENSION && image.height <= JPEG_MAX_DIMENSION);
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &data, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width);
  jpeg.image_height = static_cast<JDIMENSION>(image.height);
  jpeg.input_components = image.channels;
  jpeg.in_color_space = image.channels == 1 ? JCS_GRAYSCALE : image.channels == 3 ? JCS_RGB : JCS_EXT_RGBX;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, kJpegQuality, TRUE);
  jpeg.dct_method = JDCT_ISLOW;  // the integer transform: the same bits on every machine
  if (image.channels != 1 && chroma == Chroma::full)
    jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<JSAMPROW>(image.at(0, static_cast<int>(jpeg.next_scanline)));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const auto* begin = reinterpret_cast<const std::byte*>(data);
  Bytes bytes(begin, begin + size);
  std::free(data);
  return bytes;
}

Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name, std::size_t max_pixels) {
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return decode_png(bytes, name, max_pixels);
  if (starts_with(bytes, "\xff\xd8\xff")) return decode_jpeg(bytes, name, max_pixels);
  return Error{fmt::format("{} is neither PNG nor JPEG", name)};
}

Result<void> write_image(const std::filesystem::path& path, const Image& image) {
  const auto format = format_of(path);
  if (!format) return format.error();
  const Bytes bytes = *format == ImageFormat::png ? encode_png(image) : encode_jpeg(image);
  const auto written = write_file(path, std::span<const std::byte>(bytes));
  if (!written) return written.error();
  return {};
}

Result<Image> read_image(const std::filesystem::path& path) {
  const auto bytes = read_file(path, kMaxFileBytes);
  if (!bytes) return bytes.error();
  return decode_image(*bytes, path.string());
}

}  // namespace bosquet::exchange
