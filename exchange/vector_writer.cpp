#include "exchange/vector_writer.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/letters.h"
#include "core/write_protection.h"
#include "exchange/file_output.h"
#include "exchange/gdal_scope.h"
#include "exchange/reference_system.h"

namespace bosquet::exchange {
namespace {

using std::filesystem::path;

// A value of one attribute: text, a whole number, a real one or nothing.
using Value = nlohmann::json;

// A float as the number that people meant by it: 0.3, not 0.300000012.
double decimal(float value) {
  for (const double power : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}) {
    const double rounded = std::round(static_cast<double>(value) * power) / power;
    if (static_cast<float>(rounded) == value) return rounded;
  }
  return static_cast<double>(value);
}

Value text_or_null(const std::string& text) { return text.empty() ? Value() : Value(text); }
Value grown_size(double metres) { return std::round(1000 * metres) / 1000; }

// In the order of kTreeAttributes.
std::vector<Value> values_of(const TreeRecord& t) {
  std::vector<Value> out{t.id,
                         t.species,
                         t.common,
                         t.botanical,
                         std::string(scene::kTreeStatusNames[static_cast<std::size_t>(t.status)]),
                         decimal(t.height_m),
                         t.trunk_diameter_m ? Value(decimal(*t.trunk_diameter_m)) : Value(),
                         decimal(t.crown_diameter_m),
                         t.clear_stem_m > 0 ? Value(decimal(t.clear_stem_m)) : Value(),
                         text_or_null(t.form),
                         t.surveyed ? 1 : 0,
                         text_or_null(t.inventory_name),
                         text_or_null(t.inventory_id)};
  if (t.grown)
    for (const double size : {t.grown->height_m, t.grown->trunk_diameter_m, t.grown->crown_diameter_m})
      out.push_back(grown_size(size));
  else
    out.insert(out.end(), 3, Value());
  out.push_back(t.grown ? Value(std::round(10.0 * static_cast<double>(t.grown->age_years)) / 10) : Value());
  return out;
}

enum class AttributeType { whole, real, text };
AttributeType type_of(std::string_view name) {
  if (name == "id" || name == "surveyed") return AttributeType::whole;
  if (name.ends_with("_m") || name == "age_years") return AttributeType::real;
  return AttributeType::text;
}

Error refused(const path& file) {
  return cannot_finish(fmt::format("cannot write {}{}", file.string(), GdalMessages::last()));
}

constexpr std::size_t kLongestShapefileText = 254;

Result<void> write_points(GDALDataset& data, std::span<const TreeRecord> trees, OGRSpatialReference* crs,
                          bool shapefile, const path& file, std::size_t& cut) {
  OGRLayer* layer = data.CreateLayer(shapefile ? file.stem().string().c_str() : "trees", crs, wkbPoint, nullptr);
  if (!layer) return refused(file);
  for (const TreeAttribute& a : kTreeAttributes) {
    const AttributeType type = type_of(a.name);
    OGRFieldDefn field(std::string(shapefile ? a.short_name : a.name).c_str(), type == AttributeType::whole ? OFTInteger
                                                                               : type == AttributeType::real
                                                                                   ? OFTReal
                                                                                   : OFTString);
    // Real numbers of a .dbf are decimals of a fixed length; these hold every float a tree may have.
    if (shapefile && type == AttributeType::real) field.SetWidth(19), field.SetPrecision(9);
    if (shapefile && type == AttributeType::text)
      field.SetWidth(a.name == "inventory_name" || a.name == "inventory_id" ? int{kLongestShapefileText} : 80);
    if (layer->CreateField(&field) != OGRERR_NONE) return refused(file);
  }
  for (const TreeRecord& tree : trees) {
    const std::unique_ptr<OGRFeature> feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
    OGRPoint place(tree.map.x, tree.map.y);
    feature->SetGeometry(&place);
    const std::vector<Value> values = values_of(tree);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int at = static_cast<int>(i);
      const Value& v = values[i];
      if (v.is_null())
        feature->SetFieldNull(at);
      else if (v.is_string()) {
        std::string text = v.get<std::string>();
        if (shapefile && text.size() > kLongestShapefileText) {
          std::size_t end = kLongestShapefileText;
          while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not inside a letter
          text.resize(end), ++cut;
        }
        feature->SetField(at, text.c_str());
      } else if (v.is_number_integer())
        feature->SetField(at, v.get<int>());
      else
        feature->SetField(at, v.get<double>());
    }
    if (layer->CreateFeature(feature.get()) != OGRERR_NONE) return refused(file);
  }
  return {};
}

Result<void> write_outline(GDALDataset& data, OGRSpatialReference* crs, DVec2 corner, DVec2 size, const path& file) {
  OGRLayer* layer = data.CreateLayer("site", crs, wkbPolygon, nullptr);
  if (!layer) return refused(file);
  OGRFieldDefn name("name", OFTString);
  if (layer->CreateField(&name) != OGRERR_NONE) return refused(file);
  OGRLinearRing ring;
  for (const DVec2 p : {DVec2(0, 0), DVec2(size.x, 0), size, DVec2(0, size.y), DVec2(0, 0)})
    ring.addPoint(corner.x + p.x, corner.y + p.y);
  OGRPolygon outline;
  outline.addRing(&ring);
  const std::unique_ptr<OGRFeature> feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
  feature->SetGeometry(&outline);
  feature->SetField(0, "site");
  if (layer->CreateFeature(feature.get()) != OGRERR_NONE) return refused(file);
  return {};
}

