#include "render/headless_context.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "render/renderer.h"

namespace bosquet::render {
namespace {

TEST(HeadlessContext, ComesWithoutADisplayAndSaysWhatDraws) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Result<HeadlessContext> context = HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().message;
  EXPECT_NE(context->description().find("OpenGL"), std::string::npos);
  EXPECT_TRUE(context->make_current());
}

TEST(HeadlessContext, SeveralLiveSideBySide) {
  Result<HeadlessContext> first = HeadlessContext::create();
  ASSERT_TRUE(first) << first.error().message;
  {
    const Result<HeadlessContext> second = HeadlessContext::create();
    ASSERT_TRUE(second) << second.error().message;
  }
  EXPECT_TRUE(first->make_current());
  EXPECT_TRUE(Renderer::create());
}

/// Ends the process with 0 when create() fails and its message has both parts.
[[noreturn]] void expect_failure(const char* variable, const char* value, const std::string& part) {
  setenv(variable, value, 1);
  const Result<HeadlessContext> context = HeadlessContext::create();
  if (context) std::_Exit(1);
  std::fprintf(stderr, "%s\n", context.error().message.c_str());
  const bool good = context.error().kind == ErrorKind::cannot_finish &&
                    context.error().message.find(part) != std::string::npos &&
                    context.error().message.find("apt-get install") != std::string::npos;
  std::_Exit(good ? 0 : 1);
}

// The drivers read their environment once, so each case is a process of its own.
TEST(HeadlessContextDeathTest, WithoutAnyDriverTheErrorSaysSoAndWhatToInstall) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(expect_failure("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", "neither the surfaceless nor"),
              testing::ExitedWithCode(0), "OpenGL 3.3");
}

TEST(HeadlessContextDeathTest, AnOlderOpenGlIsNamedInTheError) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(expect_failure("MESA_GL_VERSION_OVERRIDE", "2.1", "2.1"), testing::ExitedWithCode(0), "OpenGL 3.3");
}

}  // namespace
}  // namespace bosquet::render
