# interflect_test(<name> LABEL <label> SOURCES ... [ROOMS ...] [LIBRARIES ...] [TIMEOUT seconds] [DRAWS])
#
# One executable, each of its TESTs a ctest case under LABEL (unit, property, convergence, statistical, smoke, corpus,
# long). DRAWS: through OpenGL, whose drivers keep a few bytes a context for good, and are unloaded before a sanitizer
# could name them: leaks are not looked for there.

find_package(GTest REQUIRED)
include(GoogleTest)

function(interflect_test name)
  cmake_parse_arguments(ARG "DRAWS" "LABEL;TIMEOUT" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(INTERFLECT_SANITIZE)
    math(EXPR ARG_TIMEOUT "8 * ${ARG_TIMEOUT}")  # statistics slow down twenty times
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  list(TRANSFORM ARG_ROOMS PREPEND interflect::)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(test_${name} PRIVATE ${ARG_ROOMS} ${ARG_LIBRARIES} GTest::gtest_main interflect::options)
  target_compile_definitions(test_${name} PRIVATE INTERFLECT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  interflect_precompile(test_${name} TESTS)
  set(environment)
  if(ARG_DRAWS AND INTERFLECT_SANITIZE MATCHES address)
    set(environment ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  elseif(INTERFLECT_SANITIZE MATCHES thread)
    # Too much memory is refused in one line: an allocation that fails is for the program to tell.
    set(environment ENVIRONMENT
      TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/thread_sanitizer.supp:allocator_may_return_null=1)
  endif()
  gtest_discover_tests(test_${name} DISCOVERY_MODE PRE_TEST TEST_PREFIX ${name}/
    PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} ${environment})
endfunction()
