#include "exchange/shapes.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>

#include "exchange/gdal_scope.h"
#include "exchange/site_frame.h"

namespace bosquet::exchange {
namespace {

constexpr std::size_t kMostPoints = 20'000'000;
// So far away metres are lost in a float.
constexpr std::size_t kListedNames = 3;  // names in a note

// What a feature holds, in the file's coordinates: the points of its rings one after another.
struct Outline {
  std::size_t feature = 0;
  std::string name;
  std::vector<std::optional<std::string>> values;
  bool polygon = false;
  std::vector<std::size_t> ends;  // of each ring or line, in `points`
};

std::string text_of(const OGRFeature& feature, const char* name) {
  const int field = feature.GetFieldIndex(name);
  return field >= 0 && feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : "";
}

class Collector {
 public:
  Collector(const ShapeOptions& options) : options_(options) {}

  // False when there are too many points.
  bool add(const OGRFeature& feature, std::size_t number, const OGRGeometry& shape) {
    switch (const OGRwkbGeometryType type = wkbFlatten(shape.getGeometryType()); type) {
      case wkbPolygon: {
        Outline out = outline(feature, number, true);
        const OGRPolygon& polygon = *shape.toPolygon();
        if (!polygon.getExteriorRing()) return ++others, true;
        ring(*polygon.getExteriorRing(), out);
        for (int i = 0; i < polygon.getNumInteriorRings(); ++i) ring(*polygon.getInteriorRing(i), out);
        outlines.push_back(std::move(out));
        break;
      }
      case wkbLineString: {
        if (!options_.lines) return ++others, true;
        Outline out = outline(feature, number, false);
        ring(*shape.toLineString(), out);
        outlines.push_back(std::move(out));
        break;
      }
      case wkbMultiPolygon:
      case wkbMultiLineString:
      case wkbGeometryCollection:
        for (const OGRGeometry* part : *shape.toGeometryCollection())
          if (!add(feature, number, *part)) return false;
        break;
      default:
        ++others;
    }
    return points.size() <= kMostPoints;
  }

  std::vector<Outline> outlines;
  std::vector<DVec2> points;
  std::size_t others = 0;

 private:
  Outline outline(const OGRFeature& feature, std::size_t number, bool polygon) const {
    Outline out;
    out.feature = number, out.polygon = polygon;
    out.name = text_of(feature, "name");
    if (out.name.empty()) out.name = text_of(feature, "id");
    for (const std::string& name : options_.attributes) {
      const int field = feature.GetFieldIndex(name.c_str());
      out.values.push_back(field >= 0 && feature.IsFieldSetAndNotNull(field)
                               ? std::optional<std::string>(feature.GetFieldAsString(field))
                               : std::nullopt);
    }
    return out;
  }

  void ring(const OGRLineString& line, Outline& out) {
    for (int i = 0; i < line.getNumPoints(); ++i) points.emplace_back(line.getX(i), line.getY(i));
    out.ends.push_back(points.size());
  }

  const ShapeOptions& options_;
};

// The ring without points that follow themselves, and without the first again at its end.
std::vector<Vec2> ring_of(const std::vector<DVec2>& points) {
  std::vector<Vec2> out;
  for (const DVec2& p : points)
    if (out.empty() || out.back() != Vec2(p)) out.emplace_back(p);
  if (out.size() > 1 && out.front() == out.back()) out.pop_back();
  return out;
}

// Cut by the half plane in which sign * (coordinate - limit) <= 0 (Sutherland and Hodgman 1974). What is cut off leaves
// edges along the limit, which enclose nothing.
std::vector<DVec2> cut(const std::vector<DVec2>& ring, int axis, double limit, double sign) {
  std::vector<DVec2> out;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const DVec2 a = ring[j], b = ring[i];
    const double past_a = sign * (a[axis] - limit), past_b = sign * (b[axis] - limit);
    if ((past_a <= 0) != (past_b <= 0)) out.push_back(glm::mix(a, b, past_a / (past_a - past_b)));
    if (past_b <= 0) out.push_back(b);
  }
  return out;
}

using Rings = std::vector<std::vector<DVec2>>;  // of one polygon: the outline, then holes

OGRPolygon to_ogr(const Rings& rings) {
  OGRPolygon out;
  for (const std::vector<DVec2>& ring : rings) {
    OGRLinearRing line;
    for (const DVec2& p : ring) line.addPoint(p.x, p.y);
    line.closeRings();
    out.addRing(&line);
  }
  return out;
}

void collect(const OGRGeometry& shape, std::vector<Rings>& out) {
  const OGRwkbGeometryType type = wkbFlatten(shape.getGeometryType());
  if (type == wkbPolygon && !shape.IsEmpty()) {
    Rings& rings = out.emplace_back();
    for (const OGRLinearRing* line : *shape.toPolygon()) {
      std::vector<DVec2>& ring = rings.emplace_back();
      for (int i = 0; i < line->getNumPoints(); ++i) ring.emplace_back(line->getX(i), line->getY(i));
    }
  } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    for (const OGRGeometry* part : *shape.toGeometryCollection()) collect(*part, out);
  }
}

