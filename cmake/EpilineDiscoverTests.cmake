# epiline_discover_tests(TARGET ...): gtest_discover_tests with enough time. A test program is asked for its tests when it is
# linked; CMake's limit of 5 s does not do for a program with sanitizers on a busy machine, and the build would fail.
include(GoogleTest)

function(epiline_discover_tests target)
  gtest_discover_tests(${target} DISCOVERY_TIMEOUT 120 ${ARGN})
endfunction()
