// Plan drawing: a plan sheet as plain shapes, which plan_svg, plan_dxf and plan_png write.
//
// Model     shapes in drawing order, each on a named layer; layers stand in drawing order too. Crowns are drawn as they
//           grew: the farthest wood in 32 directions about the crown's middle, smoothed; clipped trees as the plan of
//           their form, neighbours of one species joined. A tree to be removed, which is not grown, is a circle of its
//           species' width
// Source    root protection: a circle of 12 trunk diameters, at most 15 m (BS 5837:2012, 4.6)
// Decision  one symbol a species, by its place in the key: a pattern of the crown's outline and a tint; needle trees
//           have a spiny outline. What a status is shows in pen and fill alone, so that it can be told in any species:
//           existing strong, proposed thin, to be removed dashed and crossed, protected strong with its root circle
// Decision  trees that are drawn as another species than their inventory names (substitutes.h) have a row, code and symbol
//           of their own under the inventory's name, and the row says what they are drawn as
// Decision  the sheet's furniture (key, scale bar, north arrow, title block, frame) is shapes like the rest, so that no
//           writer knows of it
// Frame     plan metres (east, north) from the site's south-west corner, for the furniture too; the paper's lower left
//           corner is at `low`, its size in metres is paper_mm * scale / 1000
// Units     metres on the ground; pens, dashes and letters in millimetres on paper; colours sRGB 0..1
// Errors    a site that does not fit the paper at the scale asked for; an underlay that cannot be read
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"
#include "core/result.h"
#include "core/vec.h"
#include "scene/grown_scene.h"

namespace bosquet::exchange {

enum class Dashes { none, dashed, dash_dot, dotted };

struct PlanPen {
  float width_mm = 0.18f;  ///< 0: not drawn
  Vec3 colour{0.0f};
  Dashes dashes = Dashes::none;
};
struct PlanFill {
  float opacity = 0.0f;  ///< 0: not filled
  Vec3 colour{1.0f};
};

/// Rings or open lines; areas are filled by the even-odd rule.
struct PlanPath {
  std::vector<std::vector<DVec2>> lines;
  bool closed = true;
  PlanPen pen;
  PlanFill fill;
};
struct PlanCircle {
  DVec2 centre{0.0};
  double radius_m = 1.0;
  PlanPen pen;
  PlanFill fill;
};
enum class PlanAlign { left, centre, right };
struct PlanText {
  DVec2 at{0.0};  ///< on the base line
  float height_mm = 2.5f;
  std::string words;
  PlanAlign align = PlanAlign::left;
  bool bold = false, italic = false;
  Vec3 colour{0.1f};
};
struct PlanPicture {
  std::shared_ptr<const Image> image;
  DVec2 low{0.0}, high{1.0};
  float opacity = 1.0f;
};

struct PlanItem {
  std::size_t layer = 0;
  std::variant<PlanPath, PlanCircle, PlanText, PlanPicture> shape;
};

struct PlanLayer {
  std::string name;  ///< in capitals, digits and hyphens, as CAD programs take them
  int colour = 7;    ///< AutoCAD colour index, for programs that colour by layer
};

struct PlanDrawing {
  int scale = 500;
  std::string paper;  ///< "A3"
  DVec2 paper_mm{420.0, 297.0};
  DVec2 low{0.0};         ///< the paper's lower left corner
  DVec2 south_west{0.0};  ///< projected coordinates of the site's corner
  std::string title;
  std::vector<PlanLayer> layers;
  std::vector<PlanItem> items;  ///< by layer, then in drawing order

  double metres(double mm) const { return mm * scale / 1000.0; }
  /// Millimetres from the paper's upper left corner, y down.
  DVec2 on_paper(DVec2 plan) const {
    const DVec2 from_low = (plan - low) * (1000.0 / scale);
    return {from_low.x, paper_mm.y - from_low.y};
  }
};

/// The sheet of a grown scene; `name` titles it when the document has no title.
Result<PlanDrawing> draw_plan(const scene::GrownScene& grown, const std::string& name);

/// The writers; bytes written.
Result<std::uint64_t> write_plan_svg(const PlanDrawing& plan, const std::filesystem::path& target);
Result<std::uint64_t> write_plan_dxf(const PlanDrawing& plan, const std::filesystem::path& target);
Result<std::uint64_t> write_plan_png(const PlanDrawing& plan, const std::filesystem::path& target);

}  // namespace bosquet::exchange
