# epiline_discover_tests(TARGET [OWN_HEADERS] ...): gtest_discover_tests with enough time. A test program is asked for its
# tests when it is linked; CMake's limit of 5 s does not do for a program with sanitizers on a busy machine, and the build
# would fail. OWN_HEADERS is for programs that are compiled in another way than the rest (standard, optimisation).
include(EpilineSharedHeaders)
include(GoogleTest)

# GoogleTest's headers, for each of the levels of optimisation in tests/CMakeLists.txt.
foreach(optimisation -O0 -O1)
  epiline_shared_headers(epiline_test_headers${optimisation} PROGRAM LIBRARIES GTest::gmock HEADERS <gmock/gmock.h>)
  target_compile_options(epiline_test_headers${optimisation} PRIVATE $<$<CONFIG:Release>:${optimisation}>)
endforeach()

function(epiline_discover_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN_HEADERS" "" "")
  if(NOT arg_OWN_HEADERS)
    target_precompile_headers(${target} REUSE_FROM epiline_test_headers${EPILINE_TEST_OPTIMISATION})
  endif()
  gtest_discover_tests(${target} DISCOVERY_TIMEOUT 120 ${arg_UNPARSED_ARGUMENTS})
endfunction()
