// Recipes: any text is read, or refused with a message.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "exchange/recipe.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto recipe =
      bosquet::exchange::parse_recipe({reinterpret_cast<const char*>(data), size}, "/nonexistent/fuzz.toml");
  if (!recipe && recipe.error().message.empty()) std::abort();
  return 0;
}
