#include "exchange/site_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/reference_system.h"

namespace bosquet::exchange {
namespace {

// Sites are at most 200 km wide: some 2 degrees from south to north. This is well beyond.
constexpr double kWidestSite_deg = 3.0;

struct Extent {
  DVec2 low{INFINITY}, high{-INFINITY};
  bool empty() const { return !(low.x <= high.x); }
  DVec2 middle() const { return 0.5 * (low + high); }
};

bool finite(const DVec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

Extent extent_of(const std::vector<DVec2>& points) {
  Extent out;
  for (const DVec2& p : points)
    if (finite(p)) out.low = glm::min(out.low, p), out.high = glm::max(out.high, p);
  return out;
}

// The middle half of the points decides: a slip of a digit must not.
DVec2 median(const std::vector<DVec2>& points) {
  std::vector<double> x, y;
  for (const DVec2& p : points)
    if (finite(p)) x.push_back(p.x), y.push_back(p.y);
  if (x.empty()) return DVec2(0.0);
  const auto middle = static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), x.begin() + middle, x.end());
  std::nth_element(y.begin(), y.begin() + middle, y.end());
  return {x[static_cast<std::size_t>(middle)], y[static_cast<std::size_t>(middle)]};
}

bool can_be_degrees(const std::vector<DVec2>& points) {
  const Extent e = extent_of(points);
  return e.empty() || (e.low.x >= -180 && e.high.x <= 180 && e.low.y >= -90 && e.high.y <= 90);
}

std::size_t inside(const std::vector<DVec2>& points, DVec2 corner, DVec2 size) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const DVec2& p) {
    const DVec2 q = p - corner;
    return q.x >= 0 && q.y >= 0 && q.x <= size.x && q.y <= size.y;
  }));
}

// How long 100 m to the east and north are in a projected system at a place.
bool true_to_scale(const Reprojection& to_degrees, DVec2 at) {
  const DVec2 middle = to_degrees(at);
  if (!finite(middle)) return false;
  auto flat = Reprojection::make(degrees_system(), *reference_system(plane_at(middle)));
  if (!flat) return false;
  const DVec2 origin = (*flat)(middle);
  for (const DVec2 step : {DVec2(1000, 0), DVec2(0, 1000)}) {
    const double length = glm::length((*flat)(to_degrees(at + step)) - origin);
    if (!(std::abs(length / 1000 - 1) <= kTrueScale)) return false;
  }
  return true;
}

// The corner of a site of a size that is centred on the points.
DVec2 centred(const std::vector<DVec2>& points, DVec2 size) {
  const Extent e = extent_of(points);
  return e.empty() ? DVec2(0.0) : glm::floor(e.middle() - 0.5 * size);
}

// A system of PROJ's words has no name.
std::string name_of(const std::string& system) {
  const std::string name = system_facts(system).name;
  return name.empty() || name == "unknown" ? "the site's own plane" : name;
}

void move_to(std::vector<DVec2>& points, DVec2 corner) {
  for (DVec2& p : points) p -= corner;
}

// Coordinates of nobody knows where.
OnSite unknown_system(std::vector<DVec2> points, const FrameOf& frame) {
  OnSite out;
  for (DVec2& p : points) p *= frame.metres_per_unit;
  DVec2 corner = frame.site.south_west;
  if (frame.corner) {
    corner = *frame.corner * frame.metres_per_unit;
  } else if (frame.size_m &&
             (corner.x > 0 || corner.y > 0 || -corner.x > frame.size_m->x || -corner.y > frame.size_m->y) &&
             inside(points, DVec2(0.0), *frame.size_m) > inside(points, corner, *frame.size_m)) {
    corner = DVec2(0.0);
    out.notes.push_back(
        "coordinates count from the site's corner: in map coordinates fewer trees would be on the site");
  }
  move_to(points, corner);
  out.plan = std::move(points);
  return out;
}

}  // namespace

Result<OnSite> onto_site(std::vector<DVec2> points, const FrameOf& frame) {
  std::string file = frame.crs_wkt;
  OnSite out;
  SystemFacts facts = system_facts(file);
  if (!file.empty() && facts.geographic && !can_be_degrees(points)) {
    if (!frame.crs_assumed) out.notes.push_back("its coordinates are no degrees, whatever it says; taken as metres");
    file.clear();
  } else if (!file.empty() && frame.crs_assumed && facts.geographic) {
    if (const Extent e = extent_of(points); !e.empty() && e.high.y - e.low.y > kWidestSite_deg) {
      out.notes.push_back("as degrees its coordinates would span a country; taken as metres");
      file.clear();
    }
  }
  if (file.empty()) {
    OnSite unknown = unknown_system(std::move(points), frame);
    unknown.notes.insert(unknown.notes.begin(), out.notes.begin(), out.notes.end());
    return unknown;
  }

  const bool site_known = !frame.site.crs_wkt.empty() && !system_facts(frame.site.crs_wkt).local;
  std::string target = frame.site.crs_wkt;
  if (!site_known) {
    auto to_degrees = Reprojection::make(file, degrees_system());
    if (!to_degrees) return to_degrees.error();
    const DVec2 middle = frame.corner ? *frame.corner : median(points);
    scene::Georeference place = frame.site;
    const DVec2 degrees = (*to_degrees)(middle);
    if (!finite(degrees))
      return Error{fmt::format("its coordinates, about {:.10g}, {:.10g}, are no place on earth in {}", middle.x,
                               middle.y, facts.name)};
    if (!facts.geographic && std::abs(facts.metres_per_unit - 1) < 1e-9 && true_to_scale(*to_degrees, middle)) {
      target = file;
    } else {
      auto plane = reference_system(plane_at(degrees));
      if (!plane) return plane.error();
      target = *plane;
      place.south_west = DVec2(0.0);
      out.notes.push_back(
          fmt::format("placed on a plane of its own at latitude {:.6f}, longitude {:.6f}", degrees.y, degrees.x));
    }
    place.crs_wkt = target;
    place.latitude_deg = degrees.y, place.longitude_deg = degrees.x;
    out.place = place;
  }

  std::optional<DVec2> corner = frame.corner;
  if (!same_system(file, target)) {
    auto way = Reprojection::make(file, target);
    if (!way) return way.error();
    way->apply(points);
    if (corner) corner = (*way)(*corner);
    if (corner && !finite(*corner))
      return Error{fmt::format("its south_west is no place in {}", system_facts(target).name)};
    if (site_known) out.notes.push_back(fmt::format("reprojected from {} to {}", facts.name, name_of(target)));
  }
  if (!corner) {
    corner = out.place ? out.place->south_west : frame.site.south_west;
    // A site that nobody placed lies around the trees.
    if (out.place && out.place->south_west == DVec2(0.0) && frame.size_m) corner = centred(points, *frame.size_m);
  }
  if (out.place) out.place->south_west = *corner;
  move_to(points, *corner);
  out.plan = std::move(points);
  return out;
}

}  // namespace bosquet::exchange
