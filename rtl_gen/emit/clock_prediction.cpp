#include "emit/clock_prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "emit/report_breakdown.hpp"
#include "schedule/fan_out.hpp"

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using dataflow::register_id;
using nlohmann::json;
using schedule::delay_model;
using schedule::delay_parameters;
using schedule::settled;
using schedule::storage_kind;

namespace {

constexpr double alike = 0.05;  // chains that differ by less, in nanoseconds or wires, are one

constexpr const char* built_in_delays =
#include "emit/device_delays.inc"
    ;

struct named_delay {
  const char* group;
  const char* name;
  double device_delays::* value;
};
constexpr named_delay named_delays[] = {{"cells_ns", "clock_to_out", &device_delays::clock_to_out},
                                        {"cells_ns", "lut", &device_delays::lut},
                                        {"cells_ns", "carry_entry", &device_delays::carry_entry},
                                        {"cells_ns", "carry_bit", &device_delays::carry_bit},
                                        {"cells_ns", "carry_exit", &device_delays::carry_exit},
                                        {"cells_ns", "multiplier", &device_delays::multiplier},
                                        {"cells_ns", "distributed_read", &device_delays::distributed_read},
                                        {"cells_ns", "block_clock_to_out", &device_delays::block_clock_to_out},
                                        {"cells_ns", "block_setup", &device_delays::block_setup},
                                        {"cells_ns", "setup", &device_delays::setup},
                                        {"cells_ns", "enable_setup", &device_delays::enable_setup},
                                        {"wires_ns", "wire", &device_delays::wire},
                                        {"wires_ns", "reader_doubling", &device_delays::reader_doubling},
                                        {"wires_ns", "block_wire", &device_delays::block_wire},
                                        {"wires_ns", "side_doubling", &device_delays::side_doubling}};

using chain = timed_chain;

chain operator+(const chain& a, const chain& b) {
  return {a.cells + b.cells, a.wires + b.wires, a.doublings + b.doublings};
}

double doublings_of(double readers) { return std::log2(std::max(1.0, readers)); }

/// The delay model's view of an operation, how many cells and how many wires it takes one after another, asked for
/// twice: once for the cells with wires of no length, once for the wires with cells that take no time.
class operation_delays {
 public:
  operation_delays(const delay_model& model, const device_delays& d)
      : cells_(model.with(cells_of(model.parameters(), d))),
        wires_(model.with(wires_of(model.parameters(), d))),
        sign_{d.carry_entry + d.carry_exit, 1, 0} {}

  [[nodiscard]] chain of(const graph& g, node_id id) const {
    chain c{cells_.delay(g, id), wires_.delay(g, id), 0};
    const node& n = g.nodes[id];
    // Synthesis finds the sign of a difference behind the carry chain, by a short one of its own.
    if (n.kind == operation::less_signed && g.nodes[n.operands[0]].width > 2) c = c + sign_;
    return c;
  }
  [[nodiscard]] chain entry(const graph& g, node_id id, std::size_t index) const {
    return {cells_.entry(g, id, index), wires_.entry(g, id, index), 0};
  }

 private:
  static delay_parameters cells_of(delay_parameters p, const device_delays& d) {
    p.lut_level = d.lut;
    p.carry_entry = d.carry_entry;
    p.carry_bit = d.carry_bit;
    p.carry_exit = d.carry_exit;
    p.multiplier = d.multiplier;
    p.distributed_read = d.distributed_read;
    p.memory_setup = d.block_setup;
    p.block_wire = 0;
    return p;
  }
  static delay_parameters wires_of(delay_parameters p, const device_delays& d) {
    p.lut_level = p.carry_exit = p.multiplier = p.distributed_read = 1;  // the wire behind it
    p.carry_entry = p.carry_bit = p.memory_setup = 0;
    p.block_wire = d.block_wire;
    return p;
  }

  delay_model cells_, wires_;
  chain sign_;
};

class predictor {
 public:
  predictor(const graph& g, const delay_model& model, const schedule::result& s, const plan& p, const device_delays& d,
            const design_size& size)
      : g_(g), model_(model), s_(s), plan_(p), d_(d), operations_(model, d), side_(size.side()) {}

