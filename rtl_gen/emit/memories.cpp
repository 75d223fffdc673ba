#include "emit/memories.hpp"

#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;
using schedule::storage_kind;

namespace {

void write_contents(module_text& m, const std::string& name, const std::vector<llvm::APInt>& values) {
  // Runs of one value are loops: a wide memory of zeros, word by word, would take Verilator's compiler minutes.
  constexpr std::size_t shortest_loop = 5;
  const auto run_end = [&](std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    return end;
  };
  bool loops = false;
  for (std::size_t i = 0; i < values.size(); i = run_end(i)) loops |= run_end(i) - i >= shortest_loop;
  if (loops) {
    m.line("  initial begin : {}", m.names.fresh(name + "_contents"));
    m.line("    integer i;");
  } else {
    m.line("  initial begin");
  }
  for (std::size_t i = 0; i < values.size();) {
    const std::size_t end = run_end(i);
    const std::string value = literal(values[i]);
    if (end - i >= shortest_loop) {
      m.line("    for (i = {}; i < {}; i = i + 1) {}[i] = {};", i, end, name, value);
    } else {
      for (std::size_t word = i; word < end; ++word) m.line("    {}[{}] = {};", name, word, value);
    }
    i = end;
  }
  m.line("  end");
}

}  // namespace

void write_memory_declarations(module_text& m) {
  const auto style = [](storage_kind kind) {
    return kind == storage_kind::block ? "ram_style = \"block\"" : "ram_style = \"distributed\"";
  };
  if (!m.g.memories.empty()) m.title("memories: never reset, and not read before they are written");
  for (std::size_t i = 0; i < m.g.memories.size(); ++i) {
    const dataflow::memory& memory = m.g.memories[i];
    const memory_plan& p = m.plan.memories[i];
    // An array for each port that reads, since a RAM has one: to find out how many copies do, of an array that many
    // ports read, takes synthesis more memory than machines have (sixteen ports: over 20 GB).
    for (const std::string& array : m.names.memories[i]) {
      m.line("  (* {}{} *)", style(p.storage), p.never_meets ? ", no_rw_check" : "");
      m.line("  reg {}{} [0:{}];{}", range_of(memory.width), array, memory.words - 1, m.comment(memory.where));
      if (!memory.initial.empty()) write_contents(m, array, memory.initial);
    }
  }
  if (!m.g.tables.empty()) m.title("constant tables");
  for (std::size_t t = 0; t < m.g.tables.size(); ++t) {
    const dataflow::table& table = m.g.tables[t];
    std::vector<llvm::APInt> values = table.values;
    values.resize(std::bit_ceil(values.size()), llvm::APInt(table.width, 0));
    if (m.model.storage(table) == storage_kind::block) m.line("  (* rom_style = \"block\" *)");
    m.line("  reg {}{} [0:{}];{}", range_of(table.width), m.names.tables[t], values.size() - 1, m.comment(table.where));
    write_contents(m, m.names.tables[t], values);
  }
}

void write_delay_pointers(module_text& m) {
  std::map<int, bool> lengths;
  for (const delay_line& l : m.plan.lines) lengths[l.words()] = true;
  if (lengths.empty()) return;
  m.title("pointers of the delay lines: a word is read just before its place is written again");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    m.line("  reg {}delay_{}_in, delay_{}_out;", range_of(width), words, words);
  }
  m.line("  always @(posedge clk) begin");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    m.line("    delay_{}_in <= delay_{}_out;", words, words);
    m.line("    delay_{}_out <= (delay_{}_out == {}) ? {} : delay_{}_out + {};", words, words,
           literal(width, words - 1), literal(width, 0), words, literal(width, 1));
  }
  m.line("    if (resetting) begin");
  for (const auto& [words, used] : lengths) {
    const unsigned width = bits_for(words - 1);
    m.line("      delay_{}_in <= {};", words, literal(width, 0));
    m.line("      delay_{}_out <= {};", words, literal(width, 1));
  }
  m.line("    end");
  m.line("  end");
  std::set<std::string> copied;
  for (const delay_line& l : m.plan.lines) {
    if (l.pointers == 0 || !copied.insert(pointer_name(l, "out")).second) continue;
    // A clock behind the first ones, so that only flip-flops stand between: what counts is that `in` follows `out`.
    const unsigned width = bits_for(l.words() - 1);
    m.write_copy(pointer_name(l, "out"), width, fmt::format("delay_{}_out", l.words()));
    m.write_copy(pointer_name(l, "in"), width, pointer_name(l, "out"));
  }
}

