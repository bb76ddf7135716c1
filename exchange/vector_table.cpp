#include "exchange/vector_table.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <deque>
#include <fstream>
#include <mutex>

#include "exchange/gdal_scope.h"
#include "exchange/reference_system.h"

namespace bosquet::exchange {
namespace {

// Inserted blocks stay points with a name instead of being drawn out.
struct BlocksAsPoints {
  BlocksAsPoints() { CPLSetThreadLocalConfigOption("DXF_INLINE_BLOCKS", "FALSE"); }
  ~BlocksAsPoints() { CPLSetThreadLocalConfigOption("DXF_INLINE_BLOCKS", nullptr); }
};

// Metres of a drawing's unit, by the header variable $INSUNITS of a text DXF; 1 when it says nothing.
double drawing_unit(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  constexpr int kHeaderLines = 20'000;
  for (int n = 0; n < kHeaderLines && std::getline(file, line); ++n) {
    if (line.find("$INSUNITS") == std::string::npos) continue;
    std::string code, value;
    if (!std::getline(file, code) || !std::getline(file, value)) break;
    switch (std::atoi(value.c_str())) {
      case 1:
        return 0.0254;
      case 2:
        return 0.3048;
      case 4:
        return 0.001;
      case 5:
        return 0.01;
      case 7:
        return 1000;
      case 14:
        return 0.1;
      default:
        return 1;
    }
  }
  return 1;
}

struct Circle {
  DVec2 centre;
  double radius;
};

// A closed line all of whose points are as far from their middle.
std::optional<Circle> circle_of(const OGRLineString& line) {
  constexpr int kFewest = 12;
  constexpr double kRoundness = 0.01;
  const int n = line.getNumPoints() - 1;
  if (n < kFewest || !line.get_IsClosed()) return {};
  DVec2 low(INFINITY), high(-INFINITY);
  for (int i = 0; i < n; ++i) {
    const DVec2 p(line.getX(i), line.getY(i));
    low = glm::min(low, p), high = glm::max(high, p);
  }
  const DVec2 centre = 0.5 * (low + high);
  const double radius = 0.25 * (high.x - low.x + high.y - low.y);
  for (int i = 0; i < n; ++i)
    if (std::abs(std::hypot(line.getX(i) - centre.x, line.getY(i) - centre.y) - radius) > kRoundness * radius)
      return {};
  return Circle{centre, radius};
}

class VectorTable : public TreeTable {
 public:
  Result<void> open(const std::filesystem::path& path, const std::string& wanted) {
    static std::once_flag once;
    std::call_once(once, [] { GDALAllRegister(); });
    const GdalMessages quiet;
    const BlocksAsPoints points;
    name_ = path.string();
    std::error_code ec;
    if (!std::filesystem::exists(path, ec)) return Error{fmt::format("there is no file {}", name_)};
    data_.reset(GDALDataset::Open(name_.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
    if (!data_) return Error{fmt::format("cannot read trees from {}{}", name_, GdalMessages::last())};
    const std::string driver = data_->GetDriverName() ? data_->GetDriverName() : "";
    drawing_ = driver == "DXF";
    if (drawing_) metres_per_unit = drawing_unit(path);
    has_places = true;
    crs_assumed = driver == "GeoJSON";

    std::string known;
    for (OGRLayer* layer : data_->GetLayers()) {
      known += (known.empty() ? "" : ", ") + std::string(layer->GetName());
      // Definitions of blocks are no trees.
      const bool definitions = drawing_ && std::string_view(layer->GetName()) == "blocks";
      if (wanted.empty() ? may_have_points(*layer) && !definitions : wanted == layer->GetName())
        layers_.push_back(layer);
    }
    if (!wanted.empty() && layers_.empty())
      return Error{fmt::format("{}: there is no layer '{}'; the layers are {}", name_, wanted, known)};
    if (layers_.empty()) return Error{fmt::format("{} has no layer of points", name_)};
    for (OGRLayer* layer : layers_) {
      const OGRSpatialReference* crs = layer->GetSpatialRef();
      std::string wkt;
      if (crs) {
        char* text = nullptr;
        if (crs->exportToWkt(&text) == OGRERR_NONE) wkt = text;
        CPLFree(text);
      }
      if (layer == layers_.front())
        crs_wkt = wkt;
      else if (!same_system(crs_wkt, wkt))
        return Error{
            fmt::format("{}: its layers have different reference systems; name the one to take of: {}", name_, known)};
      add_columns(*layer->GetLayerDefn());
    }
    if (system_facts(crs_wkt).local) {
      if (!crs_wkt.empty() && !drawing_) metres_per_unit = system_facts(crs_wkt).metres_per_unit;
      crs_wkt.clear();
    }
    if (drawing_) {
      add_attribute_columns();
      for (const char* extra : {"species", "crown_diameter_m"})
        if (std::find(columns.begin(), columns.end(), extra) == columns.end()) columns.emplace_back(extra);
      if (metres_per_unit != 1) notes.push_back(fmt::format("drawn in units of {:g} m", metres_per_unit));
    }
    restart();
    return {};
  }

  bool next(TableRow& row) override {
    const GdalMessages quiet;
    while (parts_.empty()) {
      if (layer_ == layers_.size()) return false;
      CPLErrorReset();
      feature_.reset(layers_[layer_]->GetNextFeature());
      if (!feature_) {
        const bool damaged = CPLGetLastErrorType() >= CE_Failure;
        if (++layer_ < layers_.size()) layers_[layer_]->ResetReading();
        if (!damaged) continue;
        row.line = last_ + 1;
        row.place.reset();
        row.fields.assign(columns.size(), "");
        row.problem = "the file is damaged from here on" + GdalMessages::last();
        return true;
      }
      take_apart();
    }
    const Part part = parts_.front();
    parts_.pop_front();
    row.line = static_cast<int>(std::clamp<GIntBig>(feature_->GetFID(), 0, std::numeric_limits<int>::max() - 1));
    last_ = row.line;
    row.place = part.place;
    row.problem.clear();
    if (!part.place) row.problem = "it is no point";
    fill(row, part);
    return true;
  }

  void restart() override {
    layer_ = 0;
    parts_.clear();
    feature_.reset();
    for (OGRLayer* layer : layers_) layer->ResetReading();
  }

 private:
  struct Part {
    std::optional<DVec2> place;
    double crown = 0;  ///< of a drawn circle, in the drawing's unit
  };

  static bool may_have_points(OGRLayer& layer) {
    switch (wkbFlatten(layer.GetGeomType())) {
      case wkbPoint:
      case wkbMultiPoint:
      case wkbGeometryCollection:
      case wkbUnknown:
        return true;
      default:
        return false;
    }
  }

  void add_columns(OGRFeatureDefn& definition) {
    std::vector<int>& at = places_.emplace_back();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
      const std::string column = definition.GetFieldDefn(i)->GetNameRef();
      auto known = std::find(columns.begin(), columns.end(), column);
      if (known == columns.end()) known = columns.insert(columns.end(), column);
      at.push_back(static_cast<int>(known - columns.begin()));
    }
  }

  void take_apart() {
    const OGRGeometry* shape = feature_->GetGeometryRef();
    if (!shape || shape->IsEmpty()) {
      if (!drawing_) parts_.push_back({});
      return;
    }
    take(*shape);
    if (parts_.empty() && !drawing_) parts_.push_back({});
  }

  void take(const OGRGeometry& shape) {
    switch (wkbFlatten(shape.getGeometryType())) {
      case wkbPoint: {
        if (drawing_ && is_text()) return;
        const OGRPoint& p = *shape.toPoint();
        parts_.push_back({DVec2(p.getX(), p.getY())});
        return;
      }
      case wkbMultiPoint:
      case wkbGeometryCollection:
        for (const OGRGeometry* part : *shape.toGeometryCollection()) take(*part);
        return;
      case wkbLineString:
        if (drawing_)
          if (const auto circle = circle_of(*shape.toLineString()))
            parts_.push_back({circle->centre, 2 * circle->radius});
        return;
      default:
        return;
    }
  }

  bool is_text() const {
    const int text = feature_->GetFieldIndex("Text"), block = feature_->GetFieldIndex("BlockName");
    return text >= 0 && feature_->IsFieldSetAndNotNull(text) && !(block >= 0 && feature_->IsFieldSetAndNotNull(block));
  }

  // Attributes of an inserted block come as "TAG value".
  template <class Visit>
  static void each_attribute(const OGRFeature& feature, Visit&& visit) {
    const int field = feature.GetFieldIndex("BlockAttributes");
    if (field < 0 || !feature.IsFieldSetAndNotNull(field)) return;
    for (char** entry = feature.GetFieldAsStringList(field); entry && *entry; ++entry) {
      const std::string_view text = *entry;
      const std::size_t blank = text.find(' ');
      if (blank != std::string_view::npos && blank > 0)
        visit(std::string(text.substr(0, blank)), std::string(text.substr(blank + 1)));
    }
  }

  // Every tag that some block has becomes a column.
  void add_attribute_columns() {
    for (OGRLayer* layer : layers_)
      for (const auto& feature : *layer)
        each_attribute(*feature, [&](const std::string& tag, const std::string&) {
          if (std::find(columns.begin(), columns.end(), tag) == columns.end()) columns.push_back(tag);
        });
  }

  void fill(TableRow& row, const Part& part) {
    row.fields.resize(columns.size());
    for (std::string& field : row.fields) field.clear();
    const std::vector<int>& at = places_[layer_];
    for (int i = 0; i < feature_->GetFieldCount(); ++i) {
      if (!feature_->IsFieldSetAndNotNull(i)) continue;
      std::string& out = row.fields[static_cast<std::size_t>(at[static_cast<std::size_t>(i)])];
      if (feature_->GetFieldDefnRef(i)->GetType() == OFTReal) {
        std::array<char, 32> text;
        const auto end = std::to_chars(text.data(), text.data() + text.size(), feature_->GetFieldAsDouble(i));
        out.assign(text.data(), end.ptr);
      } else {
        out = feature_->GetFieldAsString(i);
      }
    }
    if (drawing_) fill_drawn(row, part);
  }

  void fill_drawn(TableRow& row, const Part& part) const {
    const auto field = [&](std::string_view name) -> std::string& {
      return row.fields[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())];
    };
    const auto has = [&](std::string_view name) {
      return std::find(columns.begin(), columns.end(), name) != columns.end();
    };
    each_attribute(*feature_, [&](const std::string& tag, const std::string& value) { field(tag) = value; });
    const std::string layer = has("Layer") ? field("Layer") : "", block = has("BlockName") ? field("BlockName") : "";
    if (std::string& species = field("species"); species.empty())
      species = block.empty() ? layer : layer.empty() || layer == "0" ? block : fmt::format("{} ({})", block, layer);
    if (part.crown > 0) field("crown_diameter_m") = fmt::format("{}", part.crown * metres_per_unit);
  }

  std::string name_;
  Dataset data_;
  std::vector<OGRLayer*> layers_;
  std::vector<std::vector<int>> places_;  ///< of each layer: which column each of its fields is
  std::size_t layer_ = 0;
  OGRFeatureUniquePtr feature_;
  int last_ = 0;            ///< number of the feature read last
  std::deque<Part> parts_;  ///< of feature_, still to come
  bool drawing_ = false;
};

}  // namespace

Result<std::unique_ptr<TreeTable>> vector_table(const std::filesystem::path& path, const std::string& layer) {
  auto table = std::make_unique<VectorTable>();
  if (auto opened = table->open(path, layer); !opened) return opened.error();
  return std::unique_ptr<TreeTable>(std::move(table));
}

}  // namespace bosquet::exchange
