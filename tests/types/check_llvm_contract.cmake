# Checks the synthesis build's LLVM IR against the contract with the compiler's frontend.
# -D CLANG=<clang++> -D TYPES=<hls/types> -D SOURCES=<folder of this file>
function(compile source)
  execute_process(COMMAND ${CLANG} -D__SYNTHESIS__ -std=c++17 -O2 -mllvm -inline-threshold=1000000 -Wall -Wextra -Werror
                          -S -emit-llvm -o - -I${TYPES} ${ARGN} ${SOURCES}/${source}
                  OUTPUT_VARIABLE output ERROR_VARIABLE messages RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${messages}")
  endif()
  set(ir "${output}" PARENT_SCOPE)
endfunction()

function(expect description pattern)
  if(NOT ir MATCHES "${pattern}")
    message(SEND_ERROR "${description}: no match for ${pattern}")
  endif()
endfunction()

function(refuse description pattern)
  if(ir MATCHES "${pattern}")
    message(SEND_ERROR "${description}: ${CMAKE_MATCH_0}")
  endif()
endfunction()

compile(llvm_tokens.cpp)

# Width and sign of a leaf. <> marks a packed type.
expect("unsigned leaf of 12 bits" "type <?{ i16, \\[0 x \\[12 x i8\\]\\] }")
expect("signed leaf of 20 bits" "type <?{ i32, \\[0 x \\[20 x i16\\]\\] }")
expect("signed leaf of 1 bit" "type <?{ i8, \\[0 x \\[1 x i16\\]\\] }")
expect("unsigned leaf of 200 bits" "type <?{ i256, \\[0 x \\[200 x i8\\]\\] }")

# Each AXI field behind its number; absent ones not at all; no padding anywhere.
foreach(field "data_field;1" "keep_field;2" "strb_field;3" "user_field;4" "last_field;5" "id_field;6" "dest_field;7")
  list(GET field 0 name)
  list(GET field 1 number)
  expect("tag of ${name}" "axis::${name}[.0-9]*\" = type <?{ \\[0 x \\[${number} x i32\\]\\], %[^,]* }")
endforeach()
set(q "\"struct.epiline::axis::")
set(e "_field[.0-9]*\"")
expect("fields of ap_axiu<12, 1, 2, 3>, in order"
       "hls::axis[.0-9]*\" = type <?{ %${q}data${e}, %${q}keep${e}, %${q}strb${e}, %${q}user${e}, %${q}last${e}, %${q}id${e}, %${q}dest${e} }")
expect("fields of ap_axis<20>, in order" "hls::axis[.0-9]*\" = type <?{ %${q}data${e}, %${q}keep${e}, %${q}strb${e}, %${q}last${e} }")
set(leaf "%\"class.epiline::ap::ap_int_base[.0-9]*\"")
expect("a structure's members and nothing else" "%struct.rgb = type <?{ ${leaf}, \\[2 x ${leaf}\\], ${leaf}, i8 }")

# The calls.
foreach(function read write)
  expect("${function}" "call void @__epiline_stream_${function}\\(ptr [^,]*, ptr [^,]*, ptr [^,]*@_ZN7epiline6detail8type_tagI")
endforeach()
expect("empty" "call [^@]*i1 @__epiline_stream_empty\\(ptr ")
expect("full" "call [^@]*i1 @__epiline_stream_full\\(ptr ")
expect("a token's type is declared, never defined"
       "@_ZN7epiline6detail8type_tagIN3hls4axis[A-Za-z0-9_]*6objectE = external global %\"struct.hls::axis")

refuse("dynamic initialisation" "@llvm.global_ctors")

# Everything inlines into values: no loop, no stack slot, no call but LLVM's own.
compile(llvm_values.cpp)
expect("reversal of a range" "call [a-z ]*i13 @llvm.bitreverse.i13")
refuse("a loop" "!llvm.loop")
refuse("a stack slot" "alloca [^\n]*")
refuse("a call" "call [^@\n]*@[^l][^\n]*")

# Before LLVM chooses other widths, clang computes at the exact one.
compile(llvm_values.cpp -Xclang -disable-llvm-passes)
expect("addition of ap_uint<13> and ap_int<13>" "add nsw i15 ")
expect("product of two ap_int<15>" "mul nsw i30 ")