  clock_prediction run() {
    count_readers();
    follow_operations();
    end_in_state();
    follow_issue();
    for (const output_fifo& f : plan_.fifos) follow_output(f);
    best_.side = side_;
    std::sort(best_.chains.begin(), best_.chains.end(), [](const chain& a, const chain& b) {
      return std::tuple(a.cells, a.wires, a.doublings) > std::tuple(b.cells, b.wires, b.doublings);
    });
    return best_;
  }

 private:
  [[nodiscard]] double total(const chain& c) const {
    return c.cells + c.wires * d_.wire + c.doublings * d_.reader_doubling;
  }

  void offer(const chain& c, const std::string& end, dataflow::source_location where) {
    const double period = total(c) + d_.side_doubling * doublings_of(side_ / compact_side);
    if (period > best_.period) {
      best_.period = period;
      best_.longest = c;
      best_.end = end;
      best_.where = where;
    }
    const auto covers = [](const chain& a, const chain& b) {
      return a.cells >= b.cells - alike && a.wires >= b.wires - alike && a.doublings >= b.doublings - alike;
    };
    std::vector<chain>& front = best_.chains;
    if (std::any_of(front.begin(), front.end(), [&](const chain& other) { return covers(other, c); })) return;
    front.erase(std::remove_if(front.begin(), front.end(), [&](const chain& other) { return covers(c, other); }),
                front.end());
    front.push_back(c);
  }

  /// The last wire leads inside a slice from a LUT to its flip-flop.
  void offer_into_flip_flop(chain c, const std::string& end, dataflow::source_location where) {
    c.wires -= std::min(1.0, std::max(0.0, c.wires - 1));
    c.cells += d_.setup;
    offer(c, end, where);
  }

  void count_readers() {
    near_.assign(g_.nodes.size(), 0);
    far_.assign(g_.nodes.size(), 0);
    const auto count = static_cast<schedule::reader>(g_.nodes.size());
    for (const schedule::load& l : schedule::find_loads(g_, model_)) {
      const int stage = l.by < count ? s_.stage[l.by] : s_.register_update[l.by - count];
      if (l.enables && plan_.update_bits.contains({l.value, stage})) continue;
      (stage == s_.available[l.value] ? near_ : far_)[l.value] += l.inputs;
    }
  }

  /// From a flip-flop that `readers` inputs hang on; waiting values have copies from some readers on.
  [[nodiscard]] chain launch(double readers) const { return {d_.clock_to_out, 1, doublings_of(readers)}; }
  [[nodiscard]] chain launch(node_id value, int stage) const {
    if (s_.stage[value] != settled && stage == s_.available[value]) {
      if (s_.available[value] > s_.stage[value])
        return {d_.block_clock_to_out, 1 + d_.block_wire, doublings_of(near_[value])};
      return launch(near_[value]);
    }
    return launch(std::min(far_[value], static_cast<double>(model_.parameters().most_readers)));
  }

  /// Whether the operand's logic and what reads it in `stage` are one chain.
  [[nodiscard]] bool is_chained(node_id operand, int stage) const {
    if (g_.nodes[operand].kind == operation::register_value || g_.nodes[operand].kind == operation::constant)
      return false;
    if (stage == settled) return s_.stage[operand] == settled && !schedule::is_settled_register(g_, s_, operand);
    return s_.stage[operand] == stage && s_.available[operand] == stage;
  }
  [[nodiscard]] chain arriving(node_id operand, int stage) const {
    if (g_.nodes[operand].kind == operation::constant) return {};
    return is_chained(operand, stage) ? arrival_[operand] : launch(operand, stage);
  }
  [[nodiscard]] std::string name_of(node_id id) const {
    const std::string name = value_name(g_, g_.nodes[id]);
    return name.empty() ? dataflow::name_of(g_.nodes[id].kind) : name;
  }

