// Plan as SVG 1.1: a group for each layer (which Inkscape shows as one), letters as text, a user unit is a millimetre.
//
// Decision  written by hand and not through Cairo: that would flatten layers and turn letters into outlines, and draws
//           other bytes with every version. Same plan, same bytes
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

#include "exchange/file_output.h"
#include "exchange/image_file.h"
#include "exchange/plan_drawing.h"

namespace bosquet::exchange {
namespace {

using Out = std::back_insert_iterator<std::string>;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

std::string colour(const Vec3& c) {
  const auto byte = [](float v) { return static_cast<int>(std::lround(v * 255.0f)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.r), byte(c.g), byte(c.b));
}

std::string base64(const Bytes& bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned>(bytes[k]) : 0u; };
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (unsigned k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kLetters[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

class SvgText {
 public:
  explicit SvgText(const PlanDrawing& plan) : plan_(plan) {}

  std::string text() {
    const DVec2 mm = plan_.paper_mm;
    fmt::format_to(out(),
                   "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
                   "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" width=\"{0:g}mm\" "
                   "height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\" font-family=\"sans-serif\">\n<title>{2}</title>\n"
                   "<desc>Plan at 1:{3}</desc>\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
                   mm.x, mm.y, escaped(plan_.title), plan_.scale);
    std::size_t at = 0;
    for (std::size_t layer = 0; layer < plan_.layers.size(); ++layer) {
      const std::string name = escaped(plan_.layers[layer].name);
      fmt::format_to(out(), "<g id=\"{0}\" inkscape:groupmode=\"layer\" inkscape:label=\"{0}\">\n", name);
      for (; at < plan_.items.size() && plan_.items[at].layer == layer; ++at)
        std::visit([&](const auto& shape) { draw(shape); }, plan_.items[at].shape);
      text_ += "</g>\n";
    }
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  Out out() { return std::back_inserter(text_); }

  void style(const PlanPen& pen, const PlanFill& fill) {
    if (fill.opacity > 0.0f) {
      fmt::format_to(out(), " fill=\"{}\"", colour(fill.colour));
      if (fill.opacity < 1.0f) fmt::format_to(out(), " fill-opacity=\"{:.2f}\"", fill.opacity);
    } else {
      text_ += " fill=\"none\"";
    }
    if (pen.width_mm <= 0.0f) return;
    fmt::format_to(out(), " stroke=\"{}\" stroke-width=\"{:.3g}\"", colour(pen.colour), pen.width_mm);
    if (pen.dashes == Dashes::dashed) text_ += " stroke-dasharray=\"2 1\"";
    if (pen.dashes == Dashes::dash_dot) text_ += " stroke-dasharray=\"4 1 0.5 1\"";
    if (pen.dashes == Dashes::dotted) text_ += " stroke-dasharray=\"0.5 0.8\"";
  }
  void draw(const PlanPath& path) {
    text_ += "<path d=\"";
    for (const auto& line : path.lines) {
      for (std::size_t k = 0; k < line.size(); ++k) {
        const DVec2 p = plan_.on_paper(line[k]);
        fmt::format_to(out(), "{}{:.2f} {:.2f}", k ? "L" : "M", p.x, p.y);
      }
      if (path.closed) text_ += "Z";
    }
    text_ += "\" fill-rule=\"evenodd\" stroke-linejoin=\"round\"";
    style(path.pen, path.fill);
    text_ += "/>\n";
  }
  void draw(const PlanCircle& circle) {
    const DVec2 p = plan_.on_paper(circle.centre);
    fmt::format_to(out(), "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"", p.x, p.y,
                   circle.radius_m * 1000.0 / plan_.scale);
    style(circle.pen, circle.fill);
    text_ += "/>\n";
  }
  void draw(const PlanText& text) {
    const DVec2 p = plan_.on_paper(text.at);
    constexpr const char* kAnchors[] = {"start", "middle", "end"};
    // The height of a plan's letters is that of its capitals, some 0.72 of a face's size.
    fmt::format_to(
        out(), "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\"{}{}>{}</text>\n",
        p.x, p.y, static_cast<double>(text.height_mm) / 0.72, kAnchors[static_cast<int>(text.align)],
        colour(text.colour), text.bold ? " font-weight=\"bold\"" : "", text.italic ? " font-style=\"italic\"" : "",
        escaped(text.words));
  }
  void draw(const PlanPicture& picture) {
    const DVec2 upper = plan_.on_paper({picture.low.x, picture.high.y}),
                lower = plan_.on_paper({picture.high.x, picture.low.y});
    const bool opaque = picture.image->channels == 3;
    fmt::format_to(out(),
                   "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" opacity=\"{:.2f}\" "
                   "preserveAspectRatio=\"none\" xlink:href=\"data:image/{};base64,",
                   upper.x, upper.y, lower.x - upper.x, lower.y - upper.y, picture.opacity, opaque ? "jpeg" : "png");
    text_ += base64(opaque ? encode_jpeg(*picture.image) : encode_png(*picture.image));
    text_ += "\"/>\n";
  }

  const PlanDrawing& plan_;
  std::string text_;
};

}  // namespace

Result<std::uint64_t> write_plan_svg(const PlanDrawing& plan, const std::filesystem::path& target) {
  return write_file(target, SvgText(plan).text());
}

}  // namespace bosquet::exchange
