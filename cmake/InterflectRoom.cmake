# interflect_room(<folder> SOURCES ... [ROOMS ...] [LIBRARIES ...] [PUBLIC_LIBRARIES ...])
#
# One folder is one library target interflect::<folder>.  ROOMS are the rooms that it may include; LIBRARIES are
# third-party targets that only its .cpp files see.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(INTERFLECT_CCACHE ccache)
if(INTERFLECT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What headers that are parsed once (InterflectPrecompile) need, of its manual's chapter on them, beside what the user
  # has in the environment or in ccache's configuration.
  execute_process(COMMAND ${INTERFLECT_CCACHE} -k sloppiness
    OUTPUT_VARIABLE sloppiness OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REGEX MATCHALL "[a-z_]+" sloppiness "${sloppiness}")
  list(APPEND sloppiness pch_defines time_macros)
  list(REMOVE_DUPLICATES sloppiness)
  list(JOIN sloppiness "," sloppiness)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=${sloppiness} ${INTERFLECT_CCACHE})
endif()

add_library(interflect_options INTERFACE)
add_library(interflect::options ALIAS interflect_options)
target_compile_options(interflect_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wformat=2
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms of GCC 12 on sums of strings (its bug 105651)
  # a*b - c*d must vanish when both products are equal: geometry is written on that.  Kernels opt in to contraction.
  -ffp-contract=off
  $<$<BOOL:${INTERFLECT_WERROR}>:-Werror>)
if(INTERFLECT_ARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(interflect_options INTERFACE -march=${INTERFLECT_ARCH})
  # Spectra are copied by one register: by two halves, as GCC does when it is not told, the next load of the whole waits
  # for both stores (a tenth of the path tracer's time).
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" INTERFLECT_HAS_WIDE_MOVES)
  if(INTERFLECT_HAS_WIDE_MOVES AND NOT INTERFLECT_ARCH MATCHES "^x86-64(-v2)?$")
    target_compile_options(interflect_options INTERFACE -mmove-max=256 -mstore-max=256)
  endif()
endif()
if(INTERFLECT_SANITIZE)
  target_compile_options(interflect_options INTERFACE -fsanitize=${INTERFLECT_SANITIZE} -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # instrumented code hides from GCC 12 what was initialised
  target_link_options(interflect_options INTERFACE -fsanitize=${INTERFLECT_SANITIZE})
endif()

include(InterflectPrecompile)

function(interflect_room room)
  cmake_parse_arguments(ARG "" "" "SOURCES;ROOMS;LIBRARIES;PUBLIC_LIBRARIES" ${ARGN})
  add_library(interflect_${room} ${ARG_SOURCES})
  add_library(interflect::${room} ALIAS interflect_${room})
  set_target_properties(interflect_${room} PROPERTIES EXPORT_NAME ${room})
  target_include_directories(interflect_${room} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/interflect>)
  target_compile_features(interflect_${room} PUBLIC cxx_std_20)
  list(TRANSFORM ARG_ROOMS PREPEND interflect::)
  target_link_libraries(interflect_${room}
    PUBLIC ${ARG_ROOMS} ${ARG_PUBLIC_LIBRARIES}
    PRIVATE $<BUILD_INTERFACE:interflect::options> ${ARG_LIBRARIES})
  interflect_precompile(interflect_${room})
  set_property(GLOBAL APPEND PROPERTY INTERFLECT_ROOMS ${room})
endfunction()

# interflect_wide_source(<folder> <source> <definition> [<option> ...]): a file that is compiled for processors with vectors
# of 64 bytes, which the room asks for at run time (core/wide_vectors.h) where <definition> says that the file is there.
# Always optimised, so that no inline function of it is left for others to call.
function(interflect_wide_source room source definition)
  if(NOT (INTERFLECT_ARCH STREQUAL "x86-64-v3" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64"))
    return()
  endif()
  target_sources(interflect_${room} PRIVATE ${source})
  target_compile_definitions(interflect_${room} PRIVATE ${definition})
  set_source_files_properties(${source} PROPERTIES
    COMPILE_OPTIONS "-march=x86-64-v4;-mprefer-vector-width=512;-O3;${ARGN}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()
