// The JSON texts of a project: the first byte chooses the section.
#include <cstdint>
#include <string>

#include "scene/project_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  if (size == 0) return 0;
  scene::Document document;
  scene::TextReader reader{document, {}, {}, {}};
  const char* section = scene::kTextSections[data[0] % std::size(scene::kTextSections)];
  reader.read(section, {{"fuzz", std::string(reinterpret_cast<const char*>(data) + 1, size - 1)}});
  return 0;
}
