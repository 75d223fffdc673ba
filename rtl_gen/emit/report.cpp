#include "emit/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "emit/interface.hpp"
#include "emit/register_map.hpp"
#include "emit/report_breakdown.hpp"
#include "schedule/balance_fifos.hpp"

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using nlohmann::json;
using schedule::settled;
using schedule::storage_kind;

namespace {

constexpr std::size_t most_lines = 40;  // of the list of costly source lines
constexpr int schema_version = 4;       // docs/report.schema.json says what it means

}  // namespace

json describe_interface(const graph& g, bool axi_lite) {
  json ports = json::array();
  for (const rtl_port& port : interface_of(g, axi_lite)) {
    json fields = json::array();
    for (const rtl_field& f : port.fields) {
      fields.push_back({{"name", f.name},
                        {"signal", f.signal},
                        {"rtl", f.rtl},
                        {"width", f.width},
                        {"offset", f.offset},
                        {"signed", f.is_signed}});
    }
    ports.push_back({{"name", port.name},
                     {"kind", port.kind},
                     {"direction", port.input ? "input" : "output"},
                     {"width", port.width},
                     {"valid", port.valid},
                     {"ready", port.ready},
                     {"fields", fields},
                     {"where", location(g, port.where)}});
  }
  json interface = {
      {"module", g.name}, {"clock", "clk"}, {"reset", "rst"}, {"reset_active_high", true}, {"ports", ports}};
  if (axi_lite) interface["registers"] = to_json(make_register_map(g));
  return interface;
}

