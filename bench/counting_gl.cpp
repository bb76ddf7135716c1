// An OpenGL that draws nothing and counts what it is asked for, to be loaded before the real one:
//
//   LD_PRELOAD=build/release/bench/libcounting_gl.so bosquet ui FILE --script FILE --report FILE.json
//
// What a frame takes then is the window's own work: tools, culling, panels, uploads up to the driver's door. Windows and
// contexts are still the real ones.
//
// Decision  every call goes the way it always goes: names the program links are found here first, and those asked of
//           glXGetProcAddress are answered from here
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace {

unsigned long calls = 0, drawn = 0, uploaded_bytes = 0;
std::array<char, 1 << 16> scratch;

struct Tell {
  ~Tell() { std::fprintf(stderr, "gl: %lu calls, %lu draws, %lu bytes uploaded\n", calls, drawn, uploaded_bytes); }
} tell;

void fill(int n, unsigned* names) {
  static unsigned last = 0;
  ++calls;
  for (int i = 0; i < n; ++i) names[i] = ++last;
}

}  // namespace

extern "C" {

#define NOTHING(name) \
  void name() { ++calls; }
#define DRAW(name) \
  void name() { ++calls, ++drawn; }
#define GIVES(name, value) \
  int name() {             \
    ++calls;               \
    return value;          \
  }
#define NAMES(name) \
  void name(int n, unsigned* names) { fill(n, names); }

NOTHING(glActiveTexture)
NOTHING(glAttachShader)
NOTHING(glBindBuffer)
NOTHING(glBindBufferBase)
NOTHING(glBindFramebuffer)
NOTHING(glBindRenderbuffer)
NOTHING(glBindSampler)
NOTHING(glBindTexture)
NOTHING(glBindVertexArray)
NOTHING(glBlendEquation)
NOTHING(glBlendEquationSeparate)
NOTHING(glBlendFuncSeparate)
NOTHING(glBlitFramebuffer)
NOTHING(glClear)
NOTHING(glClearColor)
NOTHING(glColorMask)
NOTHING(glCompileShader)
NOTHING(glDeleteBuffers)
NOTHING(glDeleteFramebuffers)
NOTHING(glDeleteProgram)
NOTHING(glDeleteRenderbuffers)
NOTHING(glDeleteShader)
NOTHING(glDeleteTextures)
NOTHING(glDeleteVertexArrays)
NOTHING(glDepthFunc)
NOTHING(glDepthMask)
NOTHING(glDetachShader)
NOTHING(glDisable)
DRAW(glDrawArrays)
NOTHING(glDrawBuffer)
DRAW(glDrawElements)
DRAW(glDrawElementsBaseVertex)
DRAW(glDrawElementsInstanced)
NOTHING(glEnable)
NOTHING(glEnableVertexAttribArray)
NOTHING(glFinish)
NOTHING(glFlush)
NOTHING(glFramebufferRenderbuffer)
NOTHING(glFramebufferTexture2D)
NOTHING(glFramebufferTextureLayer)
NOTHING(glFrontFace)
NOTHING(glGenerateMipmap)
NOTHING(glGetProgramInfoLog)
NOTHING(glGetShaderInfoLog)
NOTHING(glLinkProgram)
NOTHING(glPixelStorei)
NOTHING(glPolygonMode)
NOTHING(glPolygonOffset)
NOTHING(glReadBuffer)
NOTHING(glReadPixels)
NOTHING(glRenderbufferStorageMultisample)
NOTHING(glScissor)
NOTHING(glShaderSource)
NOTHING(glTexImage2D)
NOTHING(glTexImage3D)
NOTHING(glTexParameterf)
NOTHING(glTexParameteri)
NOTHING(glUniform1i)
NOTHING(glUniform2f)
NOTHING(glUniform3fv)
NOTHING(glUniform4f)
NOTHING(glUniform4fv)
NOTHING(glUniformBlockBinding)
NOTHING(glUniformMatrix4fv)
NOTHING(glUseProgram)
NOTHING(glVertexAttribDivisor)
NOTHING(glVertexAttribPointer)
NOTHING(glViewport)
GIVES(glCheckFramebufferStatus, 0x8CD5)  // complete
GIVES(glCreateProgram, 1)
GIVES(glCreateShader, 1)
GIVES(glGetAttribLocation, 0)
GIVES(glGetError, 0)
GIVES(glGetUniformBlockIndex, 0)
GIVES(glGetUniformLocation, 0)
GIVES(glIsEnabled, 0)
NAMES(glGenBuffers)
NAMES(glGenFramebuffers)
NAMES(glGenRenderbuffers)
NAMES(glGenTextures)
NAMES(glGenVertexArrays)

// A driver copies what it is given before it returns; so does this one, in pieces.
static void take(long bytes, const void* data) {
  ++calls;
  uploaded_bytes += static_cast<unsigned long>(bytes);
  const char* from = static_cast<const char*>(data);
  for (long at = 0; from && at < bytes; at += static_cast<long>(scratch.size()))
    std::memcpy(
        scratch.data(), from + at,
        static_cast<std::size_t>(bytes - at) < scratch.size() ? static_cast<std::size_t>(bytes - at) : scratch.size());
}
void glBufferData(unsigned, long bytes, const void* data, unsigned) { take(bytes, data); }
void glBufferSubData(unsigned, long, long bytes, const void* data) { take(bytes, data); }

void glGetShaderiv(unsigned, unsigned what, int* value) { ++calls, *value = what == 0x8B81; }   // compiled
void glGetProgramiv(unsigned, unsigned what, int* value) { ++calls, *value = what == 0x8B82; }  // linked
void glGetIntegerv(unsigned what, int* value) {
  ++calls;
  // Version 3.3, core, no extensions, 4 samples, and room for everything.
  *value = what == 0x821B || what == 0x821C   ? 3
           : what == 0x821D || what == 0x821E ? 0
           : what == 0x9126                   ? 1
           : what == 0x8D57                   ? 4
                                              : 16384;
  if (what == 0x0D3A) value[1] = 16384;  // the largest viewport
  if (what == 0x0BA2 || what == 0x0C10 || what == 0x0B40) value[0] = value[1] = 0;  // boxes and pairs
  if (what == 0x0BA2 || what == 0x0C10) value[2] = value[3] = 0;
}
const unsigned char* glGetString(unsigned) {
  ++calls;
  return reinterpret_cast<const unsigned char*>("3.3 counting");
}
const unsigned char* glGetStringi(unsigned, unsigned) {
  ++calls;
  return reinterpret_cast<const unsigned char*>("");
}

using Function = void (*)();
Function glXGetProcAddressARB(const unsigned char* name) {
  const char* text = reinterpret_cast<const char*>(name);
  if (std::strncmp(text, "gl", 2) == 0 && std::strncmp(text, "glX", 3) != 0)
    if (void* here = dlsym(RTLD_DEFAULT, text)) return reinterpret_cast<Function>(here);
  static const auto real =
      reinterpret_cast<Function (*)(const unsigned char*)>(dlsym(RTLD_NEXT, "glXGetProcAddressARB"));
  return real ? real(name) : nullptr;
}
Function glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }

// Who opens the library of OpenGL by its name gets the names as the program has them, these first.
void* dlopen(const char* file, int flags) {
  static const auto real = reinterpret_cast<void* (*)(const char*, int)>(dlsym(RTLD_NEXT, "dlopen"));
  if (file && std::strncmp(file, "libGL.so", 8) == 0) {
    if (!real(file, RTLD_NOW | RTLD_GLOBAL)) return nullptr;
    return real(nullptr, RTLD_NOW);
  }
  return real(file, flags);
}

}  // extern "C"
