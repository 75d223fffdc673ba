#include "emit/plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "schedule/reset_gates.hpp"

namespace epiline::emit {

using dataflow::graph;
using dataflow::node;
using dataflow::node_id;
using dataflow::none;
using dataflow::operation;
using schedule::settled;
using schedule::storage_kind;

namespace {

// From the issue to the credit's return: issue, FIFO write, the flag that a word waits, load of the output register,
// the way of its report to the counter, the counter, and one credit kept back because the counter sees an issue a clock
// late.
constexpr int credit_round_trip = 6 + clocks_to_credits;

/// The 1-bit nodes whose conjunction `id` is, with their polarity.
void collect_terms(const graph& g, node_id id, bool positive, std::vector<std::pair<node_id, bool>>& terms) {
  const node& n = g.nodes[id];
  if (n.kind == operation::bit_not && n.width == 1) {
    collect_terms(g, n.operands[0], !positive, terms);
  } else if ((n.kind == operation::bit_and && positive) || (n.kind == operation::bit_or && !positive)) {
    for (const node_id operand : n.operands) collect_terms(g, operand, positive, terms);
  } else {
    terms.emplace_back(id, positive);
  }
}

/// True when `a` and `b` are visibly never 1 together: one contains the inverse of a term of the other, or both
/// compare one value with different constants.
bool is_exclusive(const graph& g, node_id a, node_id b) {
  std::vector<std::pair<node_id, bool>> a_terms, b_terms;
  collect_terms(g, a, true, a_terms);
  collect_terms(g, b, true, b_terms);
  const auto constant_of = [&](const node& n) -> const node* {
    for (const node_id operand : n.operands) {
      if (g.nodes[operand].kind == operation::constant) return &g.nodes[operand];
    }
    return nullptr;
  };
  for (const auto& [x, x_positive] : a_terms) {
    for (const auto& [y, y_positive] : b_terms) {
      if (x == y && x_positive != y_positive) return true;
      const node& p = g.nodes[x];
      const node& q = g.nodes[y];
      if (!x_positive || !y_positive || p.kind != operation::equal || q.kind != operation::equal) continue;
      const node* const c = constant_of(p);
      const node* const d = constant_of(q);
      if (c == nullptr || d == nullptr || c->width != d->width || c->value == d->value) continue;
      for (const node_id operand : p.operands) {
        const bool shared = std::find(q.operands.begin(), q.operands.end(), operand) != q.operands.end();
        if (shared && g.nodes[operand].kind != operation::constant) return true;
      }
    }
  }
  return false;
}

void plan_memories(const graph& g, const schedule::delay_model& model, const schedule::result& s, plan& p) {
  p.memories.resize(g.memories.size());
  for (std::size_t m = 0; m < g.memories.size(); ++m) p.memories[m].storage = model.storage(g.memories[m]);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (n.kind == operation::memory_write) p.memories[n.object].writes.push_back(id);
    if (n.kind != operation::memory_read) continue;
    std::vector<read_port>& ports = p.memories[n.object].reads;
    const auto same = std::find_if(ports.begin(), ports.end(), [&](const read_port& port) {
      return port.address == n.operands[0] && port.stage == s.stage[id];
    });
    if (same == ports.end()) {
      ports.push_back({n.operands[0], s.stage[id], {id}});
    } else {
      same->reads.push_back(id);
    }
  }
  for (memory_plan& memory : p.memories) {
    for (std::size_t i = 0; i < memory.writes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        memory.exclusive_writes &=
            is_exclusive(g, g.nodes[memory.writes[i]].operands[2], g.nodes[memory.writes[j]].operands[2]);
      }
      for (const read_port& port : memory.reads) {
        // Iterations met by a write after the read's stage are nearer than the memory's distance: never the same word.
        memory.never_meets &= s.stage[memory.writes[i]] > port.stage;
      }
    }
  }
}

