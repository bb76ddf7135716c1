# What every target of the project shares.
include(GNUInstallDirs)
add_library(bosquet_options INTERFACE)
target_compile_features(bosquet_options INTERFACE cxx_std_20)
target_include_directories(bosquet_options INTERFACE "${PROJECT_SOURCE_DIR}")
# The same bits in every build: no contraction to fused multiply-add, no fast-math, no -march.
target_compile_options(bosquet_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wpedantic
                                                 $<$<BOOL:${BOSQUET_WERROR}>:-Werror>)
if(BOSQUET_SANITIZE)
  target_compile_options(bosquet_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                   -fno-omit-frame-pointer
                         # Checks at every use of a pointer double the time to compile; the address sanitizer finds what
                         # most of them would.
                         -fno-sanitize=null,vptr,object-size,alignment
                         # g++ 12 takes the sanitizers' own checks in std::function and std::regex for this.
                         -Wno-maybe-uninitialized)
  target_link_options(bosquet_options INTERFACE -fsanitize=address,undefined)
endif()

if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ takes a source that another one includes for a header.
  target_compile_options(bosquet_options INTERFACE -Wno-subobject-linkage)
endif()

if(BOSQUET_TSAN)
  target_compile_options(bosquet_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(bosquet_options INTERFACE -fsanitize=thread)
endif()

if(BOSQUET_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    message(FATAL_ERROR "BOSQUET_FUZZ needs clang, for libFuzzer: use the preset 'fuzz'")
  endif()
  # Everything tells the fuzzer where it has been; the targets themselves bring its main().
  target_compile_options(bosquet_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined
                                                   -fno-sanitize-recover=undefined -fno-sanitize=vptr
                                                   -fno-omit-frame-pointer -Wno-unused-command-line-argument)
  target_link_options(bosquet_options INTERFACE -fsanitize=address,undefined)
endif()

find_program(BOSQUET_CCACHE ccache)
if(BOSQUET_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${BOSQUET_CCACHE}")
endif()

# bosquet_library(growth SOURCES a.cpp b.cpp PUBLIC targets... PRIVATE targets...)
# makes the static library bosquet_growth with the alias bosquet::growth, installed under the same name. PUBLIC only for
# what its headers show.
function(bosquet_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(bosquet_${name} STATIC ${arg_SOURCES})
  add_library(bosquet::${name} ALIAS bosquet_${name})
  set_target_properties(bosquet_${name} PROPERTIES EXPORT_NAME ${name})
  # Programs that link the installed library get what its headers need and nothing of our warnings.
  target_link_libraries(bosquet_${name} PUBLIC $<BUILD_INTERFACE:bosquet_options> ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  target_compile_features(bosquet_${name} PUBLIC cxx_std_20)
  target_compile_options(bosquet_${name} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  target_include_directories(bosquet_${name} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/bosquet>)
endfunction()

# bosquet_test(growth SOURCES a_test.cpp ... LINK bosquet::growth [LABELS statistical])
# makes the program growth_test; each of its tests is known to ctest, label "quick" unless LABELS says otherwise.
function(bosquet_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT arg_LABELS)
    set(arg_LABELS quick)
  endif()
  add_executable(${name}_test ${arg_SOURCES})
  target_link_libraries(${name}_test PRIVATE bosquet_options ${arg_LINK} GTest::gtest_main rapidcheck rapidcheck_gtest)
  target_compile_definitions(${name}_test PRIVATE BOSQUET_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Under the sanitizers only quick tests are run, so only those are built.
  if(BOSQUET_SANITIZE AND NOT arg_LABELS STREQUAL "quick")
    set_target_properties(${name}_test PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  include(GoogleTest)
  gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${arg_LABELS}" ENVIRONMENT "RC_PARAMS=seed=20140901"
               ENVIRONMENT_MODIFICATION "LSAN_OPTIONS=set:suppressions=${PROJECT_SOURCE_DIR}/tests/leaks.supp")
endfunction()

# bosquet_bench(growth SOURCES growth_bench.cpp LINK bosquet::growth) makes the program growth_bench.
function(bosquet_bench name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name}_bench ${arg_SOURCES})
  target_link_libraries(${name}_bench PRIVATE bosquet_options ${arg_LINK} benchmark::benchmark_main)
endfunction()