  void follow_operations() {
    arrival_.assign(g_.nodes.size(), {});
    for (node_id id = 0; id < g_.nodes.size(); ++id) {
      const node& n = g_.nodes[id];
      if (n.kind == operation::constant || n.kind == operation::register_value) continue;
      chain latest = n.kind == operation::read ? launch(n.width) : chain{};
      for (std::size_t i = 0; i < n.operands.size(); ++i) {
        chain in = arriving(n.operands[i], s_.stage[id]) + operations_.entry(g_, id, i);
        // Of a word that is written somebody else decides how many bits there are.
        if (dataflow::is_write_enable(n, i)) {
          if (plan_.update_bits.contains({n.operands[i], s_.stage[id]})) continue;
          in.cells += d_.enable_setup;
        }
        if (total(in) > total(latest)) latest = in;
      }
      const bool is_end = s_.available[id] > s_.stage[id] || n.kind == operation::memory_write;
      if (is_end) offer(latest, name_of(id), n.where);
      arrival_[id] = latest + operations_.of(g_, id);
      if (schedule::is_wire(g_, id)) continue;  // its readers hang on what is before it
      if (!is_end) offer_into_flip_flop(arrival_[id], name_of(id), n.where);
      arrival_[id].doublings += doublings_of(near_[id]);
    }
  }

  void end_in_state() {
    std::map<std::pair<node_id, int>, double> enabled;  // flip-flops by condition and stage
    for (register_id r = 0; r < g_.registers.size(); ++r)
      enabled[{g_.registers[r].enable, s_.register_update[r]}] += g_.registers[r].width;
    std::set<std::pair<node_id, int>> into_block_rams;
    for (node_id id = 0; id < g_.nodes.size(); ++id) {
      const node& n = g_.nodes[id];
      if (n.kind != operation::memory_write) continue;
      const std::pair<node_id, int> place{n.operands[2], s_.stage[id]};
      if (!plan_.update_bits.contains(place)) continue;
      enabled[place] += schedule::memory_inputs(g_, model_, n.object);
      if (model_.storage(g_.memories[n.object]) == schedule::storage_kind::block) into_block_rams.insert(place);
    }
    for (const auto& [place, flip_flops] : enabled) {
      const auto [condition, stage] = place;
      const node& n = g_.nodes[condition];
      if (n.kind == operation::constant) continue;
      if (const auto bit = plan_.update_bits.find(place); bit != plan_.update_bits.end()) {
        const chain gate{d_.lut, 1, 0};
        offer_into_flip_flop(arriving(condition, stage - 1) + gate, name_of(condition), n.where);
        chain out = launch(flip_flops / static_cast<double>(bit->second.count()));
        out.cells += d_.enable_setup;
        if (into_block_rams.contains(place)) out.wires += d_.block_wire;
        offer(out, name_of(condition), n.where);
      } else {
        const chain gate{d_.lut + d_.enable_setup, 1, is_chained(condition, stage) ? 0 : doublings_of(flip_flops)};
        offer(arriving(condition, stage) + gate, name_of(condition), n.where);
      }
    }
  }

  /// From the flags of the inputs and of the outputs' room to what stage 0 changes.
  void follow_issue() {
    double changed = 0;
    for (register_id r = 0; r < g_.registers.size(); ++r)
      if (s_.register_update[r] == 0) changed += g_.registers[r].width;
    const chain decision{d_.lut + d_.enable_setup, 1, doublings_of(std::max(4.0, changed))};
    offer(launch(4) + decision, "issue", {});
    for (const node& n : g_.nodes) {
      if (n.kind == operation::read && g_.nodes[n.operands[0]].kind != operation::constant)
        offer(arriving(n.operands[0], 0) + decision, "issue", n.where);
    }
  }

