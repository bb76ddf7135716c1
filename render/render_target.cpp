#include "render/render_target.h"

namespace bosquet::render {
namespace {

bool complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

void clear_errors() {
  while (glGetError() != GL_NO_ERROR) {
  }
}

GlRenderbuffer make_store(GLenum format, int width, int height, int samples) {
  GlRenderbuffer store = GlRenderbuffer::make();
  glBindRenderbuffer(GL_RENDERBUFFER, store.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
  return store;
}

}  // namespace

bool TileTarget::fit(int width, int height, int samples) {
  if (width_ >= width && height_ >= height && samples_ == samples) return true;
  clear_errors();
  width_ = height_ = 0;
  // The old stores go first: there may not be memory for both.
  colour_.reset(), depth_.reset(), resolved_colour_.reset();
  const bool multisampled = samples > 1;
  resolved_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  resolved_colour_ = make_store(GL_SRGB8_ALPHA8, width, height, 1);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_colour_.name());
  if (!complete()) return false;
  if (multisampled) {
    drawn_ = GlFramebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    colour_ = make_store(GL_SRGB8_ALPHA8, width, height, samples);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
  }
  depth_ = make_store(GL_DEPTH_COMPONENT24, width, height, samples);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
  if (!complete() || glGetError() != GL_NO_ERROR) return false;
  width_ = width, height_ = height, samples_ = samples;
  return true;
}

void TileTarget::resolve(int w, int h) const {
  if (samples_ > 1) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glEnable(GL_FRAMEBUFFER_SRGB);
    glBlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
}

bool MirrorTarget::fit(int width, int height) {
  if (width_ == width && height_ == height) return true;
  clear_errors();
  width_ = height_ = 0;
  framebuffer_ = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  texture_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_HALF_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  depth_ = make_store(GL_DEPTH_COMPONENT24, width, height, 1);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
  if (!complete() || glGetError() != GL_NO_ERROR) return false;
  width_ = width, height_ = height;
  return true;
}

bool ShadowTarget::fit(int size, int layers) {
  if (size_ == size && layers_ == layers) return true;
  clear_errors();
  size_ = layers_ = 0;
  texture_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture_.name());
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, size, size, layers, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  framebuffer_ = GlFramebuffer::make();
  bind(0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  if (!complete() || glGetError() != GL_NO_ERROR) return false;
  size_ = size, layers_ = layers;
  return true;
}

void ShadowTarget::bind(int layer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.name(), 0, layer);
}

}  // namespace bosquet::render