/// Whether the condition under which a register or a memory is updated in `stage` is in flip-flops a stage earlier.
bool has_update_bit(const graph& g, const schedule::result& s, node_id condition, int stage) {
  return g.nodes[condition].kind != operation::constant && s.stage[condition] != settled && stage >= 2 &&
         s.available[condition] < stage - 1;
}

/// Lines of one length share their pointers, but only as many of them as one flip-flop drives well.
void divide_pointers(const schedule::delay_model& model, plan& p) {
  const schedule::delay_parameters& limits = model.parameters();
  std::map<int, std::pair<std::size_t, unsigned>> by_words;  // the last copy, and the RAMs that hang on it
  for (delay_line& line : p.lines) {
    const auto words = static_cast<unsigned>(line.words());
    const unsigned rams = line.storage == storage_kind::block
                              ? model.blocks(words, line.width)
                              : (line.width + 3) / 4 * ((words + 15) / 16);  // of 16 words and 4 bits
    auto& [copy, used] = by_words[line.words()];
    if (used > 0 && used + rams > limits.most_enabled) {
      ++copy;
      used = 0;
      p.spare_bits += 2 * std::bit_width(words - 1);
    }
    used += rams;
    line.pointers = copy;
  }
}

void plan_waits(const graph& g, const schedule::delay_model& model, const schedule::result& s,
                const delay_line_limits& limits, plan& p) {
  std::vector<std::vector<int>> taps(g.nodes.size());
  for (const schedule::use& u : schedule::uses(g, s)) {
    const bool early = u.enables && has_update_bit(g, s, u.value, u.stage);
    if (u.stage > s.available[u.value]) taps[u.value].push_back(early ? u.stage - 1 : u.stage);
  }
  const bool has_distributed = model.parameters().distributed_max_words > 0;
  std::map<std::pair<int, int>, std::vector<node_id>> long_waits;
  p.waits.resize(g.nodes.size());
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    std::vector<int>& stages = taps[id];
    std::sort(stages.begin(), stages.end());
    stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
    int at = s.available[id];
    for (const int stage : stages) {
      p.waits[id].push_back({at, stage, -1});
      const bool is_long = stage - at >= limits.distributed_clocks && g.nodes[id].width >= limits.distributed_bits;
      if (is_long) long_waits[{at, stage}].push_back(id);
      at = stage;
    }
  }
  for (const auto& [span, values] : long_waits) {
    unsigned together = 0;
    for (const node_id id : values) together += g.nodes[id].width;
    const int clocks = span.second - span.first;
    const bool block =
        (clocks >= limits.block_clocks || !has_distributed) && together >= limits.block_bits && clocks >= 4;
    if (!block && !has_distributed) continue;
    // A block RAM's words are filled; LUT RAM comes in any width, so a value keeps a memory of its own.
    const unsigned most = block ? std::max(model.parameters().block_max_width, 1u) : 0;
    int open = -1;
    for (const node_id id : values) {
      const unsigned width = g.nodes[id].width;
      if (open < 0 || p.lines[open].width + width > most) {
        open = static_cast<int>(p.lines.size());
        p.lines.push_back({span.first, span.second, 0, block ? storage_kind::block : storage_kind::distributed, {}});
      }
      delay_line& line = p.lines[open];
      line.values.push_back(id);
      line.width += width;
      for (wait_step& step : p.waits[id]) {
        if (step.from == span.first && step.to == span.second) step.line = open;
      }
    }
  }
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    for (const wait_step& step : p.waits[id]) {
      if (step.line < 0) p.copy_bits += static_cast<std::uint64_t>(step.to - step.from) * g.nodes[id].width;
    }
  }
  for (const delay_line& line : p.lines) p.copy_bits += line.width;
  divide_pointers(model, p);
}

