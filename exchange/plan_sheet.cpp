#include "exchange/plan_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bosquet::exchange {
namespace {

constexpr double kMargin_mm = 10.0, kGap_mm = 6.0;

struct PaperSize {
  scene::Paper paper;
  const char* name;
  DVec2 mm;
};
constexpr PaperSize kPapers[] = {{scene::Paper::a4, "A4", {297, 210}},
                                 {scene::Paper::a3, "A3", {420, 297}},
                                 {scene::Paper::a2, "A2", {594, 420}},
                                 {scene::Paper::a1, "A1", {841, 594}},
                                 {scene::Paper::a0, "A0", {1189, 841}}};
constexpr int kScales[] = {50,   100,  200,  250,    300,    400,    500,    1000,
                           2000, 2500, 5000, 10'000, 20'000, 25'000, 50'000, 100'000};

double panel_mm(DVec2 paper_mm) { return std::clamp(0.19 * paper_mm.x, 62.0, 100.0); }
/// What is left for the plan itself.
DVec2 field_mm(DVec2 paper_mm) {
  return {paper_mm.x - 2 * kMargin_mm - panel_mm(paper_mm) - 3 * kGap_mm, paper_mm.y - 2 * kMargin_mm - 2 * kGap_mm};
}
bool fits(DVec2 extent_m, DVec2 paper_mm, int scale) {
  const DVec2 drawn_mm = extent_m * (1000.0 / scale), field = field_mm(paper_mm);
  return drawn_mm.x <= field.x && drawn_mm.y <= field.y;
}
/// The largest scale from 1:`from` to 1:`to` that fits; 0 when none does.
int largest_scale(DVec2 extent_m, DVec2 paper_mm, int from, int to) {
  for (const int scale : kScales)
    if (scale >= from && scale <= to && fits(extent_m, paper_mm, scale)) return scale;
  return 0;
}

/// Writes furniture in millimetres from the paper's lower left corner.
class Furniture {
 public:
  Furniture(PlanDrawing& plan, std::size_t layer) : plan_(plan), layer_(layer) {}

  DVec2 place(double x, double y) const { return plan_.low + DVec2(plan_.metres(x), plan_.metres(y)); }
  void line(double x0, double y0, double x1, double y1, float width_mm) {
    PlanPath path;
    path.lines = {{place(x0, y0), place(x1, y1)}};
    path.closed = false;
    path.pen.width_mm = width_mm;
    plan_.items.push_back({layer_, path});
  }
  void area(const std::vector<DVec2>& mm, float pen_mm, float opacity, const Vec3& colour) {
    PlanPath path;
    path.lines.emplace_back();
    for (const DVec2& p : mm) path.lines[0].push_back(place(p.x, p.y));
    path.pen.width_mm = pen_mm;
    path.fill = {opacity, colour};
    plan_.items.push_back({layer_, path});
  }
  void box(double x, double y, double width, double height, float pen_mm, float opacity = 0, Vec3 colour = Vec3(1)) {
    area({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, pen_mm, opacity, colour);
  }
  void text(double x, double y, float height_mm, std::string words, PlanAlign align = PlanAlign::left,
            bool bold = false, bool italic = false) {
    if (words.empty()) return;
    PlanText text{place(x, y), height_mm, std::move(words), align, bold, italic, Vec3(0.1f)};
    plan_.items.push_back({layer_, std::move(text)});
  }
  /// A shape given in millimetres about (0, 0).
  void sample(double x, double y, PlanItem item) {
    const auto moved = [&](DVec2 p) { return place(x + p.x, y + p.y); };
    if (auto* path = std::get_if<PlanPath>(&item.shape)) {
      for (auto& one : path->lines)
        for (DVec2& p : one) p = moved(p);
    } else if (auto* circle = std::get_if<PlanCircle>(&item.shape)) {
      circle->centre = moved(circle->centre);
      circle->radius_m = plan_.metres(circle->radius_m);
    }
    item.layer = layer_;
    plan_.items.push_back(std::move(item));
  }

 private:
  PlanDrawing& plan_;
  std::size_t layer_;
};

// Letters of a sans-serif face are about this wide, as a share of their height: enough to cut what is too long.
constexpr double kLetter = 0.55;

std::string cut(const std::string& words, double width_mm, double height_mm) {
  const auto most = static_cast<std::size_t>(std::max(4.0, width_mm / (kLetter * height_mm)));
  if (words.size() <= most) return words;
  std::size_t end = most - 1;
  while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xC0u) == 0x80u) --end;  // not inside a letter of UTF-8
  return words.substr(0, end) + "…";
}

void draw_north_arrow(Furniture& sheet, double x, double y) {
  sheet.area({{x, y - 8}, {x, y + 8}, {x - 4, y - 8}}, 0.18f, 1.0f, Vec3(0.1f));
  sheet.area({{x, y - 8}, {x, y + 8}, {x + 4, y - 8}}, 0.18f, 1.0f, Vec3(1.0f));
  sheet.text(x, y + 10, 4.0f, "N", PlanAlign::centre, true);
}

void draw_scale_bar(Furniture& sheet, const PlanDrawing& plan, double x, double y, double most_mm) {
  // Five fields of a round length.
  double field_m = 0.1;
  for (double ten = 0.1; ten < 1e6; ten *= 10)
    for (const double part : {1.0, 2.0, 5.0})
      if (5 * ten * part / plan.scale * 1000.0 <= most_mm) field_m = ten * part;
  const double field_mm = field_m / plan.scale * 1000.0;
  for (int k = 0; k < 5; ++k) sheet.box(x + k * field_mm, y, field_mm, 1.6, 0.13f, 1.0f, Vec3(k % 2 ? 1.0f : 0.1f));
  for (const int k : {0, 1, 5})
    sheet.text(x + k * field_mm, y + 2.6, 2.2f, fmt::format("{:g}", k * field_m), PlanAlign::centre);
  sheet.text(x + 5 * field_mm + 3.0, y, 2.2f, "m");
  sheet.text(x, y - 4.0, 2.6f, fmt::format("1:{} ({})", plan.scale, plan.paper));
}

}  // namespace

