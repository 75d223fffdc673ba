#include "passes/pipeline.hpp"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "passes/balance_trees.hpp"
#include "passes/expand_arithmetic.hpp"
#include "passes/fold_magnitudes.hpp"
#include "passes/forward_memories.hpp"
#include "passes/merge_registers.hpp"
#include "passes/narrow_widths.hpp"
#include "passes/pack_memories.hpp"
#include "passes/place_tables.hpp"
#include "passes/reduce_strength.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {

using dataflow::graph;
using dataflow::operation;

namespace {

/// Narrower values make rules apply that make values narrower; three rounds reach all there is in practice.
constexpr unsigned max_rounds = 4;

class runner {
 public:
  runner(graph& g, const pipeline_options& options) : g_(g), options_(options) { check("the given graph"); }

  void run(const char* name, const std::function<void(graph&)>& pass) {
    const graph_size before = size_of(g_);
    if (!options_.observer) {
      pass(g_);
      check(name);
    } else {
      number_objects(g_);
      const graph given = g_;
      pass(g_);
      check(name);
      options_.observer(name, given, g_);
    }
    reports.push_back({name, before, size_of(g_)});
  }

  void shrink() {
    for (unsigned round = 0; round < max_rounds; ++round) {
      const graph_size before = size_of(g_);
      const std::size_t nodes = g_.nodes.size();
      run("narrow_widths", narrow_widths);
      run("simplify", simplify);
      if (size_of(g_) == before && g_.nodes.size() == nodes) return;
    }
  }

  std::vector<pass_report> reports;

 private:
  void check(const char* where) const {
    if (const std::string what = dataflow::find_violation(g_); !what.empty())
      throw std::logic_error(fmt::format("after {}: {}", where, what));
  }

  graph& g_;
  const pipeline_options& options_;
};

}  // namespace

graph_size size_of(const graph& g) {
  graph_size size;
  for (const auto& n : g.nodes) {
    const bool wire = n.kind == operation::constant || n.kind == operation::register_value ||
                      n.kind == operation::concat || n.kind == operation::slice || n.kind == operation::extend_zero ||
                      n.kind == operation::extend_sign;
    size.nodes += wire ? 0 : 1;
  }
  for (const auto& r : g.registers) size.register_bits += r.width;
  for (const auto& m : g.memories) size.memory_bits += std::uint64_t{m.words} * m.width;
  return size;
}

void number_objects(graph& g) {
  for (dataflow::register_id r = 0; r < g.registers.size(); ++r) g.registers[r].origin = r;
  for (dataflow::memory_id m = 0; m < g.memories.size(); ++m) g.memories[m].origins = {m};
  for (std::uint32_t t = 0; t < g.tables.size(); ++t) g.tables[t].origin = t;
}

std::vector<pass_report> run_default_pipeline(graph& g, const pipeline_options& options) {
  runner passes(g, options);
  passes.run("simplify", simplify);
  passes.run("order_memory_accesses", order_memory_accesses);
  passes.run("merge_registers", merge_registers);
  passes.shrink();
  passes.run("merge_registers", merge_registers);  // equal widths make more registers equal
  passes.run("simplify", simplify);
  passes.run("reduce_strength", [](graph& x) { reduce_strength(x); });
  passes.run("expand_arithmetic", [&](graph& x) { expand_arithmetic(x, options.multiplier_width); });
  passes.run("balance_trees", balance_trees);
  passes.shrink();
  // Packed words are looked at as a whole, so they come last.
  passes.run("pack_memories", pack_memories);
  passes.run("forward_memories", [&](graph& x) { forward_memories(x, options.forwarded_writes); });
  passes.run("simplify", simplify);
  passes.run("fold_magnitudes", fold_magnitudes);
  passes.run("place_tables", place_tables);
  return std::move(passes.reports);
}

nlohmann::json to_json(const std::vector<pass_report>& reports) {
  const auto size = [](const graph_size& s) {
    return nlohmann::json{{"nodes", s.nodes}, {"register_bits", s.register_bits}, {"memory_bits", s.memory_bits}};
  };
  nlohmann::json list = nlohmann::json::array();
  for (const pass_report& r : reports)
    list.push_back({{"pass", r.pass}, {"before", size(r.before)}, {"after", size(r.after)}});
  return list;
}

}  // namespace epiline::passes