  /// The FIFO of an output: its count of free places decides what is issued; its word is read out of it.
  void follow_output(const output_fifo& f) {
    const dataflow::port& port = g_.ports[f.port];
    const double pointer = std::log2(f.depth);
    // Whole LUTs: the last to arrive goes through all of them.
    const auto levels = [](double inputs) { return std::ceil(std::log2(inputs) / 2); };
    const auto gates = [&](double count) { return chain{count * d_.lut, count, 0}; };
    const bool always = std::any_of(f.writes.begin(), f.writes.end(), [&](node_id id) {
      return g_.nodes[g_.nodes[id].operands[0]].kind == operation::constant;
    });
    const chain counting{d_.carry_entry + d_.carry_bit * (pointer + 1) + d_.carry_exit, 1, 0};
    // The decision to issue wants room in every output, and waits for nothing else.
    const double flags = pointer * static_cast<double>(plan_.fifos.size()) + pointer + 1;
    offer_into_flip_flop(launch(2) + gates(always ? 0 : 1) + counting + gates(levels(flags)), "room of " + port.name,
                         port.where);
    chain load = launch(4) + gates(1);
    load.cells += d_.enable_setup;
    load.doublings += doublings_of(port.width + 2 * pointer);
    offer_into_flip_flop(launch(4) + gates(levels(2 * pointer + 2) + 1), "word of " + port.name, port.where);
    offer(load, "word of " + port.name, port.where);
    if (f.storage == storage_kind::distributed) {
      const double deep = std::max(0.0, pointer - 4) / 2;
      const chain word{d_.distributed_read, 1, doublings_of(port.width / 2.0)};
      offer_into_flip_flop(launch(2) + word + gates(deep), "word of " + port.name, port.where);
    }
  }

  const graph& g_;
  const delay_model& model_;
  const schedule::result& s_;
  const plan& plan_;
  const device_delays& d_;
  const operation_delays operations_;
  const double side_;
  std::vector<double> near_, far_;  // per node: inputs that a bit drives in the stage it is made in, and later
  std::vector<chain> arrival_;      // per node, at its readers
  clock_prediction best_;
};

}  // namespace

device_delays read_device_delays(const std::string& text) {
  const json all = json::parse(text, nullptr, false);
  if (all.is_discarded() || !all.is_object() || all.value("schema", json()) != "epiline-device-delays/1")
    throw std::invalid_argument(
        "not a file of delays (schema epiline-device-delays/1): scripts/delay_fit.py makes one");
  device_delays found;
  for (const named_delay& one : named_delays) {
    const json group = all.value(one.group, json());
    if (!group.is_object() || !group.contains(one.name) || !group[one.name].is_number() || group[one.name] < 0.0)
      throw std::invalid_argument(fmt::format("{}.{}: a number of nanoseconds is missing", one.group, one.name));
    found.*one.value = group[one.name];
  }
  return found;
}

std::optional<device_delays> fitted_delays(std::string_view target) {
  if (target != "ecp5") return std::nullopt;
  return read_device_delays(built_in_delays);
}

double design_size::side() const { return std::sqrt(std::max(luts, flip_flops)); }

clock_prediction predict_clock(const graph& g, const delay_model& model, const schedule::result& s, const plan& p,
                               const device_delays& delays, const design_size& size) {
  return predictor(g, model, s, p, delays, size).run();
}

json to_json(const graph& g, const clock_prediction& prediction) {
  json chains = json::array();
  for (const timed_chain& c : prediction.chains) {
    chains.push_back({{"cells_ns", c.cells}, {"wires", c.wires}, {"reader_doublings", c.doublings}});
  }
  return {{"period_ns", prediction.period},
          {"cells_ns", prediction.longest.cells},
          {"wires", prediction.longest.wires},
          {"reader_doublings", prediction.longest.doublings},
          {"side", prediction.side},
          {"ends_at", prediction.end},
          {"where", location(g, prediction.where)},
          {"chains", chains}};
}

std::string prediction_text(const json& prediction) {
  const double period = prediction["period_ns"];
  return fmt::format(
      "after place and route {:.2f} ns, {:.0f} MHz (predicted): {:.2f} ns in cells, {:.1f} wires, to {}  {}", period,
      1000 / period, prediction["cells_ns"].get<double>(), prediction["wires"].get<double>(),
      prediction["ends_at"].get<std::string>(), location_text(prediction["where"]));
}

}  // namespace epiline::emit
