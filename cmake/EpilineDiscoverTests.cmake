# epiline_discover_tests(TARGET [OWN_HEADERS] ...): gtest_discover_tests with enough time. A test program is asked for its
# tests when it is linked; CMake's limit of 5 s does not do for a program with sanitizers on a busy machine, and the build
# would fail. OWN_HEADERS is for programs that are compiled in another way than the rest (standard, optimisation).
include(GoogleTest)

# To read GoogleTest's headers takes longer than to compile most tests: test programs share them, precompiled once for each
# of the levels of optimisation in tests/CMakeLists.txt.
set(test_headers_source ${CMAKE_BINARY_DIR}/epiline_test_headers.cpp)
file(CONFIGURE OUTPUT ${test_headers_source} CONTENT "int main() {}\n")
foreach(optimisation -O0 -O1)
  set(test_headers epiline_test_headers${optimisation})
  add_executable(${test_headers} EXCLUDE_FROM_ALL ${test_headers_source})
  target_compile_options(${test_headers} PRIVATE $<$<CONFIG:Release>:${optimisation}>)
  target_link_libraries(${test_headers} PRIVATE GTest::gmock epiline_warnings)
  target_precompile_headers(${test_headers} PRIVATE <gmock/gmock.h>)
endforeach()

function(epiline_discover_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN_HEADERS" "" "")
  if(NOT arg_OWN_HEADERS)
    target_precompile_headers(${target} REUSE_FROM epiline_test_headers${EPILINE_TEST_OPTIMISATION})
  endif()
  gtest_discover_tests(${target} DISCOVERY_TIMEOUT 120 ${arg_UNPARSED_ARGUMENTS})
endfunction()