void write_block_reads(module_text& m, int stage) {
  for (std::size_t i = 0; i < m.g.memories.size(); ++i) {
    if (m.plan.memories[i].storage != storage_kind::block) continue;
    for (const read_port& port : m.plan.memories[i].reads) {
      if (port.stage != stage) continue;
      const std::string& name = m.names.nodes[port.reads[0]];
      m.values.read_by(port.reads[0]);
      m.line("  reg {}{}_q;{}", range_of(m.g.memories[i].width), name, m.comment(m.g.nodes[port.reads[0]].where));
      m.line("  always @(posedge clk) {}_q <= {}[{}];", name, m.array_read_by(port.reads[0]),
             m.values.index(port.address, stage, m.g.memories[i].words));
    }
  }
}

void write_memory_writes(module_text& m, int stage) {
  for (std::size_t i = 0; i < m.g.memories.size(); ++i) {
    const memory_plan& p = m.plan.memories[i];
    if (p.writes.empty() || m.s.stage[p.writes[0]] != stage) continue;
    const std::vector<std::string>& arrays = m.names.memories[i];
    const std::uint64_t words = m.g.memories[i].words;
    const auto enable = [&](node_id condition) {
      // A flip-flop that says whether the stage holds an iteration, too, if there is one.
      if (const std::string early = m.values.update_bit(condition, stage); !early.empty()) return early;
      return m.is_always(condition) ? m.values.valid(stage)
                                    : fmt::format("{} & {}", m.values.valid(stage), m.values.operand(condition, stage));
    };
    if (p.writes.size() == 1 || !p.exclusive_writes) {
      m.line("  always @(posedge clk) begin{}", m.comment(m.g.nodes[p.writes[0]].where));
      for (const node_id id : p.writes) {
        const node& n = m.g.nodes[id];
        m.values.read_by(id);
        const std::string enabled = enable(n.operands[2]);
        const std::string address = m.values.index(n.operands[0], stage, words);
        const std::string data = m.values.whole(n.operands[1], stage);
        for (const std::string& array : arrays) m.line("    if ({}) {}[{}] <= {};", enabled, array, address, data);
      }
      m.line("  end");
      continue;
    }
    // At most one is enabled: one write port.
    std::string any, address, data;
    bool all_early = true;
    for (const node_id id : p.writes) {
      const node& n = m.g.nodes[id];
      m.values.read_by(id);
      const std::string early = m.values.update_bit(n.operands[2], stage);
      const std::string e = early.empty() ? m.values.operand(n.operands[2], stage) : early;
      all_early &= !early.empty();
      any += (any.empty() ? "" : " | ") + e;
      if (id == p.writes.back()) {
        address += m.values.index(n.operands[0], stage, words);
        data += m.values.operand(n.operands[1], stage);
      } else {
        address += fmt::format("{} ? {} : ", e, m.values.index(n.operands[0], stage, words));
        data += fmt::format("{} ? {} : ", e, m.values.operand(n.operands[1], stage));
      }
    }
    const std::string port = m.names.fresh(arrays[0] + "_write");
    const std::string port_address = m.names.fresh(arrays[0] + "_write_address");
    const std::string port_data = m.names.fresh(arrays[0] + "_write_data");
    m.line("  wire {} = {};", port, all_early ? any : fmt::format("{} & ({})", m.values.valid(stage), any));
    m.line("  wire {}{} = {};", range_of(bits_for(words - 1)), port_address, address);
    m.line("  wire {}{} = {};", range_of(m.g.memories[i].width), port_data, data);
    m.line("  always @(posedge clk) begin");
    for (const std::string& array : arrays) m.line("    if ({}) {}[{}] <= {};", port, array, port_address, port_data);
    m.line("  end");
  }
}

}  // namespace epiline::emit
