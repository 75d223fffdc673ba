#pragma once
// The ports of the generated module, as a testbench or a neighbour in a design sees them. Shared by the Verilog and the
// report.

#include <string>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::emit {

/// One signal of a port's payload. In the order of the token, low bits first.
struct rtl_field {
  std::string name;
  std::string signal;  // "tdata", "tlast" ...; the scalar's name; of an AXI4-Lite channel "addr", "data" ...
  std::string rtl;     // the signal's name in Verilog
  unsigned width = 1;
  unsigned offset = 0;
  bool is_signed = false;
};

/// A group of signals with one handshake.
struct rtl_port {
  std::string name;
  std::string kind;  // "stream", "call", "result", "axi_lite"
  bool input = true;
  unsigned width = 0;  // of all fields
  std::string valid, ready;
  std::vector<rtl_field> fields;
  dataflow::source_location where;
};

/// The ports in the order of the module's port list. With `axi_lite` the five channels of an AXI4-Lite slave stand for
/// the call port: s_axi_aw, s_axi_w, s_axi_b, s_axi_ar, s_axi_r.
/// Throws std::invalid_argument when `axi_lite` is wanted and the graph has no call port.
[[nodiscard]] std::vector<rtl_port> interface_of(const dataflow::graph& g, bool axi_lite);

/// The module's first lines, to the end of its port list.
[[nodiscard]] std::string module_head(const dataflow::graph& g, const std::vector<rtl_port>& ports);

/// The RTL name of a port's signal: "s_axis_left_tdata", or the scalar's own name for a call port.
[[nodiscard]] std::string signal_name(const dataflow::port& port, std::string_view signal);

}  // namespace epiline::emit
