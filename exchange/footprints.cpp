#include "exchange/footprints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "exchange/number_text.h"
#include "exchange/shapes.h"

namespace bosquet::exchange {
namespace {

constexpr std::array kHeights{"height", "height_m", "hoehe", "hoehe_m", "building:height", "building_h", "bldg_height"};
constexpr std::array kLevels{"building:levels", "levels", "storeys", "floors"};
constexpr double kLevel_m = 3.0, kMostHeight_m = 1000.0;
constexpr std::size_t kListedHeights = 3;  // heights in a note

struct HeightText {
  std::optional<double> metres;
  std::string refused;  // what stood there in place of a height
};

HeightText height_of(const Shape& shape) {
  HeightText out;
  for (std::size_t n = 0; n < shape.values.size() && !out.metres; ++n) {
    if (!shape.values[n] || shape.values[n]->empty()) continue;
    const std::string& text = *shape.values[n];
    const NumberText number = read_number(text, {.decimal_comma = true});  // "12 m" and "8,5" are numbers
    if (number.reading != NumberReading::number || number.value <= 0)
      out.refused = text;
    else
      out.metres =
          std::min((n < kHeights.size() ? number.metres.value_or(1.0) : kLevel_m) * number.value, kMostHeight_m);
  }
  return out;
}

}  // namespace

Result<Footprints> read_footprints(const std::filesystem::path& path, const scene::Georeference& site,
                                   std::optional<DVec2> size_m) {
  ShapeOptions options;
  options.attributes.assign(kHeights.begin(), kHeights.end());
  options.attributes.insert(options.attributes.end(), kLevels.begin(), kLevels.end());
  options.lines = options.clip = false;
  options.size_m = size_m;
  auto shapes = read_shapes(path, site, options);
  if (!shapes) return shapes.error();

  Footprints out;
  out.notes = std::move(shapes->notes);
  out.place = shapes->place;
  std::size_t refused = 0;
  std::string examples;
  for (Shape& shape : shapes->all) {
    const HeightText height = height_of(shape);
    std::string name = shape.name.empty() ? fmt::format("building {}", out.all.size() + 1) : std::move(shape.name);
    if (!height.metres && !height.refused.empty() && ++refused <= kListedHeights)
      examples += fmt::format("{}'{}' of {}", examples.empty() ? "" : ", ", height.refused, name);
    Footprint& print = out.all.emplace_back(Footprint{std::move(name), std::move(shape.polygon), {}});
    if (height.metres) print.height_m = static_cast<float>(*height.metres);
  }
  if (refused > 0)
    out.notes.push_back(fmt::format("{} heights are no numbers above 0 ({}{}); height_m of the recipe is taken",
                                    refused, examples, refused > kListedHeights ? ", ..." : ""));
  return out;
}

}  // namespace bosquet::exchange