// The polygon as parts none of which crosses itself, and whether it had to be taken apart.
std::vector<Rings> parts_of(Rings rings, bool& tangled) {
  const OGRPolygon shape = to_ogr(rings);
  tangled = !shape.IsValid();
  if (!tangled) return {std::move(rings)};
  std::vector<Rings> parts;
  if (const std::unique_ptr<OGRGeometry> valid{shape.MakeValid()}) collect(*valid, parts);
  return parts;
}

std::optional<Polygon> polygon_of(const Rings& rings) {
  Polygon out{ring_of(rings.front()), {}};
  if (out.ring.size() < 3) return {};
  for (std::size_t i = 1; i < rings.size(); ++i)
    if (auto hole = ring_of(rings[i]); hole.size() >= 3) out.holes.push_back(std::move(hole));
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(kListedNames, names.size()); ++i) out += (i ? ", " : "") + names[i];
  return names.size() > kListedNames ? out + fmt::format(" and {} more", names.size() - kListedNames) : out;
}

}  // namespace

std::vector<Polygon> untangled(const Polygon& polygon) {
  const GdalMessages quiet;
  Rings rings{{polygon.ring.begin(), polygon.ring.end()}};
  for (const auto& hole : polygon.holes) rings.emplace_back(hole.begin(), hole.end());
  bool tangled = false;
  const std::vector<Rings> parts = parts_of(std::move(rings), tangled);
  if (!tangled) return {polygon};
  std::vector<Polygon> out;
  for (const Rings& part : parts)
    if (auto whole = polygon_of(part)) out.push_back(std::move(*whole));
  return out;
}

