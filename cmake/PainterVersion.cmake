# Writes OUTPUT, the source of painter_version(): a hash over all files that painted textures depend on.
file(GLOB files "${SOURCE_DIR}/core/*.h" "${SOURCE_DIR}/core/*.cpp" "${SOURCE_DIR}/geometry/*.h"
     "${SOURCE_DIR}/geometry/*.cpp" "${SOURCE_DIR}/scene/materials.cpp")
list(SORT files)
set(hashes "")
foreach(path ${files})
  file(SHA256 "${path}" hash)
  string(APPEND hashes "${hash}")
endforeach()
string(SHA256 all "${hashes}")
string(SUBSTRING "${all}" 0 16 version)
file(WRITE "${OUTPUT}" "#include \"scene/painting_cache.h\"

namespace bosquet::scene {

std::uint64_t painter_version() { return 0x${version}u; }

}  // namespace bosquet::scene
")