/// Divides readers, in their order, among as few flip-flops as `most` inputs for each need.
copies divide_readers(std::vector<std::pair<schedule::reader, double>>& readers, unsigned most) {
  copies divided;
  divided.first_reader.push_back(0);
  double total = 0;
  for (const auto& [by, inputs] : readers) total += inputs;
  const double count = std::ceil(total / most);
  if (count <= 1) return divided;
  std::sort(readers.begin(), readers.end());
  double before = 0;
  for (const auto& [by, inputs] : readers) {
    if (before >= static_cast<double>(divided.count()) * total / count && by > divided.first_reader.back()) {
      divided.first_reader.push_back(by);
    }
    before += inputs;
  }
  return divided;
}

/// The loads that synthesis makes resets of flip-flops: the condition of a choice between a value and 0 that nothing
/// but flip-flops takes.
std::vector<char> find_resets(const graph& g, const schedule::result& s, const std::vector<schedule::load>& loads) {
  std::vector<char> ends_in_flip_flops(g.nodes.size(), 1);
  for (const schedule::load& l : loads)
    if (l.enables || (l.by < g.nodes.size() && s.stage[l.by] <= s.stage[l.value])) ends_in_flip_flops[l.value] = 0;
  std::vector<char> resets;
  for (const schedule::load& l : loads) {
    const bool chooses = l.by < g.nodes.size() && schedule::gated_value(g, g.nodes[l.by]) != none &&
                         g.nodes[l.by].operands[0] == l.value && ends_in_flip_flops[l.by] != 0;
    resets.push_back(chooses ? 1 : 0);
  }
  return resets;
}

/// Copies of flip-flops with many readers. The stage before feeds every copy, and has copies for that where needed.
void plan_copies(const graph& g, const schedule::delay_model& model, const schedule::result& s, plan& p) {
  const unsigned most = model.parameters().most_readers;
  constexpr unsigned widest = 64;  // wider values are parts side by side, each with few readers
  using readers = std::vector<std::pair<schedule::reader, double>>;
  std::map<std::pair<node_id, int>, readers> of_value, of_condition;
  const auto count = static_cast<schedule::reader>(g.nodes.size());
  // An enable and a reset serve whole slices. A RAM stands by itself: as an input of any kind, not as one flip-flop of
  // a slice.
  const double slices = static_cast<double>(model.parameters().most_enabled) / most;
  const auto enables = [&](const schedule::load& l) { return l.by < count ? l.inputs * slices : l.inputs; };
  const std::vector<schedule::load> loads = schedule::find_loads(g, model);
  const std::vector<char> resets = find_resets(g, s, loads);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const schedule::load& l = loads[i];
    const int stage = l.by < count ? s.stage[l.by] : s.register_update[l.by - count];
    if (s.stage[l.value] == settled || stage == settled || stage <= s.available[l.value]) continue;
    const bool is_condition = l.enables && has_update_bit(g, s, l.value, stage);
    if (g.nodes[l.value].width > widest) continue;
    if (is_condition) {
      of_condition[{l.value, stage}].emplace_back(l.by, enables(l));
    } else {
      of_value[{l.value, stage}].emplace_back(l.by, resets[i] != 0 ? l.inputs / slices : l.inputs);
    }
  }
  std::vector<readers> of_valid(p.last_valid + 1);
  for (auto& [place, here] : of_condition) {
    const copies divided = divide_readers(here, model.parameters().most_enabled);
    for (const schedule::reader by : divided.first_reader) {
      of_value[{place.first, place.second - 1}].emplace_back(by, 1);
      of_valid[place.second - 1].emplace_back(by, 1);
    }
    p.spare_bits += divided.count();
    p.update_bits[place] = divided;
  }
  for (node_id id = 0; id < count; ++id) {
    if (g.nodes[id].width > widest) continue;
    for (auto step = p.waits[id].rbegin(); step != p.waits[id].rend(); ++step) {
      if (step->line >= 0) continue;
      for (int stage = step->to; stage > step->from; --stage) {
        readers& here = of_value[{id, stage}];
        const copies divided = divide_readers(here, most);
        if (divided.count() == 1) continue;
        if (stage - 1 > s.available[id]) {
          for (const schedule::reader by : divided.first_reader) of_value[{id, stage - 1}].emplace_back(by, 1);
        }
        p.spare_bits += (divided.count() - 1) * g.nodes[id].width;
        p.value_copies[{id, stage}] = divided;
      }
    }
  }
  readers of_reset, of_early_reset;
  for (dataflow::register_id r = 0; r < g.registers.size(); ++r)
    if (s.register_stage[r] != settled && is_reset(g, s, r)) of_reset.emplace_back(count + r, g.registers[r].width);
  p.reset_copies = divide_readers(of_reset, model.parameters().most_reset);
  if (p.has_reset_rows()) {
    for (const schedule::reader by : p.reset_copies.first_reader) of_early_reset.emplace_back(by, 1);
    p.early_reset_copies = divide_readers(of_early_reset, most);
    p.spare_bits += p.reset_copies.count() + p.early_reset_copies.count();
  }
  // Valid bits enable the state and the memories.
  for (node_id id = 0; id < count; ++id) {
    const node& n = g.nodes[id];
    if (n.kind != operation::memory_write || p.update_bits.contains({n.operands[2], s.stage[id]})) continue;
    of_valid[s.stage[id]].emplace_back(id, schedule::memory_inputs(g, model, n.object));
  }
  for (dataflow::register_id r = 0; r < g.registers.size(); ++r) {
    const int stage = s.register_update[r];
    if (p.update_bits.contains({g.registers[r].enable, stage})) continue;
    of_valid[stage].emplace_back(count + r, g.registers[r].width);
  }
  p.valid_copies.assign(p.last_valid + 1, copies{{0}});
  for (int stage = p.last_valid; stage >= 1; --stage) {
    copies& divided = p.valid_copies[stage];
    divided = divide_readers(of_valid[stage], most);
    p.spare_bits += divided.count() - 1;
    if (divided.count() == 1 || stage == 1) continue;
    for (const schedule::reader by : divided.first_reader) of_valid[stage - 1].emplace_back(by, 1);
  }
}

}  // namespace

