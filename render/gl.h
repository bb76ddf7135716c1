// OpenGL for the sources of render/ alone: entry points by GLVND (no loader) and owners of GL objects.
//
// Owners are movable, freed with their last owner and need the context current when freed.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <cstring>
#include <utility>

namespace bosquet::render {

/// Whether the current context draws on the CPU, where other things are cheap than on a graphics card.
inline bool drawn_by_software() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name && (std::strstr(name, "llvmpipe") || std::strstr(name, "softpipe"));
}

template <void (*Create)(GLsizei, GLuint*), void (*Delete)(GLsizei, const GLuint*)>
class GlObject {
 public:
  GlObject() = default;
  GlObject(GlObject&& o) noexcept : name_(std::exchange(o.name_, 0)) {}
  GlObject& operator=(GlObject&& o) noexcept {
    std::swap(name_, o.name_);
    return *this;
  }
  ~GlObject() { reset(); }

  static GlObject make() {
    GlObject object;
    Create(1, &object.name_);
    return object;
  }
  void reset() {
    if (name_) Delete(1, &name_);
    name_ = 0;
  }
  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

namespace gl_calls {
inline void make_textures(GLsizei n, GLuint* out) { glGenTextures(n, out); }
inline void free_textures(GLsizei n, const GLuint* in) { glDeleteTextures(n, in); }
inline void make_buffers(GLsizei n, GLuint* out) { glGenBuffers(n, out); }
inline void free_buffers(GLsizei n, const GLuint* in) { glDeleteBuffers(n, in); }
inline void make_arrays(GLsizei n, GLuint* out) { glGenVertexArrays(n, out); }
inline void free_arrays(GLsizei n, const GLuint* in) { glDeleteVertexArrays(n, in); }
inline void make_targets(GLsizei n, GLuint* out) { glGenFramebuffers(n, out); }
inline void free_targets(GLsizei n, const GLuint* in) { glDeleteFramebuffers(n, in); }
inline void make_stores(GLsizei n, GLuint* out) { glGenRenderbuffers(n, out); }
inline void free_stores(GLsizei n, const GLuint* in) { glDeleteRenderbuffers(n, in); }
}  // namespace gl_calls

using GlTexture = GlObject<gl_calls::make_textures, gl_calls::free_textures>;
using GlBuffer = GlObject<gl_calls::make_buffers, gl_calls::free_buffers>;
using GlVertexArray = GlObject<gl_calls::make_arrays, gl_calls::free_arrays>;
using GlFramebuffer = GlObject<gl_calls::make_targets, gl_calls::free_targets>;
using GlRenderbuffer = GlObject<gl_calls::make_stores, gl_calls::free_stores>;

}  // namespace bosquet::render
