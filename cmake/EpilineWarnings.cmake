# One place for the warnings every target of the project is built with.
add_library(epiline_warnings INTERFACE)
target_compile_options(epiline_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  -Wno-unknown-pragmas)  # `#pragma HLS` lines speak to hardware compilers only
option(EPILINE_WARNINGS_AS_ERRORS "Treat every warning as an error" ON)
if(EPILINE_WARNINGS_AS_ERRORS)
  target_compile_options(epiline_warnings INTERFACE -Werror)
endif()