json make_report(const graph& g, const schedule::delay_model& model, const schedule::result& s,
                 const report_options& options) {
  const plan p = make_plan(g, model, s, options.delay_lines);
  json report;
  report["schema"] = fmt::format("epiline-report/{}", schema_version);
  report["schema_version"] = schema_version;
  report["top"] = g.name;
  report["target"] = model.target();
  report["clock"] = {{"period_ns", s.period}, {"estimated_period_ns", s.critical_delay}};
  report["initiation_interval"] = s.initiation_interval;
  report["depth"] = s.depth;
  report["drain_clocks_per_call"] = s.hold;
  report["interface"] = describe_interface(g, options.axi_lite);

  // Latency: from the clock an input token is accepted to the clock its output's tvalid can be seen: the input
  // register before the issue, the FIFO and its output register after the write.
  json latency = json::object();
  json fifos = json::array();
  double fifo_luts = 0;
  unsigned block_rams = 0;
  for (const output_fifo& f : p.fifos) {
    const dataflow::port& port = g.ports[f.port];
    latency[port.name] = schedule::latency_of(g, s, f.port);
    fifos.push_back({{"port", port.name}, {"stage", f.stage}, {"depth", f.depth}, {"width", port.width}});
    if (f.storage == storage_kind::block) {
      block_rams += model.blocks(f.depth, port.width);
    } else {
      fifo_luts += model.distributed_area(f.depth, port.width);
    }
  }
  report["latency_clocks"] = latency;

  std::vector<std::map<std::string, unsigned>> operations(s.depth);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<double, unsigned>> by_line;
  double luts = 0;
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::constant) continue;
    const double area = model.area(g, id);
    luts += area;
    auto& [line_area, line_count] = by_line[{n.where.file, n.where.line}];
    line_area += area;
    ++line_count;
    if (s.stage[id] != settled && !schedule::is_wire(g, id)) ++operations[s.stage[id]][dataflow::name_of(n.kind)];
  }
  json stages = json::array();
  for (int stage = 0; stage < s.depth; ++stage) {
    std::uint64_t bits = 0;
    for (node_id id = 0; id < g.nodes.size(); ++id) {
      for (const wait_step& step : p.waits[id]) {
        const bool here = step.line < 0 ? step.from < stage && stage <= step.to : step.to == stage;
        if (here) bits += g.nodes[id].width;
      }
    }
    stages.push_back({{"stage", stage}, {"operations", operations[stage]}, {"register_bits", bits}});
  }
  report["stages"] = stages;

  std::uint64_t state_bits = 0;
  for (const dataflow::register_state& r : g.registers) state_bits += r.width;
  std::uint64_t input_bits = 0;
  for (const dataflow::port& port : g.ports) {
    if (options.axi_lite && port.kind == dataflow::port_kind::call) {
      input_bits += make_register_map(g).flip_flops();
    } else {
      input_bits += port.input ? 2 * port.width + 3 : port.width;
    }
  }
  std::uint64_t word_bits = 0;
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    if (s.stage[id] != settled && s.available[id] > s.stage[id]) word_bits += g.nodes[id].width;
  }
  report["registers"] = {
      {"state_bits", state_bits},
      {"pipeline_bits", p.copy_bits},
      {"settled_bits", p.settled_bits},
      {"port_bits", input_bits},
      {"ram_output_bits", word_bits},
      {"valid_bits", p.last_valid},
      {"copies_bits", p.spare_bits},
      {"total_bits", state_bits + p.copy_bits + p.settled_bits + input_bits + word_bits + p.last_valid + p.spare_bits}};

  json memories = json::array();
  for (std::size_t m = 0; m < g.memories.size(); ++m) {
    const dataflow::memory& memory = g.memories[m];
    const memory_plan& mp = p.memories[m];
    const std::size_t copies = std::max<std::size_t>(1, mp.reads.size());
    const bool block = mp.storage == storage_kind::block;
    const unsigned blocks = block ? static_cast<unsigned>(copies) * model.blocks(memory.words, memory.width) : 0;
    block_rams += blocks;
    memories.push_back({{"name", memory.name},
                        {"words", memory.words},
                        {"width", memory.width},
                        {"copies", copies},
                        {"storage", schedule::name_of(mp.storage)},
                        {"block_rams", blocks},
                        {"distance", memory.distance},
                        {"distance_promised", memory.distance_promised},
                        {"write_ports", mp.writes.empty()     ? 0
                                        : mp.exclusive_writes ? 1
                                                              : mp.writes.size()},
                        {"where", location(g, memory.where)}});
  }
  report["memories"] = memories;
  json tables = json::array();
  for (std::size_t t = 0; t < g.tables.size(); ++t) {
    const dataflow::table& table = g.tables[t];
    std::size_t readers = 0;
    for (const node& n : g.nodes) readers += n.kind == operation::table && n.object == t;
    const bool block = model.storage(table) == storage_kind::block;
    const unsigned blocks = block ? static_cast<unsigned>(readers) * model.blocks(table.values.size(), table.width) : 0;
    block_rams += blocks;
    tables.push_back({{"name", table.name},
                      {"words", table.values.size()},
                      {"width", table.width},
                      {"readers", readers},
                      {"storage", schedule::name_of(model.storage(table))},
                      {"block_rams", blocks},
                      {"where", location(g, table.where)}});
  }
  report["tables"] = tables;
  json lines = json::array();
  for (const delay_line& l : p.lines) {
    const bool block = l.storage == storage_kind::block;
    const unsigned blocks = block ? model.blocks(static_cast<std::uint64_t>(l.words()), l.width) : 0;
    block_rams += blocks;
    if (!block) luts += model.distributed_area(static_cast<std::uint64_t>(l.words()), l.width);
    lines.push_back({{"from", l.from},
                     {"to", l.to},
                     {"width", l.width},
                     {"values", l.values.size()},
                     {"storage", schedule::name_of(l.storage)},
                     {"block_rams", blocks}});
  }
  report["delay_lines"] = lines;
  report["fifos"] = fifos;

  std::vector<std::tuple<double, std::uint32_t, std::uint32_t, unsigned>> ranking;
  for (const auto& [line, cost] : by_line) {
    if (cost.first > 0) ranking.emplace_back(-cost.first, line.first, line.second, cost.second);
  }
  std::sort(ranking.begin(), ranking.end());
  if (ranking.size() > most_lines) ranking.resize(most_lines);
  json costly = json::array();
  for (const auto& [area, file, line, count] : ranking) {
    costly.push_back({{"where", location(g, {file, line})}, {"luts", -area}, {"operations", count}});
  }
  report["estimate"] = {{"lut4", luts + fifo_luts}, {"block_rams", block_rams}, {"by_line", costly}};

  json chain = json::array();
  bool through_register = false;
  for (const schedule::chain_link& link : s.critical_chain) {
    const node& n = g.nodes[link.node];
    through_register |= n.kind == operation::register_value;
    chain.push_back({{"operation", dataflow::name_of(n.kind)},
                     {"name", value_name(g, n)},
                     {"width", n.width},
                     {"delay_ns", link.delay},
                     {"stage", s.stage[link.node]},
                     {"where", location(g, n.where)}});
  }
  report["critical_chain"] = {{"delay_ns", s.critical_delay}, {"starts_at_state", through_register}, {"links", chain}};

  // The slowest loop from a register to itself: what would limit a faster clock.
  json recurrence = nullptr;
  const std::vector<schedule::recurrence_delay> loops = schedule::recurrences(g, model, s);
  if (!loops.empty()) {
    const auto slowest =
        std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.delay < b.delay; });
    recurrence = {{"register", g.registers[slowest->state].name},
                  {"delay_ns", slowest->delay},
                  {"where", location(g, g.registers[slowest->state].where)}};
  }
  report["limiting_recurrence"] = recurrence;
  report["prediction"] = nullptr;
  if (options.delays) {
    const design_size size{luts + fifo_luts, report["registers"]["total_bits"].get<double>()};
    report["prediction"] = to_json(g, predict_clock(g, model, s, p, *options.delays, size));
  }
  report["lines"] = describe_lines(g, model, s, p);
  report["variables"] = describe_variables(g, s, p);
  report["limit"] = describe_limit(report);
  report["passes"] = options.passes;
  return report;
}

