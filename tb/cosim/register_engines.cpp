#include <fmt/format.h>

#include "color_fuzzy_rtl_model.hpp"
#include "cosim/engines.hpp"

namespace epiline::cosim {

void register_engines(eval::engine_registry& registry) {
  registry.add(
      {"color_fuzzy", "graph", "the compiler's dataflow graph, interpreted",
       [](const eval::design_description& design) { return make_graph_engine(design, EPILINE_COLOR_FUZZY_GRAPH); }});
  registry.add(
      {"color_fuzzy", "rtl", "the generated Verilog in Verilator, clock by clock",
       [](const eval::design_description& design) { return make_model_engine(design, make_color_fuzzy_rtl_model); }});
  registry.add(
      {"color_fuzzy", "netlist", "the ECP5 netlist after Yosys in Verilator (built on first use, which takes minutes)",
       [](const eval::design_description& design) {
         return make_netlist_engine(design, EPILINE_COLOR_FUZZY_NETLIST,
                                    "cmake --build '" EPILINE_BUILD_FOLDER "' --target color_fuzzy_netlist_library");
       }});
}

}  // namespace epiline::cosim
