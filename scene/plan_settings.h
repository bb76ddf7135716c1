// Plan settings: what a plan sheet of the site is like, and the picture that lies beneath it.
//
// Units     metres on the ground, millimetres on paper
// Frame     plan (east, north) from the site's south-west corner
// Decision  the sheet's title block tells only what is written here: nobody's name is made up
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/parameter.h"
#include "core/vec.h"

namespace bosquet::scene {

enum class Paper { fitting, a4, a3, a2, a1, a0 };
inline constexpr std::array<std::string_view, 6> kPaperNames{"fitting", "A4", "A3", "A2", "A1", "A0"};

struct PlanSettings {
  Paper paper = Paper::fitting;
  int scale = 0;  ///< 1 : scale; 0 chooses
  std::string title, project, author, date, number;
  float contours_m = 0.0f;  ///< height between contour lines; 0 chooses, below 0 draws none
  bool labels = true;       ///< species' codes beside trunks where there is room

  bool operator==(const PlanSettings&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, PlanSettings>
void describe(P& p, Visitor& visit) {
  visit(Choice{"paper", kPaperNames, "Sheet, lying; fitting is the smallest that holds the site at a good scale"},
        p.paper);
  visit(Whole{"scale", 0, 100'000, "Scale 1 to this number; 0 is the largest usual one that fits the paper"}, p.scale);
  visit(Text{"title", "Title of the sheet; the recipe's name when nothing is said"}, p.title);
  visit(Text{"project", "Project, in the title block"}, p.project);
  visit(Text{"author", "Who drew it, in the title block"}, p.author);
  visit(Text{"date", "Date, in the title block"}, p.date);
  visit(Text{"number", "Number of the sheet, in the title block"}, p.number);
  visit(Real{"contours_m", "m", -1, 1000, "Height between contour lines; 0 chooses, -1 draws none"}, p.contours_m);
  visit(Switch{"labels", "Writes the species' code beside each trunk where there is room"}, p.labels);
}

/// A picture of a plan or from the air, to draw over.
struct Underlay {
  std::string file;  ///< empty: none
  DVec2 south_west{0.0};
  float width_m = 0.0f;  ///< on the ground; its height follows the picture's
  float opacity = 0.5f;

  bool operator==(const Underlay&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, Underlay>
void describe(P& p, Visitor& visit) {
  visit(Real{"width_m", "m", 0.1, 1e6, "Width of the picture on the ground"}, p.width_m);
  visit(Real{"opacity", "", 0, 1, "How strongly it shows"}, p.opacity);
}

}  // namespace bosquet::scene
