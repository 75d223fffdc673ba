#include "emit/handshakes.hpp"

#include <algorithm>
#include <string>

#include "emit/control.hpp"
#include "emit/register_map.hpp"

namespace epiline::emit {

using dataflow::node;
using dataflow::node_id;

namespace {

/// Two registers, filled and read in turn: neither side's flip-flops hang on what the other side does in this clock.
/// Takes over `token` where `offered` and STEM_ready are 1, gives it as STEM_token while STEM_there is 1, until
/// STEM_take, which is assigned elsewhere.
void write_buffer(module_text& m, const std::string& stem, unsigned width, const std::string& token,
                  const std::string& offered, bool foreseen) {
  const std::string range = range_of(width);
  m.line("  reg {0}{1}_first, {1}_second;", range, stem);
  m.line("  reg {0}_fills_second, {0}_reads_second;", stem);
  m.line("  reg {0}_there, {0}_ready;", stem);
  if (foreseen) m.line("  reg {}_served;  // the next iteration does not wait for this input", stem);
  m.line("  wire {}_take;", stem);
  m.line("  wire {0}_push = {1} & {0}_ready;", stem, offered);
  m.line("  wire {0}{1}_token = {1}_reads_second ? {1}_second : {1}_first;", range, stem);
  m.line("  always @(posedge clk) begin");
  m.line("    if ({0}_ready & ~{0}_fills_second) {0}_first <= {1};", stem, token);
  m.line("    if ({0}_ready & {0}_fills_second) {0}_second <= {1};", stem, token);
  m.line("    {0}_fills_second <= {0}_fills_second ^ {0}_push;", stem);
  m.line("    {0}_reads_second <= {0}_reads_second ^ {0}_take;", stem);
  m.line("    {0}_there <= {0}_push | ({0}_there & ~({0}_ready & {0}_take));", stem);
  m.line("    {0}_ready <= ~({0}_there & ~{0}_take & ({0}_push | ~{0}_ready));", stem);
  m.line("    if (rst) begin");
  for (const char* flag : {"fills_second", "reads_second", "there", "ready"})
    m.line("      {}_{} <= 1'b0;", stem, flag);
  m.line("    end");
  m.line("  end");
}

void write_sampled_arguments(module_text& m, const std::string& name) {
  const register_map map = make_register_map(m.g);
  m.title("arguments: registers behind an AXI4-Lite slave, sampled when a call starts");
  std::string signals, waiting;
  for (const rtl_port& port : m.interface) {
    if (port.kind != "axi_lite") continue;
    const auto connect = [&](const std::string& signal) { signals += fmt::format("    .{0}({0}),\n", signal); };
    for (const rtl_field& f : port.fields) connect(f.rtl);
    connect(port.valid);
    connect(port.ready);
  }
  for (std::size_t i = 0; i < m.g.ports.size(); ++i) {
    if (!m.g.ports[i].input || m.is_sampled(m.g.ports[i])) continue;
    waiting += (waiting.empty() ? "" : " | ") + m.names.ports[i] + "_there";
  }
  const std::string range = range_of(map.argument_bits);
  m.line("  wire {}{}_registers;", range, name);
  m.line("  reg {}{}_token;", range, name);
  m.line("  reg {}_there;", name);
  m.line("  wire {0}_take, {0}_start, {0}_hold, {0}_keep;", name);
  m.line("  wire {}_wanted;  // the next iteration begins a call", name);
  if (waiting.empty()) {
    m.line("  wire {0}_sample = {0}_wanted & ~{0}_there & {0}_start;", name);
  } else {
    m.line("  wire {0}_sample = {0}_wanted & ~{0}_there & ({0}_start | (~{0}_hold & ({1})));", name, waiting);
  }
  m.line("  {} {}_slave (\n    .clk(clk),\n    .rst(rst),", map.module(), name);
  m.out += signals;
  m.line("    .started({}_sample),", name);
  for (const char* bit : {"start", "hold", "keep"}) m.line("    .{0}({1}_{0}),", bit, name);
  m.line("    .arguments({}_registers)\n  );", name);
  m.line("  always @(posedge clk) begin");
  m.line("    if ({0}_sample & ~{0}_keep) {0}_token <= {0}_registers;", name);
  m.line("    {0}_there <= {0}_sample | ({0}_there & ~{0}_take);", name);
  m.line("    if (rst) begin");
  m.line("      {}_token <= {};", name, literal(map.argument_bits, 0));
  m.line("      {}_there <= 1'b0;", name);
  m.line("    end");
  m.line("  end");
}

void write_unwritten_output(module_text& m, const dataflow::port& port) {
  m.title(fmt::format("output {}: never written", port.name));
  m.line("  assign {} = 1'b0;", signal_name(port, "tvalid"));
  for (const dataflow::field& f : port.fields) {
    m.line("  assign {} = {};", signal_name(port, f.signal), literal(f.width, 0));
  }
}

/// A FIFO with room for all iterations in flight, and the output's last two registers.
void write_output(module_text& m, const dataflow::port& port, const std::string& name, const output_fifo& fifo) {
  const unsigned pointer = bits_for(fifo.depth - 1);
  const unsigned counter = pointer + 1;
  const int stage = fifo.stage;
  std::string pushes, data;
  bool always = false;
  for (const node_id id : fifo.writes) {
    const node& n = m.g.nodes[id];
    const std::string predicate = m.values.operand(n.operands[0], stage);
    always |= m.is_always(n.operands[0]);
    pushes += (pushes.empty() ? "" : " | ") + predicate;
    const bool last = id == fifo.writes.back();
    data += last ? m.values.operand(n.operands[1], stage)
                 : fmt::format("{} ? {} : ", predicate, m.values.operand(n.operands[1], stage));
  }
  m.line("  wire {}_push = {};", name,
         always ? m.values.valid(stage) : fmt::format("{} & ({})", m.values.valid(stage), pushes));
  m.line("  (* ram_style = \"{}\", no_rw_check *)", name_of(fifo.storage));
  m.line("  reg {}{}_fifo [0:{}];", range_of(port.width), name, fifo.depth - 1);
  m.line("  reg [{0}:0] {1}_in, {1}_out, {1}_after_out;", counter - 1, name);
  m.line("  reg {}{}_word;", range_of(port.width), name);
  m.line("  reg {0}_waits;  // the FIFO holds a word: in a flip-flop, because what takes it out enables many", name);
  // The credits stand near the decision to issue, the gate that lets a word leave near what it enables, at the output:
  // flip-flops in between, one for each quarter of the device.
  m.line("  reg {0}_word_there{1};", name, always ? "" : fmt::format(", {}_skipped", name));
  m.line("  reg [{}:0] {}_leaves;", clocks_to_credits - 1, name);
  m.line("  wire {0}_left = {0}_leaves[{1}];", name, clocks_to_credits - 1);
  // tready comes from a pin, or from somebody else's gates: only the last buffer's flags hang on it.
  const std::string end = name + "_end";
  write_buffer(m, end, port.width, name + "_word", name + "_word_there", false);
  m.line("  assign {0}_take = {0}_there & {1};", end, signal_name(port, "tready"));
  m.line("  wire {0}_load = {0}_waits & ({1}_ready | ~{0}_word_there);", name, end);
  m.line("  wire {0}_holds_one = {0}_in != {0}_out;", name);
  m.line("  wire {0}_holds_another = {0}_in != {0}_after_out;", name);
  m.line("  wire {}{}_data = {};", range_of(port.width), name, data);
  // The iteration issued in this clock is not counted yet.
  m.line("  assign {}_room = {}_credits_next > {};", name, name, literal(counter, 1));
  // One place is taken and up to two come back: -1 to 2 places more, a gate a bit, so that one carry chain is enough.
  if (always) {
    m.line("  wire {0}_fewer = valid[1] & ~{0}_left;", name);
    m.line("  wire [{1}:0] {0}_change = {{{{{1}{{{0}_fewer}}}}, valid[1] ^ {0}_left}};", name, counter - 1);
  } else {
    m.line("  wire {0}_fewer = valid[1] & ~{0}_left & ~{0}_skipped;", name);
    m.line("  wire [{1}:0] {0}_change = {{{{{2}{{{0}_fewer}}}}, {0}_fewer | (~valid[1] & {0}_left & {0}_skipped),",
           name, counter - 1, counter - 2);
    m.line("    valid[1] ^ {0}_left ^ {0}_skipped}};", name);
  }
  m.line("  wire [{1}:0] {0}_credits_next = {0}_credits + {0}_change;", name, counter - 1);
  m.line("  always @(posedge clk) begin");
  m.line("    if ({}_push) {}_fifo[{}_in[{}:0]] <= {}_data;", name, name, name, pointer - 1, name);
  m.line("    if ({}_load) {}_word <= {}_fifo[{}_out[{}:0]];", name, name, name, name, pointer - 1);
  m.line("    if ({}_push) {}_in <= {}_in + {};", name, name, name, literal(counter, 1));
  m.line("    if ({0}_load) {0}_out <= {0}_after_out;", name);
  m.line("    if ({0}_load) {0}_after_out <= {0}_after_out + {1};", name, literal(counter, 1));
  m.line("    {0}_waits <= {0}_load ? {0}_holds_another : {0}_holds_one;", name);
  m.line("    {0}_word_there <= {0}_load | ({0}_word_there & ~{1}_ready);", name, end);
  m.line("    {0}_leaves <= {{{0}_leaves[{1}:0], {0}_load}};", name, clocks_to_credits - 2);
  if (!always) m.line("    {}_skipped <= {} & ~({});", name, m.values.valid(stage), pushes);
  m.line("    {}_credits <= {}_credits_next;", name, name);
  m.line("    if (resetting) begin");
  m.line("      {}_word_there <= 1'b0;", name);
  m.line("      {}_in <= {};", name, literal(counter, 0));
  m.line("      {}_out <= {};", name, literal(counter, 0));
  m.line("      {}_after_out <= {};", name, literal(counter, 1));
  m.line("      {}_waits <= 1'b0;", name);
  m.line("      {}_leaves <= {};", name, literal(clocks_to_credits, 0));
  if (!always) m.line("      {}_skipped <= 1'b0;", name);
  m.line("      {}_credits <= {};", name, literal(counter, fifo.depth));
  m.line("    end");
  m.line("  end");
  m.line("  assign {} = {}_there;", signal_name(port, "tvalid"), end);
  for (const dataflow::field& f : port.fields) {
    const std::string bits = f.width == port.width ? end + "_token"
                             : f.width == 1        ? fmt::format("{}_token[{}]", end, f.offset)
                                            : fmt::format("{}_token[{}:{}]", end, f.offset + f.width - 1, f.offset);
    m.line("  assign {} = {};", signal_name(port, f.signal), bits);
  }
}

}  // namespace

void write_credits(module_text& m) {
  for (const output_fifo& f : m.plan.fifos) {
    const unsigned counter = bits_for(f.depth - 1) + 1;
    m.line("  reg [{}:0] {}_credits;  // places of the FIFO that nothing in flight may need", counter - 1,
           m.names.ports[f.port]);
    m.line("  wire {}_room;", m.names.ports[f.port]);
  }
}

void write_inputs(module_text& m) {
  for (std::size_t i = 0; i < m.g.ports.size(); ++i) {
    const dataflow::port& port = m.g.ports[i];
    if (!port.input) continue;
    const std::string& name = m.names.ports[i];
    if (m.is_sampled(port)) {
      write_sampled_arguments(m, name);
      continue;
    }
    // Neither tready nor a clock enable of the tokens hangs on the decision to issue, which is known last of all.
    m.title(fmt::format("input {}: two registers, filled and read in turn", port.name));
    std::string token;
    for (std::size_t f = port.fields.size(); f-- > 0;) {
      if (!token.empty()) token += ", ";
      token += signal_name(port, port.fields[f].signal);
    }
    if (port.fields.size() > 1) token = "{" + token + "}";
    write_buffer(m, name, port.width, token, signal_name(port, "tvalid"),
                 need_register(m, static_cast<dataflow::port_id>(i)).has_value());
    m.line("  assign {} = {}_ready;", signal_name(port, "tready"), name);
  }
}

void write_outputs(module_text& m) {
  if (!m.plan.fifos.empty()) m.title("outputs: a FIFO with room for all iterations in flight");
  for (std::size_t i = 0; i < m.g.ports.size(); ++i) {
    if (m.g.ports[i].input) continue;
    const auto found = std::find_if(m.plan.fifos.begin(), m.plan.fifos.end(),
                                    [&](const output_fifo& f) { return f.port == static_cast<dataflow::port_id>(i); });
    if (found == m.plan.fifos.end()) {
      write_unwritten_output(m, m.g.ports[i]);
    } else {
      write_output(m, m.g.ports[i], m.names.ports[i], *found);
    }
  }
}

}  // namespace epiline::emit
