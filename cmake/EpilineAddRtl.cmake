# From a C++ top to a linkable simulation model of its Verilog, at build time.
#
# epiline_add_rtl(TARGET TOP top SOURCE file.cpp [CLOCK 6ns] [TARGET ecp5] [DEFINES NAME=VALUE..] [INCLUDES folder..]
#                 [OPTIONS option..] [AXI_LITE])
#   Runs epiline-hls into <binary dir>/TARGET.rtl (top.v, top.graph, report.json, report.txt), then does what
#   epiline_add_verilog_model does. The folder is TARGET's property EPILINE_RTL_FOLDER. INCLUDES come beside hls/types, which
#   epiline-hls knows. OPTIONS are passed to epiline-hls as they are. AXI_LITE puts the top's scalar arguments into
#   registers; the folder then holds top_registers.h, top_registers.json and top_registers.md, too.
#
# epiline_add_verilog_model(TARGET TOP module VERILOG file.v.. REPORT report.json [DEPENDS ..] [NO_LINT])
#   Runs Verilator and compiles the model. TARGET is a static library; "TARGET_model.hpp" declares
#   epiline::cosim::make_TARGET_model(seed). REPORT's key "interface" names the ports. Verilator's warnings are errors, unless NO_LINT.
#
# epiline_verilate(TARGET TOP module VERILOG file.v.. [DEPENDS ..] [OPTIONS ..] [NO_LINT])
#   The first half of the above: the command that makes <binary dir>/TARGET.model/VTARGET__ALL.a and VTARGET.h.
#
# epiline_add_netlist_model(TARGET TOP module VERILOG file.v REPORT report.json [TARGET ecp5|hx8k] [DEPENDS ..])
#   Synthesizes the Verilog for ECP5 or iCE40 with scripts/synthesize.sh into <binary dir>/TARGET.netlist and makes a model of
#   the netlist, like epiline_add_verilog_model. The folder is TARGET's property EPILINE_NETLIST_FOLDER.
#
# epiline_add_netlist_library(TARGET RTL rtl_target [TARGET ecp5|hx8k])
#   The netlist of what epiline_add_rtl compiled, as shared library TARGET_library with the C function epiline_make_model,
#   for programs that load it when they need it. Not part of the default build: a large netlist takes minutes.
#
# The targets are built when something that is built links them.

find_program(EPILINE_VERILATOR verilator REQUIRED DOC "Verilator (Debian package verilator)")
find_program(EPILINE_MAKE NAMES make gmake REQUIRED DOC "GNU make, which builds Verilator's output (Debian package make)")
find_program(EPILINE_PYTHON NAMES python3 REQUIRED DOC "Python 3 (Debian package python3)")
execute_process(COMMAND ${EPILINE_VERILATOR} --getenv VERILATOR_ROOT
                OUTPUT_VARIABLE EPILINE_VERILATOR_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# -march=native is worth a third of the speed; the models run on the machine that built them.
set(EPILINE_MODEL_FLAGS "-O2 -march=native" CACHE STRING "Compiler flags of the simulation models")

# The run-time library of every Verilator model, once.
if(NOT TARGET epiline_verilated)
  add_library(epiline_verilated STATIC
    ${EPILINE_VERILATOR_ROOT}/include/verilated.cpp
    ${EPILINE_VERILATOR_ROOT}/include/verilated_threads.cpp)
  target_include_directories(epiline_verilated SYSTEM PUBLIC
    ${EPILINE_VERILATOR_ROOT}/include ${EPILINE_VERILATOR_ROOT}/include/vltstd)
  target_compile_options(epiline_verilated PRIVATE -w)
  target_link_libraries(epiline_verilated PUBLIC Threads::Threads)
endif()

# Ends with one clear error when a function's parsed arguments (arg_*) are incomplete or more than it knows. To be called
# from a function of this file, with the names of the arguments it cannot do without.
macro(epiline_check_arguments)
  foreach(epiline_required ${ARGN})
    if(NOT arg_${epiline_required})
      message(FATAL_ERROR "${CMAKE_CURRENT_FUNCTION}(${target}): ${epiline_required} is missing")
    endif()
  endforeach()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "${CMAKE_CURRENT_FUNCTION}(${target}): no value after ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${CMAKE_CURRENT_FUNCTION}(${target}): unknown argument ${arg_UNPARSED_ARGUMENTS}")
  endif()
endmacro()

