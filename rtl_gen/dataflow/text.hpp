#pragma once
// A readable text form of dataflow graphs, for people, tests and bug reports. Everything in the graph is in the
// text, except what objects were before a pass (`origin`).
//
//   graph "sum"
//   file "sum.cpp"
//   input stream "in" 9 @0:3
//     field "value" "tdata" 8                                  ; `signed` may follow
//     field "last" "tlast" 1
//   output result "total" 16
//     field "total" "tdata" 16
//   register "acc" 16 initial 0x0 next %4 enable %0 @0:5       ; register 0; `patient` may follow the enable
//                                          (`unreset` after the initial value: a reset does not bring it back)
//   memory "ram" 4 words 16 distance 2 promised @0:6           ; 4 words of 16 bits; `distance N` only when not 1
//     words 0x1 0x2 0x3 0x4
//   table "rom" 8
//     words 0x1f 0x20
//   %0 = constant 1 0x1
//   %1 = read 9 port 0 (%0) "beat" @0:7                        ; width, object, operands, name, file:line
//   %2 = slice 8 low 0 (%1)
//   ...
//   patient %0
//
// One line is one item; what follows `;` is a comment; objects are numbered in the order they stand, nodes must carry
// consecutive numbers from 0. Strings use the escapes \" \\ \n \t \xNN.

#include <stdexcept>
#include <string>
#include <string_view>

#include "dataflow/graph.hpp"

namespace epiline::dataflow {

/// Why a text is no graph: "line 12: found 'x', expected a width". Lines count from 1.
class text_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text form. `g` must keep every rule of graph.hpp.
[[nodiscard]] std::string print(const graph& g);

/// The graph a text describes; keeps every rule of graph.hpp. Throws text_error for anything else, and for texts that
/// would need more than 2^31 bits of constants or 2^32 bits of memory.
[[nodiscard]] graph parse(std::string_view text);

}  // namespace epiline::dataflow
