#include "cli/sheet.h"

#include <cairo/cairo.h>

#include <algorithm>
#include <cstring>

#include "render/srgb.h"

namespace bosquet::cli {
namespace {

struct FreeSurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct FreeContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, FreeSurface>;

void use(cairo_t* page, const Vec3& colour) {
  cairo_set_source_rgb(page, static_cast<double>(colour.r), static_cast<double>(colour.g),
                       static_cast<double>(colour.b));
}

void use(cairo_t* page, const Lettering& l) {
  cairo_select_font_face(page, "sans-serif", l.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                         l.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(page, l.size);
}

// Cairo's own order of bytes in a word: alpha, red, green, blue from the highest, colours multiplied by alpha.
std::uint32_t pack(std::uint32_t a, std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return a << 24 | r << 16 | g << 8 | b;
}

}  // namespace

struct Sheet::State {
  Surface surface;
  std::unique_ptr<cairo_t, FreeContext> page;
};

Sheet::Sheet(std::unique_ptr<State> state) : state_(std::move(state)) {}
Sheet::Sheet(Sheet&&) noexcept = default;
Sheet& Sheet::operator=(Sheet&&) noexcept = default;
Sheet::~Sheet() = default;

Result<Sheet> Sheet::create(int width, int height) {
  auto state = std::make_unique<State>();
  state->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  state->page.reset(cairo_create(state->surface.get()));
  if (const cairo_status_t status = cairo_status(state->page.get()); status != CAIRO_STATUS_SUCCESS)
    return cannot_finish("cannot make a page of " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels: " + cairo_status_to_string(status));
  Sheet sheet(std::move(state));
  sheet.box(0, 0, width, height, Vec3(1.0f));
  return sheet;
}

double Sheet::text_width(std::string_view words, const Lettering& lettering) const {
  use(state_->page.get(), lettering);
  cairo_text_extents_t extents;
  cairo_text_extents(state_->page.get(), std::string(words).c_str(), &extents);
  return extents.x_advance;
}

double Sheet::text(double x, double y, std::string_view words, const Lettering& lettering) {
  const double width = text_width(words, lettering);
  const double share = lettering.align == Align::left ? 0.0 : lettering.align == Align::centre ? 0.5 : 1.0;
  cairo_t* page = state_->page.get();
  use(page, lettering.colour);
  cairo_move_to(page, x - share * width, y);
  cairo_show_text(page, std::string(words).c_str());
  return width;
}

void Sheet::line(double x0, double y0, double x1, double y1, double width, const Vec3& colour) {
  cairo_t* page = state_->page.get();
  use(page, colour);
  cairo_set_line_width(page, width);
  cairo_move_to(page, x0, y0), cairo_line_to(page, x1, y1);
  cairo_stroke(page);
}

void Sheet::box(double x, double y, double width, double height, const Vec3& colour) {
  cairo_t* page = state_->page.get();
  use(page, colour);
  cairo_rectangle(page, x, y, width, height);
  cairo_fill(page);
}

void Sheet::picture(double x, double y, const Image& drawn) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, drawn.width, drawn.height));
  cairo_surface_flush(surface.get());
  unsigned char* rows = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  for (int j = 0; rows && j < drawn.height; ++j)
    for (int i = 0; i < drawn.width; ++i) {
      const std::uint8_t* p = drawn.at(i, j);
      if (p[3] == 0) continue;  // the surface is made empty
      const float cover = static_cast<float>(p[3]) / 255.0f;
      const auto own = [&](int c) {
        const std::uint8_t colour = render::srgb_of_linear(render::linear_of_srgb(p[c]) / cover);
        return static_cast<std::uint32_t>(cover * static_cast<float>(colour) + 0.5f);
      };
      const std::uint32_t word = pack(p[3], own(0), own(1), own(2));
      std::memcpy(rows + static_cast<std::size_t>(j) * stride + 4 * static_cast<std::size_t>(i), &word, 4);
    }
  cairo_surface_mark_dirty(surface.get());
  cairo_t* page = state_->page.get();
  cairo_set_source_surface(page, surface.get(), x, y);
  cairo_paint(page);
}

Image Sheet::image() const {
  cairo_surface_flush(state_->surface.get());
  Image image(cairo_image_surface_get_width(state_->surface.get()),
              cairo_image_surface_get_height(state_->surface.get()), 3);
  const unsigned char* rows = cairo_image_surface_get_data(state_->surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(state_->surface.get()));
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) {
      std::uint32_t word;
      std::memcpy(&word, rows + static_cast<std::size_t>(j) * stride + 4 * static_cast<std::size_t>(i), 4);
      for (int c = 0; c < 3; ++c) image.at(i, j)[c] = static_cast<std::uint8_t>(word >> (16 - 8 * c));
    }
  return image;
}

}  // namespace bosquet::cli