bool is_reset(const graph& g, const schedule::result& s, dataflow::register_id r) {
  return g.registers[r].initial && (g.registers[r].resets || s.register_stage[r] == settled);
}

std::size_t copies::of(schedule::reader by) const {
  const auto next = std::upper_bound(first_reader.begin(), first_reader.end(), by);
  return next == first_reader.begin() ? 0 : static_cast<std::size_t>(next - first_reader.begin()) - 1;
}

plan make_plan(const graph& g, const schedule::delay_model& model, const schedule::result& s,
               const delay_line_limits& limits) {
  plan p;
  plan_waits(g, model, s, limits, p);
  plan_memories(g, model, s, p);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    if (schedule::is_settled_register(g, s, id)) p.settled_bits += n.width;
    if (n.kind == operation::memory_write) p.last_valid = std::max(p.last_valid, s.stage[id]);
    if (n.kind != operation::write) continue;
    p.last_valid = std::max(p.last_valid, s.stage[id]);
    const auto same =
        std::find_if(p.fifos.begin(), p.fifos.end(), [&](const output_fifo& f) { return f.port == n.object; });
    if (same != p.fifos.end()) {
      same->writes.push_back(id);
    } else {
      const auto in_flight = static_cast<unsigned>(s.stage[id] + credit_round_trip);
      const unsigned depth = std::bit_ceil(in_flight);
      const bool block = depth > model.parameters().distributed_max_words;
      p.fifos.push_back({n.object, {id}, s.stage[id], depth, block ? storage_kind::block : storage_kind::distributed});
    }
  }
  std::sort(p.fifos.begin(), p.fifos.end(), [](const output_fifo& a, const output_fifo& b) { return a.port < b.port; });
  for (std::size_t r = 0; r < g.registers.size(); ++r) {
    p.last_valid = std::max(p.last_valid, s.register_update[r]);
    if (s.register_stage[r] == settled) p.settled_bits += g.registers[r].width;
  }
  plan_copies(g, model, s, p);
  return p;
}

}  // namespace epiline::emit