function(epiline_verilate target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_LINT" "TOP" "VERILOG;DEPENDS;OPTIONS")
  epiline_check_arguments(TOP VERILOG)

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.model)
  set(lint)
  if(arg_NO_LINT)
    set(lint -Wno-fatal -Wno-lint)
  endif()
  set(archive ${folder}/V${target}__ALL.a)
  # Verilator's own makefile compiles the model: the number of files it splits the model into is known only when it ran.
  # Few files: each of them reads the whole model's header, which takes longer than to compile its functions.
  add_custom_command(
    OUTPUT ${archive}
    BYPRODUCTS ${folder}/V${target}.h
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND ${EPILINE_VERILATOR} --cc --quiet-exit --no-timing -O3 --x-assign fast --x-initial unique --noassert
            --output-split 200000 --output-split-cfuncs 500 -Wno-UNOPTFLAT ${lint} ${arg_OPTIONS}
            --top-module ${arg_TOP} --prefix V${target} --Mdir ${folder} ${arg_VERILOG}
    COMMAND ${EPILINE_MAKE} --silent -C ${folder} -f V${target}.mk -j2 V${target}__ALL.a
            CXX=${CMAKE_CXX_COMPILER} AR=${CMAKE_AR} VM_PARALLEL_BUILDS=1 CFG_CXXFLAGS_STD=-std=c++20
            "OPT_FAST=${EPILINE_MODEL_FLAGS}" OPT_SLOW=-O1 "USER_CPPFLAGS=-w -fPIC"
    DEPENDS ${arg_VERILOG} ${arg_DEPENDS}
    COMMENT "Verilating ${target}"
    VERBATIM)
endfunction()

function(epiline_add_verilog_model target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_LINT" "TOP;REPORT" "VERILOG;DEPENDS")
  epiline_check_arguments(TOP REPORT VERILOG)

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.model)
  set(archive ${folder}/V${target}__ALL.a)
  set(make_model ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../tb/cosim/make_model.py)
  set(more)
  if(arg_NO_LINT)
    list(APPEND more NO_LINT)
  endif()
  if(arg_DEPENDS)
    list(APPEND more DEPENDS ${arg_DEPENDS})
  endif()
  epiline_verilate(${target} TOP ${arg_TOP} VERILOG ${arg_VERILOG} ${more})
  add_custom_command(
    OUTPUT ${folder}.binding/${target}_model.cpp ${folder}.binding/${target}_model.hpp
    COMMAND ${EPILINE_PYTHON} ${make_model} ${arg_REPORT} ${target} ${folder}.binding
    DEPENDS ${make_model} ${arg_REPORT} ${arg_DEPENDS}
    COMMENT "Binding ${target}"
    VERBATIM)
  set_source_files_properties(${folder}.binding/${target}_model.cpp PROPERTIES OBJECT_DEPENDS ${archive})

  add_custom_target(${target}_verilated DEPENDS ${archive} ${folder}.binding/${target}_model.hpp)
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${folder}.binding/${target}_model.cpp)
  add_dependencies(${target} ${target}_verilated)
  target_include_directories(${target} PUBLIC ${folder}.binding PRIVATE ${folder})
  target_link_libraries(${target} PUBLIC epiline_tb_includes ${archive} epiline_verilated)
endfunction()

