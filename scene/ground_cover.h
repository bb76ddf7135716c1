// Ground cover: the grass that lawns and meadows are shown with near the beholder.
//
// Units     metres; density as a share of the usual one
// Decision  pictures and the window draw tufts near the eye, where they can be told. Files have them only when it is asked
//           for: other programs have lawns of their own, and a file must not grow by what most of its readers do not want
#pragma once

#include <concepts>
#include <type_traits>

#include "core/parameter.h"

namespace bosquet::scene {

struct GroundCover {
  float density = 1.0f;
  float lawn_height_m = 0.06f, meadow_height_m = 0.4f;
  bool in_files = false;

  bool operator==(const GroundCover&) const = default;
};

template <class P, class Visitor>
requires std::same_as<std::remove_const_t<P>, GroundCover>
void describe(P& p, Visitor& visit) {
  visit(Real{"density", "", 0, 3, "Tufts of grass on lawns and meadows; 1 is usual, 0 draws none"}, p.density);
  visit(Real{"lawn_height_m", "m", 0.01, 0.5, "Height of mown grass"}, p.lawn_height_m);
  visit(Real{"meadow_height_m", "m", 0.03, 2, "Height of the tallest meadow grass in summer"}, p.meadow_height_m);
  visit(Switch{"in_files", "Writes the tufts near the cameras into .glb and .gltf too"}, p.in_files);
}

}  // namespace bosquet::scene
