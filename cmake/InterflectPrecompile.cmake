# interflect_precompile(<target> [TESTS]): the headers that nearly every file includes, parsed once for all targets,
# which nearly halves what a file takes; of programs with gtest too (TESTS).
#
# A file names all that it needs all the same: the presets that do without (dev, tsan, tidy) would tell.  gcc alone
# takes such headers where a file is compiled with more macros than they were, as every room has of its own.

option(INTERFLECT_PRECOMPILE "Parse common headers once (gcc)" OFF)

set(precompiled_headers <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <atomic> <chrono> <cmath> <cstdint>
  <functional> <limits> <memory> <mutex> <optional> <span> <string> <variant> <vector>)

# What is compiled like the files that take its headers: an object library, or a program where those are.
function(interflect_precompiled name kind)
  if(TARGET ${name})
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/headers.cpp CONTENT "int main() {}\n")
  if(kind STREQUAL "EXECUTABLE")
    add_executable(${name} ${PROJECT_BINARY_DIR}/generated/headers.cpp)
  else()
    add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/headers.cpp)
  endif()
  target_link_libraries(${name} PRIVATE interflect::core interflect::options ${ARG_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${precompiled_headers} ${ARG_HEADERS})
endfunction()

function(interflect_precompile target)
  cmake_parse_arguments(ARG "TESTS" "" "" ${ARGN})
  if(NOT INTERFLECT_PRECOMPILE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  # core is what the headers themselves are compiled like; CGAL rounds as it wants; OpenEXR brings -pthread.
  get_target_property(libraries ${target} LINK_LIBRARIES)
  if(target STREQUAL "interflect_core" OR "CGAL::CGAL" IN_LIST libraries OR "PkgConfig::OpenEXR" IN_LIST libraries)
    return()
  endif()
  # gcc 12's false alarms on sums of strings (its bug 105651), which it keeps to itself where a header is the system's;
  # the presets that do without have these warnings.  -fpch-preprocess is for ccache.
  target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-array-bounds -fpch-preprocess)
  get_target_property(type ${target} TYPE)
  if(ARG_TESTS)
    interflect_precompiled(interflect_test_headers EXECUTABLE HEADERS <gtest/gtest.h> LIBRARIES GTest::gtest)
    target_precompile_headers(${target} REUSE_FROM interflect_test_headers)
  elseif(type STREQUAL "EXECUTABLE")
    target_precompile_headers(${target} PRIVATE ${precompiled_headers})
  else()
    interflect_precompiled(interflect_headers OBJECT)
    target_precompile_headers(${target} REUSE_FROM interflect_headers)
  endif()
endfunction()