Result<PlanDrawing> lay_out(const scene::PlanSettings& settings, DVec2 low, DVec2 high) {
  const DVec2 extent = high - low;
  PlanDrawing plan;
  plan.scale = 0;
  const auto take = [&](const PaperSize& paper, int scale) {
    plan.paper = paper.name, plan.paper_mm = paper.mm, plan.scale = scale;
  };
  std::vector<PaperSize> papers;
  for (const PaperSize& paper : kPapers)
    if (settings.paper == paper.paper ||
        (settings.paper == scene::Paper::fitting && paper.paper >= scene::Paper::a3 && paper.paper <= scene::Paper::a1))
      papers.push_back(paper);

  if (settings.scale > 0) {
    for (const PaperSize& paper : papers)
      if (plan.scale == 0 && fits(extent, paper.mm, settings.scale)) take(paper, settings.scale);
    if (plan.scale == 0) {
      const int wanted = largest_scale(extent, papers.back().mm, 1, kScales[std::size(kScales) - 1]);
      return Error{fmt::format("the plan of {:.0f} x {:.0f} m does not fit {} at 1:{}{}", extent.x, extent.y,
                               papers.back().name, settings.scale,
                               wanted ? fmt::format("; 1:{} does", wanted) : std::string())};
    }
  } else {
    for (const int coarsest : {500, 1000, kScales[std::size(kScales) - 1]})
      for (const PaperSize& paper : papers) {
        if (plan.scale != 0) break;
        if (coarsest > 1000 && paper.name != papers.back().name) continue;
        if (const int scale =
                largest_scale(extent, paper.mm, settings.paper == scene::Paper::fitting ? 200 : 50, coarsest))
          take(paper, scale);
      }
    if (plan.scale == 0)
      return Error{fmt::format("the plan of {:.0f} x {:.0f} m fits no sheet at 1:100000", extent.x, extent.y)};
  }

  const DVec2 field = field_mm(plan.paper_mm);
  const DVec2 middle_mm = DVec2(kMargin_mm + kGap_mm) + 0.5 * field;
  plan.low = 0.5 * (low + high) - middle_mm * (plan.scale / 1000.0);
  return plan;
}