// A hidden folder beside the target, gone at the end.
class Workshop {
 public:
  explicit Workshop(const path& target) {
    const path beside = target.has_parent_path() ? target.parent_path() : path(".");
    std::string pattern = (beside / ".bosquet-XXXXXX").string();
    if (::mkdtemp(pattern.data())) folder_ = pattern;
  }
  ~Workshop() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  const path& folder() const { return folder_; }

 private:
  path folder_;
};

Result<WrittenTrees> write_with_gdal(const path& target, std::span<const TreeRecord> trees,
                                     const scene::Georeference& place, DVec2 site_m, bool shapefile) {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
  const GdalMessages quiet;
  const Workshop workshop(target);
  if (workshop.folder().empty())
    return Error{fmt::format("{}: no permission to write in its folder, or there is none", target.string())};
  const path file = workshop.folder() / target.filename();

  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(shapefile ? "ESRI Shapefile" : "GPKG");
  if (!driver) return cannot_finish(fmt::format("cannot write {}: GDAL lacks this format here", target.string()));
  Dataset data(driver->Create(file.string().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!data) return refused(target);

  OGRSpatialReference system;
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference* crs = nullptr;
  if (!place.crs_wkt.empty() && system.SetFromUserInput(place.crs_wkt.c_str()) == OGRERR_NONE) {
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    crs = &system;
  }
  WrittenTrees out;
  std::size_t cut = 0;
  if (!shapefile) data->StartTransaction();
  if (auto done = write_points(*data, trees, crs, shapefile, file, cut); !done) return done.error();
  if (!shapefile)
    if (auto done = write_outline(*data, crs, place.south_west, site_m, file); !done) return done.error();
  if (!shapefile && data->CommitTransaction() != OGRERR_NONE) return refused(target);
  CPLErrorReset();
  data.reset();
  if (CPLGetLastErrorType() >= CE_Failure) return refused(target);
  if (cut > 0) out.warnings.push_back(fmt::format("{}: {} texts were cut at 254 bytes", target.string(), cut));

  // All parts, the one that was asked for last.
  std::vector<path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(workshop.folder())) parts.push_back(entry.path());
  std::sort(parts.begin(), parts.end(), [&](const path& a, const path& b) {
    const bool a_main = a.extension() == target.extension(), b_main = b.extension() == target.extension();
    return a_main != b_main ? b_main : a < b;
  });
  for (const path& part : parts) {
    std::error_code ec;
    out.bytes += std::filesystem::file_size(part, ec);
    path to = target;
    std::filesystem::rename(part, to.replace_extension(part.extension()), ec);
    if (ec) return cannot_finish(fmt::format("cannot write {}: {}", to.string(), ec.message()));
  }
  // What an earlier Shapefile of the name said of its place must not stand beside this one.
  if (shapefile && !crs) {
    std::error_code ignored;
    path stale = target;
    std::filesystem::remove(stale.replace_extension(".prj"), ignored);
  }
  return out;
}

std::string json_text(const Value& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<WrittenTrees> write_geojson(const path& target, std::span<const TreeRecord> trees,
                                   const scene::Georeference& place) {
  WrittenTrees out;
  std::vector<DVec2> places;
  for (const TreeRecord& tree : trees) places.push_back(tree.map);
  const bool known = !place.crs_wkt.empty() && !system_facts(place.crs_wkt).local;
  if (known) {
    auto to_degrees = Reprojection::make(place.crs_wkt, degrees_system());
    if (!to_degrees) return to_degrees.error();
    to_degrees->apply(places);
    for (const DVec2& p : places)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        return Error{fmt::format("{}: the site lies where its reference system has no degrees", target.string())};
  } else {
    out.warnings.push_back(
        fmt::format("{}: the site has no reference system, so places are metres, not degrees; [site] crs would tell it",
                    target.string()));
  }
  auto file = FileOutput::create(target);
  if (!file) return file.error();
  file->write("{\"type\":\"FeatureCollection\",\"name\":\"trees\",");
  if (!known) file->write("\"crs\":null,");
  file->write("\"features\":[");
  for (std::size_t i = 0; i < trees.size(); ++i) {
    std::string line = i ? ",\n" : "\n";
    line +=
        fmt::format("{{\"type\":\"Feature\",\"id\":{},\"geometry\":{{\"type\":\"Point\",\"coordinates\":", trees[i].id);
    line += known ? fmt::format("[{:.9f},{:.9f}]", places[i].x, places[i].y)
                  : fmt::format("[{},{}]", places[i].x, places[i].y);
    line += "},\"properties\":{";
    const std::vector<Value> values = values_of(trees[i]);
    for (std::size_t k = 0; k < values.size(); ++k)
      line += fmt::format("{}\"{}\":{}", k ? "," : "", kTreeAttributes[k].name, json_text(values[k]));
    file->write(line + "}}");
  }
  file->write("\n]}\n");
  auto bytes = file->commit();
  if (!bytes) return bytes.error();
  out.bytes = *bytes;
  return out;
}

}  // namespace

bool writes_trees(const path& file) {
  const std::string ending = folded_letters(file.extension().string());
  return ending == ".gpkg" || ending == ".shp" || ending == ".geojson";
}

Result<WrittenTrees> write_trees(const path& target, std::span<const TreeRecord> trees,
                                 const scene::Georeference& place, DVec2 site_m) {
  const std::string ending = folded_letters(target.extension().string());
  if (auto fine = check_replaceable(target); !fine) return fine.error();
  if (ending == ".geojson") return write_geojson(target, trees, place);
  return write_with_gdal(target, trees, place, site_m, ending == ".shp");
}

}  // namespace bosquet::exchange
