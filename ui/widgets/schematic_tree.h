// Schematic tree: a small tree in one plane that grows anew whenever a parameter moves, as a picture of what it does.
//
// Source    Longay 2014, 5.4 (the small tree behind the widgets)
// Cost      a few hundred internodes, some milliseconds, only when the parameters changed
// Threads   one: the window's
#pragma once

#include <cstdint>

#include "growth/parameters.h"
#include "growth/skeleton.h"

namespace bosquet::ui {

class SchematicTree {
 public:
  /// Grows again if the parameters differ from the last ones; wrong ones leave the tree as it was.
  void set(const growth::Parameters& parameters);

  /// Draws it standing in a box of the present window (pixels).
  void draw(float width, float height) const;

  const growth::Skeleton& skeleton() const { return skeleton_; }

 private:
  std::uint64_t grown_for_ = 0;
  growth::Skeleton skeleton_;
};

}  // namespace bosquet::ui
