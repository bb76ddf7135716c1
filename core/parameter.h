// Parameters: declared once, used by the file readers, range checks, documentation and panels.
//
// A parameter struct offers one function that visits its fields,
//
//   template <class Parameters, class Visitor>   // Parameters is const or not
//   void describe(Parameters& p, Visitor& visit) {
//     visit(Real{"branching_angle_deg", "deg", 10, 120, "Angle between a lateral shoot and its parent axis"},
//     p.branching_angle_deg); visit(Whole{...}, p.whorl); visit(Switch{...}, p.planar); visit(Choice{...},
//     p.phyllotaxis); visit(Colour{...}, p.ridge); visit(Text{...}, p.name); visit(Tables{"phase", "..."}, p.phases);
//     // phases: vector of a described struct
//   }
//
// and defaults are the struct's member initialisers. `name` is the key in files. Numbers in files are in the unit
// stated.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/vec.h"

namespace bosquet {

struct Real {  ///< a float or double
  std::string_view name, unit;
  double low, high;  ///< allowed range, both included
  std::string_view meaning;
};
struct Whole {  ///< an int
  std::string_view name;
  int low, high;
  std::string_view meaning;
};
struct Switch {  ///< a bool
  std::string_view name, meaning;
};
struct Choice {  ///< an enum class whose values 0, 1, ... have these names
  std::string_view name;
  std::span<const std::string_view> names;
  std::string_view meaning;
};
struct Colour {  ///< a Vec3, sRGB in 0..1; "RRGGBB" in files
  std::string_view name, meaning;
};
struct Text {  ///< a std::string
  std::string_view name, meaning;
};
struct Tables {  ///< a std::vector of structs that are described themselves
  std::string_view name, meaning;
};

}  // namespace bosquet
