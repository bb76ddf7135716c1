// Sheet: a page of pictures, lines and lettering, drawn with Cairo.
//
// Frame     pixels, (0, 0) the upper left corner, y down
// Units     pixels; colours sRGB 0..1
// Decision  Cairo sets the lettering in the system's sans-serif face (Fontconfig picks it) and draws anti-aliased
// Errors    no memory for the page: kind cannot_finish
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/image.h"
#include "core/result.h"
#include "core/vec.h"

namespace bosquet::cli {

enum class Align { left, centre, right };

struct Lettering {
  double size = 20.0;
  Align align = Align::left;
  bool bold = false, italic = false;
  Vec3 colour{0.13f};
};

class Sheet {
 public:
  /// A white page.
  static Result<Sheet> create(int width, int height);
  Sheet(Sheet&&) noexcept;
  Sheet& operator=(Sheet&&) noexcept;
  ~Sheet();

  /// `y` is the base line; returns the text's width.
  double text(double x, double y, std::string_view words, const Lettering& lettering);
  double text_width(std::string_view words, const Lettering& lettering) const;
  void line(double x0, double y0, double x1, double y1, double width, const Vec3& colour);
  void box(double x, double y, double width, double height, const Vec3& colour);
  /// A picture that was drawn on black, with its cover of each pixel as alpha (render::View without sky). It is laid
  /// on the page as drawing programs do, by shares of sRGB values: twigs thinner than a pixel stay as dark as one
  /// expects of a drawing.
  void picture(double x, double y, const Image& drawn_on_black);

  Image image() const;

 private:
  struct State;
  explicit Sheet(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace bosquet::cli
