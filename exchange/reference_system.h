// Reference systems: coordinates from one system of the earth's surveyors in another's.
//
// Frame     always (east, north), or (longitude, latitude) in degrees, whatever order a system itself prescribes
// Library   PROJ by GDAL, its database and no network: between datums as exact as the parameters in it (metres where
//           only a grid would tell centimetres)
// Decision  reprojected coordinates in metres are rounded to a millimetre, so that PROJ's last bits do not reach a site
// Errors    a definition that PROJ does not know
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "core/vec.h"

namespace bosquet::exchange {

struct SystemFacts {
  std::string name;
  bool geographic = false;     ///< in degrees
  bool local = false;          ///< an engineer's own system, whose place on earth nobody knows
  double metres_per_unit = 1;  ///< of a projected one
};

/// WKT of "EPSG:25832", a PROJ string, WKT or a system's name.
Result<std::string> reference_system(const std::string& definition);

/// What kind of system it is; `wkt` as reference_system() or a file gave it.
SystemFacts system_facts(const std::string& wkt);

/// The shortest definition that reference_system() turns into the same system: a code, a PROJ string, else the WKT.
std::string short_definition(const std::string& wkt);

/// WKT of degrees on WGS 84.
std::string degrees_system();

/// A PROJ definition of a plane in metres that touches the earth at a place in degrees; it is the plane's origin.
std::string plane_at(DVec2 longitude_latitude);

bool same_system(const std::string& wkt, const std::string& other_wkt);

class Reprojection {
 public:
  /// Both as WKT.
  static Result<Reprojection> make(const std::string& from, const std::string& to);
  Reprojection(Reprojection&&) noexcept;
  Reprojection& operator=(Reprojection&&) noexcept;
  ~Reprojection();

  /// In place; what cannot be told in the other system becomes NaN.
  void apply(std::span<DVec2> points) const;
  DVec2 operator()(DVec2 point) const;

 private:
  struct Impl;
  explicit Reprojection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace bosquet::exchange
