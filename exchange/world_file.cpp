#include "exchange/world_file.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "core/letters.h"
#include "exchange/file_output.h"
#include "exchange/image_file.h"

namespace bosquet::exchange {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestWorldFile = 4096;
constexpr double kSquare = 1e-3;      ///< pixels differ by less
constexpr double kLeastPixel = 1e-4;  ///< of a map in metres; below it is one in degrees
constexpr double kMostPixel = 1e4;

// ".png" has ".pgw": the first and the last letter; ".pngw" and ".wld" are usual too.
std::vector<std::string> world_endings(const fs::path& picture) {
  const std::string ending = lower_ending(picture);
  if (ending.size() < 3) return {".wld"};
  return {fmt::format(".{}{}w", ending[1], ending.back()), ending + "w", ".wld"};
}

std::optional<std::array<double, 6>> six_numbers(std::string_view text) {
  std::array<double, 6> numbers{};
  const char *at = text.data(), *const end = at + text.size();
  const auto skip = [&] {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == '\n')) ++at;
  };
  for (double& number : numbers) {
    skip();
    if (at != end && *at == '+') ++at;
    const auto [after, problem] = std::from_chars(at, end, number);
    if (problem != std::errc() || !std::isfinite(number)) return {};
    at = after;
  }
  skip();
  if (at != end) return {};
  return numbers;
}

}  // namespace

std::optional<fs::path> world_file_of(const fs::path& picture) {
  // Whatever the case of its letters: PLAN.PGW beside plan.png.
  const std::vector<std::string> endings = world_endings(picture);
  const std::string stem = folded_letters(picture.stem().string());
  std::array<fs::path, 3> found;
  std::error_code ec;
  fs::directory_iterator entry(picture.has_parent_path() ? picture.parent_path() : fs::path("."), ec), end;
  for (; !ec && entry != end; entry.increment(ec)) {
    const fs::path& file = entry->path();
    for (std::size_t i = 0; i < endings.size(); ++i)
      if (lower_ending(file) == endings[i] && folded_letters(file.stem().string()) == stem &&
          (found[i].empty() || file.stem() == picture.stem()))
        found[i] = file;
  }
  for (const fs::path& file : found)
    if (!file.empty()) return file;
  return {};
}

Result<PicturePlace> read_world_file(const fs::path& file, int width_px, int height_px) {
  const auto bytes = read_file(file, kLargestWorldFile);
  if (!bytes) return bytes.error();
  const auto n = six_numbers({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!n)
    return Error{fmt::format("{}: a world file holds six numbers, a line each, with a decimal point", file.string())};
  const auto [a, d, b, e, c, f] = *n;
  // Turned by half a turn or mirrored a picture has no place that could be kept.
  const double across = std::hypot(a, d), down = std::hypot(b, e);
  if (!(a > 0.0) || !(e < 0.0) || !(across < kMostPixel))
    return Error{fmt::format("{}: pixels of {:g} by {:g} map units; the first must be above 0, the fourth number below",
                             file.string(), a, e)};
  if (across < kLeastPixel)
    return Error{fmt::format("{}: pixels of {:g} map units are in degrees, it seems; the site is in metres",
                             file.string(), across)};
  PicturePlace place;
  place.width = across * width_px;
  if (const double turn_deg = std::atan2(d, a) * 180.0 / 3.14159265358979323846; std::abs(turn_deg) > 0.01)
    place.notes.push_back(
        fmt::format("{}: the picture is turned by {:.2f} degrees there, and laid without", file.string(), turn_deg));
  if (std::abs(down / across - 1.0) > kSquare)
    place.notes.push_back(
        fmt::format("{}: pixels are not square; the picture's height follows its width", file.string()));
  // About the middle, so that what was left out moves the edges alone.
  const DVec2 middle(c + 0.5 * (a * (width_px - 1) + b * (height_px - 1)),
                     f + 0.5 * (d * (width_px - 1) + e * (height_px - 1)));
  place.south_west = middle - 0.5 * DVec2(place.width, across * height_px);
  return place;
}

Result<bool> lay_by_world_file(scene::Underlay& underlay, const FromWorldFile& wanted, const scene::Georeference& site,
                               DVec2 size_m, std::vector<std::string>& notes) {
  const auto file = world_file_of(underlay.file);
  if (!file) return false;
  auto image = read_image(underlay.file);
  if (!image) return image.error();
  auto place = read_world_file(*file, image->width, image->height);
  if (!place) return place.error();
  notes.insert(notes.end(), place->notes.begin(), place->notes.end());
  if (wanted.width) underlay.width_m = static_cast<float>(place->width);
  if (!wanted.corner) return true;
  const DVec2 low = place->south_west - site.south_west;
  const DVec2 high = low + place->width * DVec2(1.0, static_cast<double>(image->height) / image->width);
  if (high.x > 0.0 && high.y > 0.0 && low.x < size_m.x && low.y < size_m.y) {
    underlay.south_west = low;
    return true;
  }
  const double away_km = 1e-3 * glm::length(0.5 * (low + high) - 0.5 * size_m);
  notes.push_back(fmt::format(
      "{}: lays the picture {:.{}f} km from the site, {}; it is at the site's corner", file->string(), away_km,
      away_km < 10 ? 2 : 0,
      site.crs_wkt.empty() && site.south_west == DVec2(0.0) ? "which lies nowhere on the map" : "which is elsewhere"));
  return true;
}

}  // namespace bosquet::exchange
