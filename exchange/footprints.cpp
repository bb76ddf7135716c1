#include "exchange/footprints.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>

namespace bosquet::exchange {
namespace {

constexpr std::array kHeights{"height", "height_m", "hoehe", "hoehe_m", "building:height", "building_h", "bldg_height"};
constexpr std::array kLevels{"building:levels", "levels", "storeys", "floors"};
constexpr double kLevel_m = 3.0, kMostHeight_m = 1000.0;

struct Quiet {
  Quiet() { CPLErrorReset(), CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
};

std::optional<double> attribute(const OGRFeature& feature, const char* name) {
  const int field = feature.GetFieldIndex(name);  // whatever its case
  if (field < 0 || !feature.IsFieldSetAndNotNull(field)) return {};
  const double v = feature.GetFieldAsDouble(field);  // "12 m" reads as 12
  if (!std::isfinite(v) || v <= 0) return {};
  return v;
}

std::optional<float> height_of(const OGRFeature& feature) {
  std::optional<double> height;
  for (const char* name : kHeights)
    if (!height) height = attribute(feature, name);
  for (const char* name : kLevels)
    if (!height)
      if (const auto levels = attribute(feature, name)) height = kLevel_m * *levels;
  if (!height) return {};
  return static_cast<float>(std::min(*height, kMostHeight_m));
}

std::string name_of(const OGRFeature& feature, const std::string& fallback) {
  for (const char* name : {"name", "id"})
    if (const int field = feature.GetFieldIndex(name); field >= 0 && feature.IsFieldSetAndNotNull(field))
      if (const std::string text = feature.GetFieldAsString(field); !text.empty()) return text;
  return fallback;
}

std::vector<Vec2> ring_of(const OGRLinearRing& ring, DVec2 south_west) {
  std::vector<Vec2> out;
  for (int i = 0; i < ring.getNumPoints(); ++i) {
    const DVec2 p = DVec2(ring.getX(i), ring.getY(i)) - south_west;
    if (out.empty() || out.back() != Vec2(p)) out.emplace_back(p);
  }
  if (out.size() > 1 && out.front() == out.back()) out.pop_back();
  return out;
}

std::optional<Polygon> outline_of(const OGRPolygon& polygon, DVec2 south_west) {
  if (!polygon.getExteriorRing()) return {};
  Polygon out{ring_of(*polygon.getExteriorRing(), south_west), {}};
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
    if (auto hole = ring_of(*polygon.getInteriorRing(i), south_west); hole.size() >= 3)
      out.holes.push_back(std::move(hole));
  // Not a number, or so far away that metres are lost in a float.
  constexpr float kFarthest_m = 1e6f;
  const auto usable = [](const std::vector<Vec2>& ring) {
    return std::all_of(ring.begin(), ring.end(),
                       [](Vec2 p) { return std::fabs(p.x) <= kFarthest_m && std::fabs(p.y) <= kFarthest_m; });
  };
  if (out.ring.size() < 3 || !usable(out.ring) || !std::all_of(out.holes.begin(), out.holes.end(), usable)) return {};
  return out;
}

}  // namespace

Result<Footprints> read_footprints(const std::filesystem::path& path, DVec2 south_west) {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
  const Quiet quiet;
  const std::string name = path.string();
  const std::unique_ptr<GDALDataset> data(
      GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (!data) {
    const std::string why = CPLGetLastErrorMsg();
    return Error{fmt::format("cannot read outlines from {}{}{}", name, why.empty() ? "" : ": ", why)};
  }
  Footprints out;
  std::size_t others = 0;
  for (OGRLayer* layer : data->GetLayers()) {
    const OGRSpatialReference* crs = layer->GetSpatialRef();
    OGREnvelope extent;
    const bool has_extent = layer->GetExtent(&extent) == OGRERR_NONE;
    // GeoJSON says degrees when it says nothing; plan metres written into one lie far outside them.
    const bool in_degrees = crs && crs->IsGeographic() && has_extent && extent.MinX >= -180 && extent.MaxX <= 180 &&
                            extent.MinY >= -90 && extent.MaxY <= 90;
    const bool tiny = has_extent && extent.MaxX - extent.MinX < 0.5 && extent.MaxY - extent.MinY < 0.5;
    const std::size_t before = out.all.size();
    for (const auto& feature : *layer) {
      const OGRGeometry* shape = feature->GetGeometryRef();
      if (!shape) continue;
      const std::string fallback = fmt::format("building {}", out.all.size() + 1);
      const auto add = [&](const OGRGeometry& part) {
        const auto* polygon = wkbFlatten(part.getGeometryType()) == wkbPolygon ? part.toPolygon() : nullptr;
        auto outline = polygon ? outline_of(*polygon, south_west) : std::nullopt;
        if (outline)
          out.all.push_back({name_of(*feature, fallback), std::move(*outline), height_of(*feature)});
        else
          ++others;
      };
      if (wkbFlatten(shape->getGeometryType()) == wkbMultiPolygon)
        for (const OGRPolygon* part : *shape->toMultiPolygon()) add(*part);
      else
        add(*shape);
    }
    if (in_degrees && tiny && out.all.size() > before)
      return Error{fmt::format("{}: its outlines are in degrees; reproject them to the site's metres first", name)};
  }
  if (out.all.empty()) return Error{fmt::format("{} has no polygon", name)};
  if (others > 0) out.notes.push_back(fmt::format("{} shapes are no polygons and were left out", others));
  return out;
}

}  // namespace bosquet::exchange
