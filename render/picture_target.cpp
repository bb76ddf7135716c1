#include "render/picture_target.h"

#include <algorithm>
#include <utility>

#include "render/gl.h"

namespace bosquet::render {

PictureTarget::PictureTarget(PictureTarget&& other) noexcept { *this = std::move(other); }

PictureTarget& PictureTarget::operator=(PictureTarget&& other) noexcept {
  std::swap(framebuffer_, other.framebuffer_);
  std::swap(texture_, other.texture_);
  std::swap(size_, other.size_);
  return *this;
}

PictureTarget::~PictureTarget() {
  if (framebuffer_) glDeleteFramebuffers(1, &framebuffer_);
  if (texture_) glDeleteTextures(1, &texture_);
}

bool PictureTarget::fit(IVec2 size) {
  size = glm::max(size, IVec2(1));
  if (size == size_) return true;
  if (!framebuffer_) glGenFramebuffers(1, &framebuffer_);
  if (!texture_) glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  size_ = complete ? size : IVec2(0);
  return complete;
}

Image PictureTarget::read() const { return read_framebuffer(framebuffer_, size_); }

unsigned make_texture(const Image& image) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, kFormats[std::clamp(image.channels, 1, 4) - 1],
               GL_UNSIGNED_BYTE, image.pixels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

void delete_texture(unsigned texture) {
  const GLuint name = texture;
  if (name) glDeleteTextures(1, &name);
}

void clear_framebuffer(unsigned framebuffer, IVec2 size, const Vec3& colour) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, size.x, size.y);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(colour.r, colour.g, colour.b, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image read_framebuffer(unsigned framebuffer, IVec2 size) {
  Image image(size.x, size.y, 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  for (int y = 0; y < size.y / 2; ++y)
    std::swap_ranges(image.at(0, y), image.at(0, y) + 4 * size.x, image.at(0, size.y - 1 - y));
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

bool draws_by_software() { return drawn_by_software(); }

void finish_drawing() { glFinish(); }

}  // namespace bosquet::render
