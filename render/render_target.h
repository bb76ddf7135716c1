// Render target: framebuffers the renderer draws into.
#pragma once

#include "render/gl.h"

namespace bosquet::render {

/// Colour and depth of one tile: multisampled, then resolved into sRGB bytes.
class TileTarget {
 public:
  /// Makes it this large if it is not; false when the driver refuses.
  bool fit(int width, int height, int samples);

  GLuint drawn() const { return samples_ > 1 ? drawn_.name() : resolved_.name(); }
  GLuint resolved() const { return resolved_.name(); }

  /// Averages the samples of the lower left w x h pixels, in linear light; leaves `resolved` bound for reading.
  void resolve(int w, int h) const;

 private:
  int width_ = 0, height_ = 0, samples_ = 0;
  GlFramebuffer drawn_, resolved_;
  GlRenderbuffer colour_, depth_, resolved_colour_;
};

/// The mirrored scene in linear light, half precision.
class MirrorTarget {
 public:
  bool fit(int width, int height);
  GLuint framebuffer() const { return framebuffer_.name(); }
  GLuint texture() const { return texture_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_ = 0, height_ = 0;
  GlFramebuffer framebuffer_;
  GlTexture texture_;
  GlRenderbuffer depth_;
};

/// Layers of depth compared on reading.
class ShadowTarget {
 public:
  bool fit(int size, int layers);
  /// Binds one layer for drawing.
  void bind(int layer) const;
  GLuint texture() const { return texture_.name(); }
  int size() const { return size_; }

 private:
  int size_ = 0, layers_ = 0;
  GlFramebuffer framebuffer_;
  GlTexture texture_;
};

}  // namespace bosquet::render
