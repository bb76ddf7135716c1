// Thumbnails: a small picture of each species, its free-standing tree grown, meshed and drawn in the background.
//
// Model     one nice thread with an OpenGL context of its own takes the species one after another; a picture is kept on
//           the disk under a hash of all that the species says, so that it is drawn once on a machine
// Where     $XDG_CACHE_HOME/bosquet/thumbnails, else ~/.cache/bosquet/thumbnails
// Errors    none: a species that cannot be drawn has no picture, and who asks draws something else
// Context   the window's OpenGL context current, the same for all calls; the destructor too
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "core/result.h"
#include "scene/species.h"

namespace bosquet::ui {

inline constexpr int kThumbnail_px = 96;

class Thumbnails {
 public:
  Thumbnails();
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  /// The texture of a species' picture, first row at the top; 0 while there is none.
  unsigned of(const std::shared_ptr<const scene::Species>& species);
  /// Forgets all but these species, with their textures: at the beginning of a frame, while nothing draws them.
  void keep(const std::vector<std::shared_ptr<const scene::Species>>& species);
  /// Takes what was finished: at most one picture, so that a frame stays short.
  void collect();
  /// Nothing is drawn or waited for.
  bool settled() const;

 private:
  struct State;
  struct Entry {
    std::shared_ptr<const scene::Species> species;
    unsigned texture = 0;
  };
  std::unique_ptr<State> state_;
  std::map<const scene::Species*, Entry> entries_;
};

/// A hash of all that decides a species' picture.
std::uint64_t thumbnail_key(const std::shared_ptr<const scene::Species>& species);

/// The picture itself, kThumbnail_px square, transparent behind the tree; needs a current OpenGL context.
Result<Image> draw_thumbnail(const scene::Species& species, const Progress* progress);

}  // namespace bosquet::ui
