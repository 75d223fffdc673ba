#pragma once
// Random but legal dataflow graphs, random stimulus for them, and the comparison of two graphs by what they output.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"

namespace epiline::dataflow::testing {

struct random_graph_options {
  unsigned operations = 60;  // nodes drawn at random, without the adapters between widths
  bool memories = true;
  bool divisions = true;
};

/// The same graph for the same seed on every machine. Widths come from 1, 2, 8, 31..33, 63..65 and 130.
graph random_graph(std::uint64_t seed, const random_graph_options& options = {});

/// An APInt of random shape: uniform, few bits set, near 0 or near all ones.
llvm::APInt random_value(std::mt19937_64& random, unsigned width);

/// Runs both graphs on the same random tokens for up to `iterations` iterations and compares what each output port
/// gives. Ports are paired by name and direction. Returns an empty string or the first difference.
std::string find_difference(const graph& expected, const graph& actual, std::uint64_t seed, unsigned iterations);

}  // namespace epiline::dataflow::testing
