# cmake --install, in two components.
include(CMakePackageConfigHelpers)

# program: the command and window in one file that holds all it needs, with licence, documentation and examples.
install(TARGETS bosquet COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(DIRECTORY docs examples DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

# library: static libraries, one a folder, their headers, and what find_package(bosquet) reads. Headers that show
# somebody else's (JSON, OpenGL) are for the sources of their folder alone and stay here.
set(folders core terrain distribution crowns growth geometry scene exchange render)
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/bosquet")
foreach(folder ${folders})
  install(TARGETS bosquet_${folder} EXPORT bosquetTargets COMPONENT library)
endforeach()
install(DIRECTORY ${folders} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/bosquet" COMPONENT library
        FILES_MATCHING PATTERN "*.h"
        PATTERN "species" EXCLUDE
        PATTERN "project_json.h" EXCLUDE PATTERN "gltf_json.h" EXCLUDE
        PATTERN "gl.h" EXCLUDE PATTERN "gpu_*.h" EXCLUDE PATTERN "render_target.h" EXCLUDE
        PATTERN "renderer_state.h" EXCLUDE PATTERN "shader*.h" EXCLUDE)
install(EXPORT bosquetTargets NAMESPACE bosquet:: DESTINATION "${package}" COMPONENT library)
configure_package_config_file(cmake/bosquetConfig.cmake.in "${PROJECT_BINARY_DIR}/bosquetConfig.cmake"
                              INSTALL_DESTINATION "${package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/bosquetConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/bosquetConfig.cmake" "${PROJECT_BINARY_DIR}/bosquetConfigVersion.cmake"
        DESTINATION "${package}" COMPONENT library)
