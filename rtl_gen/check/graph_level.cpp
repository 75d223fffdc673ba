#include "check/graph_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "dataflow/network_interpreter.hpp"

namespace epiline::check {

namespace {

/// Whether all that is wanted has come: a run without end is stopped then.
bool has_all(const dataflow::network& n, const reference& wanted, const std::vector<token_list>& outputs) {
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    if (!n.ports[id].input && outputs[id].size() < wanted.outputs[id].size()) return false;
  return true;
}

graph_verdict interpret(const dataflow::network& n, const reference& wanted, std::uint64_t most_iterations) {
  graph_verdict verdict;
  verdict.outputs.resize(n.ports.size());
  dataflow::network_interpreter engine(n);
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
    if (n.ports[id].input)
      for (const llvm::APInt& token : wanted.inputs[id]) engine.push(id, token);
  constexpr std::uint64_t iterations_at_once = 4096;
  dataflow::interpreter::progress progress;
  do {
    progress = engine.run_until_blocked(iterations_at_once);
    verdict.iterations += progress.iterations;
    for (dataflow::port_id id = 0; id < n.ports.size(); ++id)
      if (!n.ports[id].input)
        while (std::optional<llvm::APInt> token = engine.pop(id)) verdict.outputs[id].push_back(std::move(*token));
  } while (progress.last == dataflow::outcome::advanced && verdict.iterations < most_iterations &&
           !(wanted.may_give_more && has_all(n, wanted, verdict.outputs)));
  verdict.where = compare(n, wanted, verdict.outputs);
  verdict.problem = verdict.where.text;
  if (progress.last == dataflow::outcome::broken_promise) verdict.problem = engine.message();
  if (progress.last == dataflow::outcome::advanced && verdict.problem.empty() && !wanted.may_give_more)
    verdict.problem = fmt::format("still running after {} iterations: give a shorter stimulus", verdict.iterations);
  if (progress.last == dataflow::outcome::blocked && !verdict.problem.empty())
    verdict.problem += fmt::format(" ({})", engine.message());
  return verdict;
}

}  // namespace

graph_verdict run_graph(const dataflow::network& n, const reference& wanted, std::uint64_t most_iterations) {
  try {
    return interpret(n, wanted, most_iterations);
  } catch (const std::exception& error) {
    graph_verdict verdict;
    verdict.problem = error.what();
    return verdict;
  }
}

std::string write_place(const dataflow::network& n, dataflow::port_id id) {
  const dataflow::endpoint end = dataflow::find_end(n, n.ports[id].name, false);
  if (end.process == dataflow::none) return {};
  const dataflow::graph& g = n.processes[end.process];
  for (const dataflow::node& node : g.nodes)
    if (node.kind == dataflow::operation::write && node.object == end.port && node.where.line != 0)
      return fmt::format("{}:{}", g.files[node.where.file], node.where.line);
  return {};
}

}  // namespace epiline::check