std::string report_text(const json& report) {
  std::string text;
  const auto line = [&]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    text += '\n';
  };
  const auto number = [](const json& j) { return j.get<std::uint64_t>(); };
  line("{}: {} stages, one iteration every {} clock(s)", report["top"].get<std::string>(), number(report["depth"]),
       number(report["initiation_interval"]));
  line("target {}, period {:.2f} ns; slowest chain {:.2f} ns (estimated)", report["target"].get<std::string>(),
       report["clock"]["period_ns"].get<double>(), report["clock"]["estimated_period_ns"].get<double>());
  if (!report["prediction"].is_null()) line("{}", prediction_text(report["prediction"]));
  if (number(report["drain_clocks_per_call"]) > 0) {
    line("a call's parameters take effect after {} clocks without an issue", number(report["drain_clocks_per_call"]));
  }
  const json& estimate = report["estimate"];
  const json& registers = report["registers"];
  line("\nEstimated size: {:.0f} LUT4, {} flip-flops, {} block RAMs", estimate["lut4"].get<double>(),
       number(registers["total_bits"]), number(estimate["block_rams"]));
  line("  flip-flops: {} state, {} pipeline, {} RAM outputs, {} ports, {} settled values, {} valid bits, {} copies",
       number(registers["state_bits"]), number(registers["pipeline_bits"]), number(registers["ram_output_bits"]),
       number(registers["port_bits"]), number(registers["settled_bits"]), number(registers["valid_bits"]),
       number(registers["copies_bits"]));

  line("\nPorts");
  for (const json& port : report["interface"]["ports"]) {
    std::string signals;
    for (const json& f : port["fields"]) {
      signals += fmt::format(" {}[{}]", f["rtl"].get<std::string>(), number(f["width"]));
    }
    const std::string name = port["name"];
    const json& latency = report["latency_clocks"];
    line("  {:<6} {:<6} {}:{} {} {}{}", port["direction"].get<std::string>(), port["kind"].get<std::string>(), name,
         signals, port["valid"].get<std::string>(), port["ready"].get<std::string>(),
         latency.contains(name) ? fmt::format("  latency {} clocks", number(latency[name])) : "");
  }

  if (report["interface"].contains("registers")) {
    line("Registers behind s_axi");
    for (const json& entry : report["interface"]["registers"]["registers"]) {
      line("  0x{:03x} {:<10} {} {}bits, {}", number(entry["address"]), entry["name"].get<std::string>(),
           number(entry["width"]), entry["signed"].get<bool>() ? "signed " : "", entry["access"].get<std::string>());
    }
  }

  line("\nSlowest chain: {:.2f} ns from clock to clock", report["critical_chain"]["delay_ns"].get<double>());
  for (const json& link : report["critical_chain"]["links"]) {
    line("  {:>6.2f} ns  stage {:>3}  {} of {} bits {}  {}", link["delay_ns"].get<double>(), link["stage"].get<int>(),
         link["operation"].get<std::string>(), number(link["width"]), link["name"].get<std::string>(),
         location_text(link["where"]));
  }
  if (const json& loop = report["limiting_recurrence"]; !loop.is_null()) {
    line("Slowest recurrence: {:.2f} ns through '{}' ({}); no pipelining shortens it", loop["delay_ns"].get<double>(),
         loop["register"].get<std::string>(), location_text(loop["where"]));
  }

  if (!report["memories"].empty()) line("\nMemories");
  for (const json& m : report["memories"]) {
    line("  {} x {} bits, {} cop{}, {}, {} block RAMs: {}  {}", number(m["words"]), number(m["width"]),
         number(m["copies"]), number(m["copies"]) == 1 ? "y" : "ies", m["storage"].get<std::string>(),
         number(m["block_rams"]), m["name"].get<std::string>(), location_text(m["where"]));
  }
  if (!report["tables"].empty()) line("\nTables");
  for (const json& t : report["tables"]) {
    line("  {} x {} bits, read in {} places, {}, {} block RAMs: {}", number(t["words"]), number(t["width"]),
         number(t["readers"]), t["storage"].get<std::string>(), number(t["block_rams"]), t["name"].get<std::string>());
  }
  if (!report["delay_lines"].empty()) line("\nDelay lines in RAM");
  std::map<std::tuple<std::uint64_t, std::uint64_t, std::string>, std::uint64_t> spans;
  for (const json& l : report["delay_lines"]) {
    spans[{number(l["from"]), number(l["to"]), l["storage"].get<std::string>()}] += number(l["width"]);
  }
  for (const auto& [span, bits] : spans) {
    line("  {} bits from stage {} to {}, {}", bits, std::get<0>(span), std::get<1>(span), std::get<2>(span));
  }

  line("\nStages");
  for (const json& stage : report["stages"]) {
    std::string operations;
    for (const auto& [name, count] : stage["operations"].items())
      operations += fmt::format(" {} {}", number(count), name);
    line("  {:>3}: {:>6} register bits;{}", number(stage["stage"]), number(stage["register_bits"]), operations);
  }

  line("\nCostliest source lines");
  for (const json& entry : estimate["by_line"]) {
    line("  {:>8.0f} LUT4  {:>6} operations  {}", entry["luts"].get<double>(), number(entry["operations"]),
         location_text(entry["where"]));
  }
  if (!report["passes"].empty()) line("\nPasses\n{}", report["passes"].dump(2));
  return text;
}

}  // namespace epiline::emit
