// Headless context: OpenGL without a window or a display, for pictures on a server and in tests.
//
// Way       EGL with Mesa's surfaceless platform, else the first EGL device; core profile 3.3 or newer; there is no
//           default framebuffer, the renderer draws into its own
// Errors    create() says what was tried and what was found (EGL version, vendor, OpenGL version), kind cannot_finish
// Threads   a context is current on one thread at a time; create() makes it current on the calling one
// Cost      25-50 ms with Mesa's llvmpipe, half a second the first time on a machine
#pragma once

#include <memory>
#include <string>

#include "core/result.h"

namespace bosquet::render {

class HeadlessContext {
 public:
  /// A context of at least OpenGL 3.3 core, current on this thread.
  static Result<HeadlessContext> create();

  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;
  ~HeadlessContext();

  /// Makes the context current on the calling thread (again); false when the driver refuses.
  bool make_current() const;

  /// What draws, for reports: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5".
  const std::string& description() const;

 private:
  struct State;
  explicit HeadlessContext(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace bosquet::render
