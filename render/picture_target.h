// Picture target: a picture in graphics memory that a window shows, and the screen itself, for those who must not call
// OpenGL.
//
// Context   made, used and freed with the same context current
#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/vec.h"

namespace bosquet::render {

class PictureTarget {
 public:
  PictureTarget() = default;
  PictureTarget(PictureTarget&& other) noexcept;
  PictureTarget& operator=(PictureTarget&& other) noexcept;
  ~PictureTarget();

  /// Makes it this large if it is not; false when the driver refuses.
  bool fit(IVec2 size);
  IVec2 size() const { return size_; }
  unsigned framebuffer() const { return framebuffer_; }
  /// Texture name, its first row at the bottom.
  unsigned texture() const { return texture_; }
  /// What it shows, first row at the top.
  Image read() const;

 private:
  unsigned framebuffer_ = 0, texture_ = 0;
  IVec2 size_{0};
};

/// A texture from an image (1-4 channels of bytes), e.g. for buttons; free with delete_texture.
unsigned make_texture(const Image& image);
void delete_texture(unsigned texture);

/// Fills a framebuffer (0: the window) of this size, and sets the viewport to all of it.
void clear_framebuffer(unsigned framebuffer, IVec2 size, const Vec3& colour);
/// Its pixels, first row at the top.
Image read_framebuffer(unsigned framebuffer, IVec2 size);
/// Whether this context draws on the CPU.
bool draws_by_software();
/// Waits until everything asked for is drawn.
void finish_drawing();

}  // namespace bosquet::render
