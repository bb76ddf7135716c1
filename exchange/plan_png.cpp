// Plan as PNG: drawn by Cairo at 200 dots an inch, its lettering in the system's sans-serif face.
#include <cairo/cairo.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "exchange/file_output.h"
#include "exchange/image_file.h"
#include "exchange/plan_drawing.h"

namespace bosquet::exchange {
namespace {

constexpr double kDotsPerInch = 200.0, kDotsPerMm = kDotsPerInch / 25.4;

struct FreeSurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct FreeContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, FreeSurface>;

class Page {
 public:
  Page(const PlanDrawing& plan, cairo_t* page) : plan_(plan), page_(page) {}

  void draw(const PlanPath& path) {
    cairo_new_path(page_);
    for (const auto& line : path.lines) {
      cairo_new_sub_path(page_);
      for (const DVec2& at : line) {
        const DVec2 p = plan_.on_paper(at);
        cairo_line_to(page_, p.x, p.y);
      }
      if (path.closed) cairo_close_path(page_);
    }
    paint(path.pen, path.fill);
  }
  void draw(const PlanCircle& circle) {
    const DVec2 p = plan_.on_paper(circle.centre);
    cairo_new_path(page_);
    cairo_arc(page_, p.x, p.y, circle.radius_m * 1000.0 / plan_.scale, 0.0, 2.0 * M_PI);
    paint(circle.pen, circle.fill);
  }
  void draw(const PlanText& text) {
    cairo_select_font_face(page_, "sans-serif", text.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                           text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(page_, static_cast<double>(text.height_mm) / 0.72);  // capitals are 0.72 of a face's size
    cairo_text_extents_t extents;
    cairo_text_extents(page_, text.words.c_str(), &extents);
    const double share = 0.5 * static_cast<double>(text.align);
    const DVec2 p = plan_.on_paper(text.at);
    use(text.colour, 1.0f);
    cairo_move_to(page_, p.x - share * extents.x_advance, p.y);
    cairo_show_text(page_, text.words.c_str());
  }
  void draw(const PlanPicture& picture) {
    const Image& image = *picture.image;
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
    cairo_surface_flush(surface.get());
    unsigned char* rows = cairo_image_surface_get_data(surface.get());
    if (!rows) return;
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    for (int j = 0; j < image.height; ++j)
      for (int i = 0; i < image.width; ++i) {
        const std::uint8_t* p = image.at(i, j);
        const auto channel = [&](int c) { return static_cast<std::uint32_t>(p[image.channels >= 3 ? c : 0]); };
        const std::uint32_t a = image.channels == 4 ? p[3] : 255u;
        const std::uint32_t word =
            a << 24 | channel(0) * a / 255 << 16 | channel(1) * a / 255 << 8 | channel(2) * a / 255;
        std::memcpy(rows + static_cast<std::size_t>(j) * stride + 4 * static_cast<std::size_t>(i), &word, 4);
      }
    cairo_surface_mark_dirty(surface.get());
    const DVec2 upper = plan_.on_paper({picture.low.x, picture.high.y});
    const DVec2 size = plan_.on_paper({picture.high.x, picture.low.y}) - upper;
    cairo_save(page_);
    cairo_translate(page_, upper.x, upper.y);
    cairo_scale(page_, size.x / image.width, size.y / image.height);
    cairo_set_source_surface(page_, surface.get(), 0, 0);
    cairo_paint_with_alpha(page_, static_cast<double>(picture.opacity));
    cairo_restore(page_);
  }

 private:
  void use(const Vec3& colour, float opacity) {
    cairo_set_source_rgba(page_, static_cast<double>(colour.r), static_cast<double>(colour.g),
                          static_cast<double>(colour.b), static_cast<double>(opacity));
  }
  void paint(const PlanPen& pen, const PlanFill& fill) {
    if (fill.opacity > 0.0f) {
      use(fill.colour, fill.opacity);
      cairo_fill_preserve(page_);
    }
    if (pen.width_mm > 0.0f) {
      constexpr double kDashed[] = {2, 1}, kDashDot[] = {4, 1, 0.5, 1}, kDotted[] = {0.5, 0.8};
      const auto dashes = [&](const double* lengths, int count) { cairo_set_dash(page_, lengths, count, 0.0); };
      dashes(nullptr, 0);
      if (pen.dashes == Dashes::dashed) dashes(kDashed, 2);
      if (pen.dashes == Dashes::dash_dot) dashes(kDashDot, 4);
      if (pen.dashes == Dashes::dotted) dashes(kDotted, 2);
      use(pen.colour, 1.0f);
      cairo_set_line_width(page_, static_cast<double>(pen.width_mm));
      cairo_stroke(page_);
    }
    cairo_new_path(page_);
  }

  const PlanDrawing& plan_;
  cairo_t* page_;
};

}  // namespace

Result<std::uint64_t> write_plan_png(const PlanDrawing& plan, const std::filesystem::path& target) {
  const int width = static_cast<int>(std::lround(plan.paper_mm.x * kDotsPerMm));
  const int height = static_cast<int>(std::lround(plan.paper_mm.y * kDotsPerMm));
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  const std::unique_ptr<cairo_t, FreeContext> context(cairo_create(surface.get()));
  cairo_t* page = context.get();
  cairo_set_source_rgb(page, 1, 1, 1);
  cairo_paint(page);
  cairo_scale(page, kDotsPerMm, kDotsPerMm);
  cairo_set_fill_rule(page, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
  Page drawing(plan, page);
  for (const PlanItem& item : plan.items) std::visit([&](const auto& shape) { drawing.draw(shape); }, item.shape);
  if (const cairo_status_t status = cairo_status(page); status != CAIRO_STATUS_SUCCESS)
    return cannot_finish(fmt::format("{}: the sheet of {} x {} pixels could not be drawn: {}", target.string(), width,
                                     height, cairo_status_to_string(status)));

  cairo_surface_flush(surface.get());
  Image image(width, height, 3);
  const unsigned char* rows = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      std::uint32_t word = 0;
      std::memcpy(&word, rows + static_cast<std::size_t>(j) * stride + 4 * static_cast<std::size_t>(i), 4);
      for (int c = 0; c < 3; ++c) image.at(i, j)[c] = static_cast<std::uint8_t>(word >> (16 - 8 * c));
    }
  return write_file(target, encode_png(image));
}

}  // namespace bosquet::exchange
