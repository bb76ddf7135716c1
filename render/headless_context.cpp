#include "render/headless_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdio>
#include <cstring>
#include <utility>

#include "render/gl.h"

namespace bosquet::render {
namespace {

std::string egl_error_name() {
  switch (const EGLint code = eglGetError(); code) {
    case EGL_SUCCESS:
      return "no error given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    default: {
      char text[32];
      std::snprintf(text, sizeof text, "EGL error 0x%04x", static_cast<unsigned>(code));
      return text;
    }
  }
}

bool contains(const char* list, const char* name) { return list && std::strstr(list, name); }

EGLDisplay platform_display(EGLenum platform, void* native) {
  const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get ? get(platform, native, nullptr) : EGL_NO_DISPLAY;
}

struct Attempt {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string found;  ///< what went wrong, in words
};

/// A context of at least 3.3 core on this display, current; else what was found instead.
Attempt try_display(EGLDisplay display, const std::string& name) {
  Attempt attempt;
  attempt.found = name + ": ";
  if (display == EGL_NO_DISPLAY) {
    attempt.found += "no display (" + egl_error_name() + ")";
    return attempt;
  }
  EGLint major = 0, minor = 0;
  if (!eglInitialize(display, &major, &minor)) {
    attempt.found += "cannot be initialised (" + egl_error_name() + ")";
    return attempt;
  }
  const char* vendor = eglQueryString(display, EGL_VENDOR);
  attempt.found +=
      "EGL " + std::to_string(major) + "." + std::to_string(minor) + " by " + (vendor ? vendor : "unknown") + " ";
  if (!eglBindAPI(EGL_OPENGL_API)) {
    attempt.found += "offers no OpenGL (only OpenGL ES)";
    eglTerminate(display);
    return attempt;
  }
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!contains(extensions, "EGL_KHR_surfaceless_context") || !contains(extensions, "EGL_KHR_no_config_context")) {
    attempt.found += "cannot draw without a surface (EGL_KHR_surfaceless_context is missing)";
    eglTerminate(display);
    return attempt;
  }
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    GLint gl_major = 0, gl_minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &gl_major);
    glGetIntegerv(GL_MINOR_VERSION, &gl_minor);
    if (gl_major > 3 || (gl_major == 3 && gl_minor >= 3)) {
      attempt.display = display, attempt.context = context;
      return attempt;
    }
    attempt.found += "gives OpenGL " + std::to_string(gl_major) + "." + std::to_string(gl_minor);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    eglTerminate(display);
    return attempt;
  }
  const std::string problem = egl_error_name();
  attempt.found += "refuses an OpenGL 3.3 core context (" + problem + ")";
  // Say what it would give without the version asked for.
  const EGLContext any = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
  if (any != EGL_NO_CONTEXT) {
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, any)) {
      if (const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION)))
        attempt.found += std::string(", it offers OpenGL ") + version;
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, any);
  }
  eglTerminate(display);
  return attempt;
}

}  // namespace

struct HeadlessContext::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string description;

  ~State() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    // The display is shared by all contexts of the process and stays initialised.
  }
};

HeadlessContext::HeadlessContext(std::unique_ptr<State> state) : state_(std::move(state)) {}
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

Result<HeadlessContext> HeadlessContext::create() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::string tried;
  const auto keep = [&](Attempt attempt) -> std::unique_ptr<State> {
    if (attempt.context == EGL_NO_CONTEXT) {
      tried += (tried.empty() ? "" : "; ") + attempt.found;
      return nullptr;
    }
    auto state = std::make_unique<State>();
    state->display = attempt.display, state->context = attempt.context;
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    state->description = std::string(renderer ? renderer : "unknown") + ", OpenGL " + (version ? version : "unknown");
    return state;
  };

  if (contains(client, "EGL_MESA_platform_surfaceless")) {
    if (auto state = keep(
            try_display(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), "surfaceless platform")))
      return HeadlessContext(std::move(state));
  }
  if (contains(client, "EGL_EXT_platform_device") && contains(client, "EGL_EXT_device_enumeration")) {
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLDeviceEXT devices[8];
    EGLint count = 0;
    if (query && query(8, devices, &count))
      for (EGLint i = 0; i < count; ++i)
        if (auto state =
                keep(try_display(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i]), "device " + std::to_string(i))))
          return HeadlessContext(std::move(state));
  }
  if (tried.empty())
    tried = client ? "this EGL has neither the surfaceless nor the device platform" : "EGL has no driver at all";
  return cannot_finish("no OpenGL 3.3 for pictures: " + tried +
                       ". Needed is a driver such as Mesa's software one (Debian: apt-get install libegl1 libgl1 "
                       "libopengl0 libgl1-mesa-dri)");
}

bool HeadlessContext::make_current() const {
  return eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) == EGL_TRUE;
}

const std::string& HeadlessContext::description() const { return state_->description; }

}  // namespace bosquet::render
