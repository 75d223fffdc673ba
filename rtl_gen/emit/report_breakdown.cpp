#include "emit/report_breakdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::operation;
using nlohmann::json;
using schedule::settled;

namespace {

/// Flip-flops in which a value waits for later stages, and its words of delay lines.
std::uint64_t waiting_bits(const graph& g, const plan& p, node_id id) {
  std::uint64_t bits = 0;
  for (const wait_step& step : p.waits[id]) bits += g.nodes[id].width * (step.line < 0 ? step.to - step.from : 1);
  return bits;
}

/// "taps" of "taps_3" and "rows_1_2": the elements of an array are one variable.
std::string variable_of(std::string name) {
  for (;;) {
    const std::size_t end = name.find_last_not_of("0123456789");
    if (end == std::string::npos || end == 0 || end + 1 == name.size() || name[end] != '_') return name;
    name.resize(end);
  }
}

}  // namespace

json location(const graph& g, dataflow::source_location where) {
  if (where.line == 0 || where.file >= g.files.size()) return nullptr;
  return {{"file", g.files[where.file]}, {"line", where.line}};
}

std::string location_text(const json& where) {
  return where.is_null() ? "unknown line"
                         : fmt::format("{}:{}", where["file"].get<std::string>(), where["line"].get<unsigned>());
}

std::string value_name(const graph& g, const node& n) {
  if (!n.name.empty()) return n.name;
  switch (n.kind) {
    case operation::register_value:
      return g.registers[n.object].name;
    case operation::memory_read:
    case operation::memory_write:
      return g.memories[n.object].name;
    case operation::read:
    case operation::write:
      return g.ports[n.object].name;
    case operation::table:
      return g.tables[n.object].name;
    default:
      return "";
  }
}

json describe_lines(const graph& g, const schedule::delay_model& model, const schedule::result& s, const plan& p) {
  struct line_cost {
    double luts = 0;
    unsigned operations = 0;
    std::uint64_t waiting = 0;
    std::map<int, std::map<std::string, unsigned>> stages;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, line_cost> found;
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::constant || location(g, n.where).is_null()) continue;
    line_cost& line = found[{n.where.file, n.where.line}];
    line.luts += model.area(g, id);
    line.waiting += waiting_bits(g, p, id);
    ++line.operations;
    if (s.stage[id] != settled && !schedule::is_wire(g, id)) ++line.stages[s.stage[id]][dataflow::name_of(n.kind)];
  }
  json lines = json::array();
  for (const auto& [place, cost] : found) {
    json stages = json::array();
    for (const auto& [stage, operations] : cost.stages)
      stages.push_back({{"stage", stage}, {"operations", operations}});
    lines.push_back({{"where", location(g, {place.first, place.second})},
                     {"luts", cost.luts},
                     {"operations", cost.operations},
                     {"waiting_bits", cost.waiting},
                     {"stages", stages}});
  }
  return lines;
}

json describe_variables(const graph& g, const schedule::result& s, const plan& p) {
  struct bits {
    std::uint64_t state = 0, waiting = 0, memory = 0;
    [[nodiscard]] std::uint64_t total() const { return state + waiting + memory; }
  };
  std::map<std::tuple<std::string, std::uint32_t, std::uint32_t>, bits> found;
  const auto of = [&](const std::string& name, dataflow::source_location where) -> bits& {
    return found[{variable_of(name), where.file, where.line}];
  };
  for (const dataflow::register_state& r : g.registers) of(r.name, r.where).state += r.width;
  for (std::size_t m = 0; m < g.memories.size(); ++m) {
    const dataflow::memory& memory = g.memories[m];
    const std::uint64_t copies = std::max<std::size_t>(1, p.memories[m].reads.size());
    of(memory.name, memory.where).memory += copies * memory.words * memory.width;
  }
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    std::uint64_t waiting = waiting_bits(g, p, id);
    if (s.stage[id] != settled && s.available[id] > s.stage[id]) waiting += g.nodes[id].width;  // a RAM's output
    if (waiting > 0) of(value_name(g, g.nodes[id]), g.nodes[id].where).waiting += waiting;
  }
  std::vector<std::pair<std::tuple<std::string, std::uint32_t, std::uint32_t>, bits>> ranking(found.begin(),
                                                                                              found.end());
  std::sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) {
    return std::make_pair(b.second.total(), a.first) < std::make_pair(a.second.total(), b.first);
  });
  json variables = json::array();
  for (const auto& [key, size] : ranking) {
    variables.push_back({{"name", std::get<0>(key)},
                         {"where", location(g, {std::get<1>(key), std::get<2>(key)})},
                         {"state_bits", size.state},
                         {"waiting_bits", size.waiting},
                         {"memory_bits", size.memory}});
  }
  return variables;
}

json describe_limit(const json& report) {
  const double period = report["clock"]["period_ns"];
  const double slowest = report["critical_chain"]["delay_ns"];
  const json& loop = report["limiting_recurrence"];
  constexpr double nearly = 0.85;  // chains outside of recurrences leave so much to the wires
  if (!loop.is_null() && loop["delay_ns"].get<double>() > nearly * period) {
    return {
        {"by", "recurrence"},
        {"text", fmt::format("The recurrence through '{}' ({}) takes {:.2f} of {:.2f} ns: its next value must be there "
                             "when the next iteration starts, so no pipeline register can cut it.",
                             loop["register"].get<std::string>(), location_text(loop["where"]),
                             loop["delay_ns"].get<double>(), period)},
        {"suggestion",
         "Make the variable narrower, compute what does not depend on it before, look at its old value later, or "
         "allow more clocks an iteration with --ii."}};
  }
  if (report["initiation_interval"] > 1) {
    return {{"by", "interval"},
            {"text", fmt::format("An iteration starts every {} clocks.", report["initiation_interval"].get<int>())},
            {"suggestion",
             "Compile with --ii 1: if that cannot be, the message names the chain or the memory that forbids it."}};
  }
  return {{"by", "chain"},
          {"text", fmt::format("The slowest chain takes {:.2f} of {:.2f} ns. No recurrence is near the period.",
                               slowest, period)},
          {"suggestion",
           "A shorter period with --clock gives more stages and a faster clock; a longer one fewer "
           "flip-flops."}};
}

}  // namespace epiline::emit
