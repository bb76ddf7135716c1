// Saved trees and tables of exact trees: JSON that begins with a brace, else CSV.
#include <cstdint>
#include <cstdlib>

#include "exchange/recipe_write.h"
#include "exchange/tree_file.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  if (size == 0) return 0;
  if (data[0] == '{') {
    static fuzz::TemporaryFile file(".tree.json");
    const auto tree = exchange::read_tree(file.put(data, size));
    if (!tree && tree.error().message.empty()) std::abort();
    return 0;
  }
  static fuzz::TemporaryFile file(".csv");
  static const std::vector<std::shared_ptr<const scene::Species>> species{
      std::make_shared<const scene::Species>(*scene::builtin_species("english_oak"))};
  const auto trees = exchange::read_exact_trees(file.put(data, size), species);
  if (!trees && trees.error().message.empty()) std::abort();
  return 0;
}
