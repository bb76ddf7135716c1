// Meshes of others: any bytes as glTF (binary, or JSON that begins with a brace) or OBJ; read, judged and told about.
#include <cstdint>
#include <cstdlib>

#include "exchange/gltf_check.h"
#include "exchange/mesh_file.h"
#include "temporary_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bosquet;
  static fuzz::TemporaryFile binary(".glb"), text(".gltf"), obj(".obj");
  const bool glb = size >= 4 && data[0] == 'g' && data[1] == 'l';
  const bool gltf = size > 0 && data[0] == '{';
  const std::filesystem::path& path = (glb ? binary : gltf ? text : obj).put(data, size);
  const auto mesh = exchange::read_mesh(path);
  if (!mesh && mesh.error().message.empty()) std::abort();
  if (mesh)
    for (const std::uint32_t i : mesh->indices)
      if (i >= mesh->positions.size()) std::abort();
  if (glb || gltf) {
    const auto check = exchange::check_gltf(path);
    if (!check && check.error().message.empty()) std::abort();
  }
  return 0;
}