Result<Shapes> read_shapes(const std::filesystem::path& path, const scene::Georeference& site,
                           const ShapeOptions& options) {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
  const std::string file = path.string();
  std::error_code ec;
  if (!std::filesystem::exists(path, ec)) return Error{fmt::format("there is no file {}", file)};
  const GdalMessages quiet;
  const CPLConfigOptionSetter closed("DXF_CLOSED_LINE_AS_POLYGON", "TRUE", false);
  const std::unique_ptr<GDALDataset> data(
      GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (!data) return Error{fmt::format("cannot read outlines from {}{}", file, GdalMessages::last())};
  const bool geojson = data->GetDriverName() == std::string("GeoJSON");

  Shapes out;
  bool found_layer = false;
  std::vector<std::string> tangled, seen_layers;
  std::size_t others = 0, unusable = 0, off_site = 0, number = 0;
  scene::Georeference place = site;
  for (OGRLayer* layer : data->GetLayers()) {
    seen_layers.emplace_back(layer->GetName());
    if (!options.layer.empty() && options.layer != layer->GetName()) continue;
    found_layer = true;
    if (!options.where.empty() && layer->SetAttributeFilter(options.where.c_str()) != OGRERR_NONE)
      return Error{fmt::format("{}: the condition \"{}\" cannot be asked of layer {}{}", file, options.where,
                               layer->GetName(), GdalMessages::last())};
    CPLErrorReset();
    Collector read(options);
    for (const auto& feature : *layer) {
      ++number;
      const OGRGeometry* shape = feature->GetGeometryRef();
      if (!shape) continue;
      std::unique_ptr<OGRGeometry> chords;
      if (shape->hasCurveGeometry()) chords.reset(shape->getLinearGeometry()), shape = chords.get();
      if (shape && !read.add(*feature, number, *shape))
        return Error{fmt::format("{} has more than {} points; cut it to the site first", file, kMostPoints)};
    }
    // Some formats look at the condition only when they are read.
    if (CPLGetLastErrorType() >= CE_Failure && number == 0 && !options.where.empty())
      return Error{fmt::format("{}: the condition \"{}\" cannot be asked of layer {}{}", file, options.where,
                               layer->GetName(), GdalMessages::last())};
    if (CPLGetLastErrorType() >= CE_Failure)
      return Error{fmt::format("{} is damaged after feature {}{}", file, number, GdalMessages::last())};
    others += read.others;
    if (read.outlines.empty()) continue;

    FrameOf frame;
    frame.site = place, frame.size_m = options.size_m;
    // A GeoPackage without a reference system says "Undefined ..." of degrees or metres.
    const OGRSpatialReference* crs = layer->GetSpatialRef();
    if (crs && !(crs->GetName() && std::string_view(crs->GetName()).substr(0, 9) == "Undefined")) {
      char* wkt = nullptr;
      if (crs->exportToWkt(&wkt) == OGRERR_NONE && wkt) frame.crs_wkt = wkt;
      CPLFree(wkt);
      frame.crs_assumed = geojson && crs->IsGeographic();
    }
    auto on_site = onto_site(std::move(read.points), frame);
    if (!on_site) return Error{fmt::format("{}: {}", file, on_site.error().message)};
    if (on_site->place) out.place = place = *on_site->place;
    if (options.makes_site) {
      DVec2 corner(INFINITY);
      for (const DVec2& p : on_site->plan)
        if (std::isfinite(p.x) && std::isfinite(p.y)) corner = glm::min(corner, p);
      for (DVec2& p : on_site->plan) p -= corner;
      place.south_west += corner, out.place = place;
    }
    for (std::string& note : on_site->notes)
      if (std::find(out.notes.begin(), out.notes.end(), note) == out.notes.end()) out.notes.push_back(std::move(note));

    std::size_t begin = 0;
    const DVec2 low(-kMargin_m), high = options.size_m.value_or(DVec2(0.0)) + kMargin_m;
    for (Outline& outline : read.outlines) {
      Rings rings;
      for (std::size_t end : outline.ends) {
        rings.emplace_back(on_site->plan.begin() + static_cast<std::ptrdiff_t>(begin),
                           on_site->plan.begin() + static_cast<std::ptrdiff_t>(end));
        begin = end;
      }
      const bool cut_it = options.size_m && options.clip && outline.polygon;
      const auto usable = [&](const DVec2& p) {
        const double most = cut_it ? 1e9 : static_cast<double>(kFarthest_m);
        return std::fabs(p.x) <= most && std::fabs(p.y) <= most;  // NaN is not
      };
      const bool all_usable = std::all_of(rings.begin(), rings.end(), [&](const std::vector<DVec2>& ring) {
        return ring.size() >= 2 && std::all_of(ring.begin(), ring.end(), usable);
      });
      const std::string name =
          outline.name.empty() ? fmt::format("number {}", outline.feature) : "'" + outline.name + "'";
      Shape shape{outline.feature, std::move(outline.name), std::move(outline.values), {}, {}};
      if (!all_usable || rings.empty()) {
        ++unusable;
        continue;
      }
      if (!outline.polygon) {
        shape.line.assign(rings.front().begin(), rings.front().end());
        out.all.push_back(std::move(shape));
        continue;
      }
      bool crosses = false, near = false, area = false;
      for (Rings& part : parts_of(std::move(rings), crosses)) {
        if (cut_it)
          for (std::vector<DVec2>& ring : part)
            for (int axis : {0, 1}) {
              if (!ring.empty()) ring = cut(ring, axis, low[axis], -1);
              if (!ring.empty()) ring = cut(ring, axis, high[axis], 1);
            }
        area = true;
        if (part.front().empty()) continue;
        near = true;
        auto polygon = polygon_of(part);
        if (!polygon) continue;
        out.all.push_back(shape);
        out.all.back().polygon = std::move(*polygon);
      }
      if (!area)
        ++unusable;
      else if (!near)
        ++off_site;
      else if (crosses)
        tangled.push_back(name);
    }
  }
  if (!found_layer) {
    return options.layer.empty() ? Error{fmt::format("{} has no layer of shapes", file)}
                                 : Error{fmt::format("{} has no layer '{}'; it has {}", file, options.layer,
                                                     seen_layers.empty() ? "none" : listed(seen_layers))};
  }
  if (out.all.empty()) {
    if (off_site > 0)
      return Error{fmt::format("{}: none of its {} shapes lies on the site", file, off_site + unusable)};
    return Error{fmt::format("{} has no {}{}", file, options.lines ? "polygon or line" : "polygon",
                             options.where.empty() ? "" : fmt::format(" where {}", options.where))};
  }
  if (!tangled.empty())
    out.notes.push_back(fmt::format("{} outlines cross themselves ({}); what is inside goes by the even-odd rule",
                                    tangled.size(), listed(tangled)));
  if (others > 0)
    out.notes.push_back(
        fmt::format("{} shapes are no polygons{} and were left out", others, options.lines ? " or lines" : ""));
  if (unusable > 0)
    out.notes.push_back(
        fmt::format("{} shapes have no area, too few points or impossible coordinates and were left "
                    "out",
                    unusable));
  if (off_site > 0) out.notes.push_back(fmt::format("{} shapes lie off the site and were left out", off_site));
  return out;
}

}  // namespace bosquet::exchange
