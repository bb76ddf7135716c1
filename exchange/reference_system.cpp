#include "exchange/reference_system.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <vector>

#include "exchange/gdal_scope.h"

namespace bosquet::exchange {
namespace {

OGRSpatialReference system_of(const std::string& wkt) {
  OGRSpatialReference system;
  if (!wkt.empty()) system.SetFromUserInput(wkt.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

std::string wkt_of(const OGRSpatialReference& system) {
  char* text = nullptr;
  if (system.exportToWkt(&text) != OGRERR_NONE) {
    CPLFree(text);
    return {};
  }
  std::string wkt(text);
  CPLFree(text);
  return wkt;
}

}  // namespace

Result<std::string> reference_system(const std::string& definition) {
  const GdalMessages quiet;
  OGRSpatialReference system;
  // Limited, so that a definition is never taken for the name of a file or an address.
  const OGRErr failed =
      system.SetFromUserInput(definition.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
  std::string wkt = failed == OGRERR_NONE ? wkt_of(system) : std::string();
  if (wkt.empty())
    return Error{fmt::format("'{}' is no known reference system; give a code like EPSG:25832, or WKT", definition)};
  return wkt;
}

SystemFacts system_facts(const std::string& wkt) {
  const GdalMessages quiet;
  const OGRSpatialReference system = system_of(wkt);
  SystemFacts facts;
  if (const char* name = system.GetName()) facts.name = name;
  facts.geographic = system.IsGeographic();
  facts.local = wkt.empty() || system.IsLocal() || (!system.IsGeographic() && !system.IsProjected());
  if (!facts.geographic) facts.metres_per_unit = system.GetLinearUnits();
  if (!(facts.metres_per_unit > 0)) facts.metres_per_unit = 1;
  return facts;
}

std::string short_definition(const std::string& wkt) {
  const GdalMessages quiet;
  const OGRSpatialReference system = system_of(wkt);
  const char *authority = system.GetAuthorityName(nullptr), *code = system.GetAuthorityCode(nullptr);
  const auto same = [&](const std::string& definition) {
    const auto back = reference_system(definition);
    return back && same_system(*back, wkt);
  };
  if (authority && code)
    if (const std::string text = fmt::format("{}:{}", authority, code); same(text)) return text;
  char* proj = nullptr;
  const bool told = system.exportToProj4(&proj) == OGRERR_NONE;
  const std::string text = told ? proj : "";
  CPLFree(proj);
  return !text.empty() && same(text) ? text : wkt;
}

std::string degrees_system() {
  OGRSpatialReference system;
  system.SetWellKnownGeogCS("WGS84");
  return wkt_of(system);
}

std::string plane_at(DVec2 place) {
  return fmt::format("+proj=tmerc +lat_0={:.9f} +lon_0={:.9f} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
                     place.y, place.x);
}

bool same_system(const std::string& wkt, const std::string& other_wkt) {
  if (wkt == other_wkt) return true;
  const GdalMessages quiet;
  const OGRSpatialReference a = system_of(wkt), b = system_of(other_wkt);
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT", nullptr};
  return a.IsSame(&b, options);
}

struct Reprojection::Impl {
  OGRSpatialReference from, to;
  std::unique_ptr<OGRCoordinateTransformation> way;
  bool to_metres = false;
};

Reprojection::Reprojection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Reprojection::Reprojection(Reprojection&&) noexcept = default;
Reprojection& Reprojection::operator=(Reprojection&&) noexcept = default;
Reprojection::~Reprojection() = default;

Result<Reprojection> Reprojection::make(const std::string& from, const std::string& to) {
  const GdalMessages quiet;
  auto impl = std::make_unique<Impl>();
  impl->from = system_of(from), impl->to = system_of(to);
  impl->way.reset(OGRCreateCoordinateTransformation(&impl->from, &impl->to));
  if (!impl->way)
    return Error{fmt::format("no way is known from {} to {}", system_facts(from).name, system_facts(to).name)};
  impl->to_metres = !impl->to.IsGeographic();
  return Reprojection(std::move(impl));
}

void Reprojection::apply(std::span<DVec2> points) const {
  const GdalMessages quiet;
  constexpr std::size_t kChunk = 4096;
  std::vector<double> x, y;
  std::vector<int> good;
  for (std::size_t begin = 0; begin < points.size(); begin += kChunk) {
    const auto part = points.subspan(begin, std::min(kChunk, points.size() - begin));
    x.clear(), y.clear();
    for (const DVec2& p : part) x.push_back(p.x), y.push_back(p.y);
    good.assign(part.size(), 0);
    impl_->way->Transform(static_cast<int>(part.size()), x.data(), y.data(), nullptr, good.data());
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto told = [&](double v) {
        if (!good[i] || !std::isfinite(v)) return std::numeric_limits<double>::quiet_NaN();
        return impl_->to_metres ? std::round(1000 * v) / 1000 : v;
      };
      part[i] = {told(x[i]), told(y[i])};
    }
  }
}

DVec2 Reprojection::operator()(DVec2 point) const {
  apply({&point, 1});
  return point;
}

}  // namespace bosquet::exchange
