#include <fmt/format.h>

#include "adaptive_ca_p2_rtl_model.hpp"
#include "adaptive_ca_rtl_model.hpp"
#include "color_fuzzy_hx8k_rtl_model.hpp"
#include "color_fuzzy_p2_rtl_model.hpp"
#include "color_fuzzy_rtl_model.hpp"
#include "cosim/engines.hpp"

namespace epiline::cosim {
namespace {

/// What the build made of a design's top.
struct built_design {
  const char* name;
  const char* graph_file;
  std::unique_ptr<rtl_model> (*make_model)(std::uint64_t seed);
  const char* netlist_library;
  const char* netlist_target;
};

constexpr built_design built_designs[] = {
    {"color_fuzzy", EPILINE_COLOR_FUZZY_GRAPH, make_color_fuzzy_rtl_model, EPILINE_COLOR_FUZZY_NETLIST,
     "color_fuzzy_netlist_library"},
    {"adaptive_ca", EPILINE_ADAPTIVE_CA_GRAPH, make_adaptive_ca_rtl_model, EPILINE_ADAPTIVE_CA_NETLIST,
     "adaptive_ca_netlist_library"},
    {"color_fuzzy_p2", EPILINE_COLOR_FUZZY_P2_GRAPH, make_color_fuzzy_p2_rtl_model, EPILINE_COLOR_FUZZY_P2_NETLIST,
     "color_fuzzy_p2_netlist_library"},
    {"adaptive_ca_p2", EPILINE_ADAPTIVE_CA_P2_GRAPH, make_adaptive_ca_p2_rtl_model, EPILINE_ADAPTIVE_CA_P2_NETLIST,
     "adaptive_ca_p2_netlist_library"},
    {"color_fuzzy_hx8k", EPILINE_COLOR_FUZZY_HX8K_GRAPH, make_color_fuzzy_hx8k_rtl_model,
     EPILINE_COLOR_FUZZY_HX8K_NETLIST, "color_fuzzy_hx8k_netlist_library"},
};

}  // namespace

void register_engines(eval::engine_registry& registry) {
  for (const built_design& built : built_designs) {
    registry.add(
        {built.name, "graph", "the compiler's dataflow graph, interpreted",
         [&built](const eval::design_description& design) { return make_graph_engine(design, built.graph_file); }});
    registry.add(
        {built.name, "rtl", "the generated Verilog in Verilator, clock by clock",
         [&built](const eval::design_description& design) { return make_model_engine(design, built.make_model); }});
    registry.add({built.name, "netlist",
                  "the netlist after Yosys in Verilator (built on first use, which takes minutes)",
                  [&built](const eval::design_description& design) {
                    return make_netlist_engine(
                        design, built.netlist_library,
                        fmt::format("cmake --build '{}' --target {}", EPILINE_BUILD_FOLDER, built.netlist_target));
                  }});
  }
}

}  // namespace epiline::cosim
