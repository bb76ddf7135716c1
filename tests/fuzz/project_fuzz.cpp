// Project files: any bytes are opened, or refused with a message; what was read can be saved.
#include <cstdint>
#include <cstdlib>

#include "scene/project_file.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  static fuzz::TemporaryFile file(".bosquet");
  const auto read = scene::read_project(file.put(data, size));
  if (!read && read.error().message.empty()) std::abort();
  if (read && (!read->document.terrain || !read->document.trees)) std::abort();
  return 0;
}