function(epiline_add_rtl target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "AXI_LITE" "TOP;SOURCE;CLOCK;TARGET" "DEFINES;INCLUDES;OPTIONS")
  epiline_check_arguments(TOP SOURCE)
  if(NOT arg_CLOCK)
    set(arg_CLOCK 6ns)
  endif()
  if(NOT arg_TARGET)
    set(arg_TARGET ecp5)
  endif()
  cmake_path(ABSOLUTE_PATH arg_SOURCE NORMALIZE)
  list(TRANSFORM arg_DEFINES PREPEND -D)
  list(TRANSFORM arg_INCLUDES PREPEND -I)

  # Written to a folder of its own first: a compiler that was rebuilt but writes the same Verilog costs no new model.
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.rtl)
  set(names ${arg_TOP}.v ${arg_TOP}.graph report.json report.txt)
  if(arg_AXI_LITE)
    list(APPEND arg_OPTIONS --axi-lite)
    list(APPEND names ${arg_TOP}_registers.h ${arg_TOP}_registers.json ${arg_TOP}_registers.md)
  elseif("--axi-lite" IN_LIST arg_OPTIONS)
    message(FATAL_ERROR "epiline_add_rtl(${target}): write AXI_LITE instead of OPTIONS --axi-lite, which leaves the register "
                        "map's files out")
  endif()
  list(TRANSFORM names PREPEND ${folder}.fresh/ OUTPUT_VARIABLE fresh_files)
  list(TRANSFORM names PREPEND ${folder}/ OUTPUT_VARIABLE files)
  add_custom_command(
    OUTPUT ${fresh_files}
    COMMAND epiline-hls ${arg_SOURCE} --top ${arg_TOP} --clock ${arg_CLOCK} --target ${arg_TARGET} -o ${folder}.fresh
            --depfile ${folder}.d --quiet ${arg_DEFINES} ${arg_INCLUDES} ${arg_OPTIONS}
    DEPENDS epiline-hls ${arg_SOURCE}
    DEPFILE ${folder}.d
    COMMENT "Compiling ${arg_TOP} of ${target} to Verilog"
    VERBATIM)
  add_custom_command(
    OUTPUT ${files}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${fresh_files} ${folder}
    DEPENDS ${fresh_files}
    VERBATIM)
  add_custom_target(${target}_verilog DEPENDS ${files})
  epiline_add_verilog_model(${target} TOP ${arg_TOP} VERILOG ${folder}/${arg_TOP}.v REPORT ${folder}/report.json)
  add_dependencies(${target}_verilated ${target}_verilog)
  add_dependencies(${target} ${target}_verilog)
  set_target_properties(${target} PROPERTIES EPILINE_RTL_FOLDER ${folder} EPILINE_RTL_TOP ${arg_TOP})
endfunction()

function(epiline_add_netlist_model target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TOP;VERILOG;REPORT;TARGET" "DEPENDS")
  epiline_check_arguments(TOP REPORT VERILOG)
  set(root ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/..)
  if(NOT arg_TARGET)
    set(arg_TARGET ecp5)
  endif()
  set(family ${arg_TARGET})
  if(arg_TARGET STREQUAL "hx8k")
    set(family ice40)
  endif()
  set(cells ${root}/tb/cosim/${family}_cells.v)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}.netlist)
  set(netlist ${folder}/${arg_TOP}_netlist.v)
  add_custom_command(
    OUTPUT ${netlist} ${folder}/resources.json
    COMMAND ${root}/scripts/synthesize.sh ${arg_VERILOG} ${arg_TOP} -o ${folder} --target ${arg_TARGET}
    DEPENDS ${arg_VERILOG} ${arg_DEPENDS} ${root}/scripts/synthesize.sh
            ${root}/scripts/adders.v ${root}/scripts/ecp5_operators.v
            ${root}/scripts/ecp5_copies.v ${root}/scripts/ice40_copies.v
            ${root}/scripts/ram_output_registers.py ${root}/scripts/carry_chains.py ${root}/scripts/join_carry_chains.py
            ${root}/scripts/netlist_file.py ${root}/scripts/netlist_resources.py
    COMMENT "Synthesizing ${arg_TOP} of ${target}"
    VERBATIM)
  add_custom_target(${target}_netlist DEPENDS ${netlist})
  epiline_add_verilog_model(${target} TOP ${arg_TOP} VERILOG ${netlist} ${cells}
    REPORT ${arg_REPORT} NO_LINT)
  add_dependencies(${target}_verilated ${target}_netlist)
  add_dependencies(${target} ${target}_netlist)
  set_target_properties(${target} PROPERTIES EPILINE_NETLIST_FOLDER ${folder})
endfunction()

function(epiline_add_netlist_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "RTL;TARGET" "")
  epiline_check_arguments(RTL)
  get_target_property(folder ${arg_RTL} EPILINE_RTL_FOLDER)
  get_target_property(top ${arg_RTL} EPILINE_RTL_TOP)
  epiline_add_netlist_model(${target} TOP ${top} VERILOG ${folder}/${top}.v REPORT ${folder}/report.json
    TARGET "${arg_TARGET}")
  add_dependencies(${target}_netlist ${arg_RTL}_verilog)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}_library.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "// Entry of a model that is loaded at run time.
#include \"${target}_model.hpp\"

extern \"C\" epiline::cosim::rtl_model* epiline_make_model(std::uint64_t seed) {
  return epiline::cosim::make_${target}_model(seed).release();
}
")
  add_library(${target}_library SHARED EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${target}_library PRIVATE ${target})
  add_dependencies(${target}_library ${target})
endfunction()
