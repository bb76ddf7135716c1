// Plan as DXF, release 12 (AC1009) in ASCII: what every CAD program and GDAL reads.
//
// Model     metres on the ground, placed by the site's projected corner; letters and furniture in metres at the plan's
//           scale. A layer for each of the plan's, named as there; closed lines are closed polylines, circles circles
// Source    Autodesk, DXF reference for release 12; letters beyond ASCII as \U+XXXX
// Decision  release 12 has no fills, pen widths and pictures: the fill of an area and the underlay are left out, which a
//           drawing that goes on in CAD can do without. It needs no handles, so no reader can stumble over them
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include "exchange/file_output.h"
#include "exchange/plan_drawing.h"

namespace bosquet::exchange {
namespace {

constexpr std::array<const char*, 4> kLineTypes{"CONTINUOUS", "DASHED", "DASHDOT", "DOT"};

/// UTF-8 as ASCII with \U+XXXX; control characters are dropped.
std::string dxf_text(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0xC0 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    unsigned code = more == 0 ? lead : lead & (0x3Fu >> more);
    for (std::size_t k = 1; k <= more && i + k < text.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3Fu);
    i += more + 1;
    if (code >= 0x20 && code < 0x7F)
      out += static_cast<char>(code);
    else if (code >= 0x80)
      out += code <= 0xFFFF ? fmt::format("\\U+{:04X}", code) : std::string("?");
  }
  return out;
}

class DxfText {
 public:
  explicit DxfText(const PlanDrawing& plan) : plan_(plan) {}

  std::string text() {
    header();
    tables();
    section("ENTITIES");
    for (const PlanItem& item : plan_.items) {
      layer_ = &plan_.layers[item.layer].name;
      std::visit([&](const auto& shape) { draw(shape); }, item.shape);
    }
    end_section();
    put(0, "EOF");
    return std::move(text_);
  }

 private:
  void put(int code, const std::string& value) { fmt::format_to(std::back_inserter(text_), "{:3}\n{}\n", code, value); }
  void put(int code, int value) { put(code, fmt::format("{}", value)); }
  void put(int code, double value) { put(code, fmt::format("{:.4f}", value)); }
  void point(int code, DVec2 plan) {
    const DVec2 p = plan + plan_.south_west;
    put(code, p.x), put(code + 10, p.y), put(code + 20, 0.0);
  }
  void section(const char* name) { put(0, "SECTION"), put(2, name); }
  void end_section() { put(0, "ENDSEC"); }
  void table(const char* name, std::size_t entries) {
    put(0, "TABLE"), put(2, name), put(70, static_cast<int>(entries));
  }
  void end_table() { put(0, "ENDTAB"); }

  void header() {
    section("HEADER");
    put(9, "$ACADVER"), put(1, "AC1009");
    put(9, "$EXTMIN"), point(10, plan_.low);
    put(9, "$EXTMAX"), point(10, plan_.low + plan_.paper_mm * (plan_.scale / 1000.0));
    put(9, "$LUNITS"), put(70, 2);
    put(9, "$LTSCALE"), put(40, 1.0);
    put(9, "$FILLMODE"), put(70, 1);
    end_section();
  }
  void line_type(const char* name, const char* picture, const std::vector<double>& parts_mm) {
    put(0, "LTYPE"), put(2, name), put(70, 0), put(3, picture), put(72, 65);
    put(73, static_cast<int>(parts_mm.size()));
    double length = 0;
    for (const double part : parts_mm) length += std::abs(part);
    put(40, plan_.metres(length));
    for (const double part : parts_mm) put(49, plan_.metres(part));
  }
  void tables() {
    section("TABLES");
    table("LTYPE", kLineTypes.size());
    line_type("CONTINUOUS", "Solid line", {});
    line_type("DASHED", "__ __ __", {2, -1});
    line_type("DASHDOT", "____ . ____ .", {4, -1, 0.5, -1});
    line_type("DOT", ". . . .", {0.5, -0.8});
    end_table();
    table("LAYER", plan_.layers.size() + 1);
    const auto layer = [&](const std::string& name, int colour) {
      put(0, "LAYER"), put(2, name), put(70, 0), put(62, colour), put(6, "CONTINUOUS");
    };
    layer("0", 7);
    for (const PlanLayer& one : plan_.layers) layer(one.name, one.colour);
    end_table();
    table("STYLE", 1);
    put(0, "STYLE"), put(2, "STANDARD"), put(70, 0), put(40, 0.0), put(41, 1.0), put(50, 0.0), put(71, 0), put(42, 1.0);
    put(3, "txt"), put(4, "");
    end_table();
    end_section();
  }
  void entity(const char* name, Dashes dashes) {
    put(0, name), put(8, *layer_);
    if (dashes != Dashes::none) put(6, kLineTypes[static_cast<std::size_t>(dashes)]);
  }
  void draw(const PlanPath& path) {
    for (const auto& line : path.lines) {
      if (line.size() < 2) continue;
      entity("POLYLINE", path.pen.dashes);
      put(66, 1), put(10, 0.0), put(20, 0.0), put(30, 0.0), put(70, path.closed ? 1 : 0);
      for (const DVec2& p : line) {
        put(0, "VERTEX"), put(8, *layer_);
        point(10, p);
      }
      put(0, "SEQEND"), put(8, *layer_);
    }
  }
  void draw(const PlanCircle& circle) {
    entity("CIRCLE", circle.pen.dashes);
    point(10, circle.centre);
    put(40, circle.radius_m);
  }
  void draw(const PlanText& text) {
    entity("TEXT", Dashes::none);
    point(10, text.at);
    put(40, plan_.metres(static_cast<double>(text.height_mm)));
    put(1, dxf_text(text.words));
    if (text.align != PlanAlign::left) {
      put(72, text.align == PlanAlign::centre ? 1 : 2);
      point(11, text.at);
    }
  }
  void draw(const PlanPicture&) {}

  const PlanDrawing& plan_;
  const std::string* layer_ = nullptr;
  std::string text_;
};

}  // namespace

Result<std::uint64_t> write_plan_dxf(const PlanDrawing& plan, const std::filesystem::path& target) {
  return write_file(target, DxfText(plan).text());
}

}  // namespace bosquet::exchange
