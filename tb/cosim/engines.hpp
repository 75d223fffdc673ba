#pragma once
// The engines that run what the compiler made of a design: its dataflow graph, its Verilog, its netlist.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "cosim/model.hpp"
#include "eval/engine.hpp"

namespace epiline::cosim {

/// A new instance of a model; the argument is the seed of registers and memories without reset.
using model_factory = std::function<std::unique_ptr<rtl_model>(std::uint64_t)>;

/// Simulates a module clock by clock. `cycles` of the result counts from the first token accepted to the last output.
[[nodiscard]] std::unique_ptr<eval::engine> make_model_engine(const eval::design_description& design,
                                                              model_factory make_model);

/// Interprets the graph that epiline-hls wrote to `graph_file`.
[[nodiscard]] std::unique_ptr<eval::engine> make_graph_engine(const eval::design_description& design,
                                                              std::filesystem::path graph_file);

/// Simulates the netlist of the design after synthesis. `library` is a shared library made by
/// epiline_add_netlist_library(); if it is not there, `build_command` is run first, which takes minutes.
[[nodiscard]] std::unique_ptr<eval::engine> make_netlist_engine(const eval::design_description& design,
                                                                std::filesystem::path library,
                                                                std::string build_command);

/// Adds the engines `graph`, `rtl` and `netlist` of every design whose top this build compiled.
void register_engines(eval::engine_registry& registry);

}  // namespace epiline::cosim