void furnish(PlanDrawing& plan, std::size_t layer, const scene::PlanSettings& settings, const std::vector<KeyPart>& key,
             const std::vector<std::string>& notes) {
  Furniture sheet(plan, layer);
  const DVec2 paper = plan.paper_mm;
  const double panel = panel_mm(paper), left = paper.x - kMargin_mm - panel, right = paper.x - kMargin_mm;
  sheet.box(kMargin_mm, kMargin_mm, paper.x - 2 * kMargin_mm, paper.y - 2 * kMargin_mm, 0.5f);
  sheet.line(left, kMargin_mm, left, paper.y - kMargin_mm, 0.35f);

  // Title block, from below.
  const double inset = left + 4.0;
  double y = kMargin_mm + 3.0;
  const auto row = [&](const char* what, const std::string& words) {
    if (words.empty()) return;
    sheet.text(inset, y + 0.6, 2.0f, what);
    sheet.text(inset + 16.0, y + 0.6, 2.5f, cut(words, right - inset - 17.0, 2.5));
    y += 5.0;
  };
  row("Sheet", settings.number);
  row("Date", settings.date);
  row("Drawn by", settings.author);
  row("Project", settings.project);
  if (y > kMargin_mm + 4.0) sheet.line(left, y, right, y, 0.18f), y += 1.0;
  y += 2.5;
  sheet.text(inset, y, 4.5f, cut(plan.title, right - inset - 2.0, 4.5), PlanAlign::left, true);
  y += 8.5;
  sheet.line(left, y, right, y, 0.35f);
  y += 8.0;
  draw_scale_bar(sheet, plan, inset + 1.0, y, panel - 34.0);
  draw_north_arrow(sheet, right - 9.0, y + 4.0);
  y += 20.0;
  sheet.line(left, y, right, y, 0.35f);
  for (auto note = notes.rbegin(); note != notes.rend(); ++note)
    sheet.text(inset, y + 3.0, 2.0f, cut(*note, right - inset - 2.0, 2.0)), y += 3.6;
  const double floor = y + 4.0;

  // Key, from above.
  y = paper.y - kMargin_mm - 8.0;
  for (const KeyPart& part : key) {
    if (part.rows.empty()) continue;
    if (y < floor + 12.0) break;
    sheet.text(inset, y, 3.2f, part.heading, PlanAlign::left, true);
    y -= 7.0;
    std::size_t shown = 0;
    for (const KeyRow& line : part.rows) {
      if (y < floor + (shown + 1 < part.rows.size() ? 5.0 : 0.0)) {
        sheet.text(inset, y, 2.4f, fmt::format("and {} more", part.rows.size() - shown));
        y -= 6.0;
        break;
      }
      for (const PlanItem& item : line.sample) sheet.sample(inset + 3.0, y + 1.0, item);
      double x = inset + 8.0;
      if (!line.code.empty()) sheet.text(x, y, 2.4f, line.code, PlanAlign::left, true), x += 9.0;
      const double room = right - x - 14.0;
      sheet.text(x, line.second.empty() ? y : y + 1.3, 2.4f, cut(line.name, room, 2.4), PlanAlign::left, false,
                 line.italic && !line.second.empty());
      sheet.text(x, y - 1.9, 2.0f, cut(line.second, room, 2.0));
      sheet.text(right - 3.0, y, 2.4f, line.count, PlanAlign::right);
      y -= line.second.empty() ? 5.6 : 7.0;
      ++shown;
    }
    y -= 4.0;
  }
}

}  // namespace bosquet::exchange
