// The AXI4-Lite slave in front of a top's scalar arguments, as Verilog.

#include <fmt/format.h>

#include <algorithm>

#include "emit/register_map.hpp"
#include "emit/text.hpp"

namespace epiline::emit {

namespace {

/// Bits [low, low + width) of a signal of `whole` bits.
std::string part(const std::string& signal, unsigned whole, unsigned low, unsigned width) {
  if (width == whole) return signal;
  return width == 1 ? fmt::format("{}[{}]", signal, low) : fmt::format("{}[{}:{}]", signal, low + width - 1, low);
}

class slave_writer {
 public:
  explicit slave_writer(const register_map& map) : map_(map), index_bits_(map.address_bits - 2) {}

  std::string write() {
    write_interface();
    write_registers();
    line("\n  // ---- writes: address and data wait here until both are there and the response has a place ----");
    line("  wire write;");
    write_channel("aw", "write", {{"write_word", index_bits_, index("s_axi_awaddr")}});
    write_channel("w", "write",
                  {{"write_data", axi_data_bits, "s_axi_wdata"}, {"write_strobe", axi_data_bits / 8, "s_axi_wstrb"}});
    write_writes();
    line("\n  // ---- reads: an address waits here until its data has a place ----");
    line("  wire read;");
    write_channel("ar", "read", {{"read_word", index_bits_, index("s_axi_araddr")}});
    write_reads();
    line("\nendmodule");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += '\n';
  }

  [[nodiscard]] std::string index(const char* address) const {
    return fmt::format("{}[{}:2]", address, map_.address_bits - 1);
  }
  [[nodiscard]] std::string word_literal(unsigned address) const {
    return fmt::format("{}'d{}", index_bits_, address / (axi_data_bits / 8));
  }
  static std::string register_name(const argument_register& argument) { return "argument_" + argument.name; }

  void write_interface() {
    line("// The scalar arguments of {}{} behind an AXI4-Lite slave. Addresses and data may come in any order; every",
         map_.top, map_.place.empty() ? "" : " (" + map_.place + ")");
    line(
        "// output comes from a flip-flop. Addresses are in words here; the low two bits of a byte address are not "
        "looked at.");
    line("/* verilator lint_off DECLFILENAME */");
    line("module {} (", map_.module());
    line("  input  wire clk,");
    line("  input  wire rst,");
    line("  input  wire {}s_axi_awaddr,", range_of(map_.address_bits));
    line("  input  wire s_axi_awvalid,");
    line("  output reg  s_axi_awready,");
    line("  input  wire [31:0] s_axi_wdata,");
    line("  input  wire [3:0] s_axi_wstrb,");
    line("  input  wire s_axi_wvalid,");
    line("  output reg  s_axi_wready,");
    line("  output reg  [1:0] s_axi_bresp,");
    line("  output reg  s_axi_bvalid,");
    line("  input  wire s_axi_bready,");
    line("  input  wire {}s_axi_araddr,", range_of(map_.address_bits));
    line("  input  wire s_axi_arvalid,");
    line("  output reg  s_axi_arready,");
    line("  output reg  [31:0] s_axi_rdata,");
    line("  output reg  [1:0] s_axi_rresp,");
    line("  output reg  s_axi_rvalid,");
    line("  input  wire s_axi_rready,");
    line("  input  wire started,      // a call samples the arguments in this clock");
    line("  output reg  start,        // the next call starts whether its input is there or not");
    line("  output reg  hold,         // no call starts by itself");
    line("  output reg  keep,         // calls keep the arguments of the call before");
    line("  output wire {}arguments   // first parameter in the low bits", range_of(map_.argument_bits));
    line(");");
    line("  localparam [1:0] okay = 2'b00, slave_error = 2'b10;");
  }

  void write_registers() {
    line("\n  // ---- registers ----");
    line("  reg [31:0] calls;  // started since reset");
    std::string all;
    for (const argument_register& argument : map_.arguments) {
      line("  reg {}{};", range_of(argument.width), register_name(argument));
      all = register_name(argument) + (all.empty() ? "" : ", ") + all;
    }
    line("  assign arguments = {};", map_.arguments.size() == 1 ? all : "{" + all + "}");
  }

  struct held_signal {
    const char* name;
    unsigned width;
    std::string source;
  };

  /// A channel from the master: one transfer is held until the clock of `use`.
  void write_channel(const char* channel, const char* use, const std::vector<held_signal>& held) {
    for (const held_signal& signal : held) line("  reg {}{};", range_of(signal.width), signal.name);
    line("  reg {}_there;", channel);
    line("  wire {0}_waits = (s_axi_{0}valid & s_axi_{0}ready) | ({0}_there & ~{1});", channel, use);
    line("  always @(posedge clk) begin");
    for (const held_signal& signal : held)
      line("    if (s_axi_{}ready) {} <= {};", channel, signal.name, signal.source);
    line("    {0}_there <= {0}_waits & ~rst;", channel);
    line("    s_axi_{0}ready <= ~{0}_waits & ~rst;", channel);
    line("  end");
  }

  void write_writes() {
    line("  assign write = aw_there & w_there & (~s_axi_bvalid | s_axi_bready);");
    line("  always @(posedge clk) begin");
    line("    s_axi_bvalid <= write | (s_axi_bvalid & ~s_axi_bready);");
    line("    calls <= calls + {{31'd0, started}};");
    line("    if (started) start <= 1'b0;");
    line("    if (write) begin");
    line("      s_axi_bresp <= okay;");
    line("      case (write_word)");
    line("        {}: if (write_strobe[0]) begin", word_literal(control_address));
    line("          if (write_data[{}]) start <= 1'b1;", start_bit);
    line("          hold <= write_data[{}];", hold_bit);
    line("          keep <= write_data[{}];", keep_bit);
    line("        end");
    for (const argument_register& argument : map_.arguments) {
      for (unsigned word = 0; word < argument.words; ++word) write_word(argument, word);
    }
    line("        default: s_axi_bresp <= slave_error;");
    line("      endcase");
    line("    end");
    line("    if (rst) begin");
    line("      s_axi_bvalid <= 1'b0;");
    line("      calls <= 32'd0;");
    line("      start <= 1'b0;");
    line("      hold <= 1'b0;");
    line("      keep <= 1'b0;");
    for (const argument_register& argument : map_.arguments) {
      line("      {} <= {}'d0;", register_name(argument), argument.width);
    }
    line("    end");
    line("  end");
  }

  void write_word(const argument_register& argument, unsigned word) {
    line("        {}: begin", word_literal(argument.address + word * (axi_data_bits / 8)));
    for (unsigned low = 0; low < axi_data_bits && word * axi_data_bits + low < argument.width; low += 8) {
      const unsigned bits = std::min(8u, argument.width - word * axi_data_bits - low);
      line("          if (write_strobe[{}]) {} <= {};", low / 8,
           part(register_name(argument), argument.width, word * axi_data_bits + low, bits),
           part("write_data", axi_data_bits, low, bits));
    }
    line("        end");
  }

  void write_reads() {
    line("  assign read = ar_there & (~s_axi_rvalid | s_axi_rready);");
    line("  always @(posedge clk) begin");
    line("    s_axi_rvalid <= (read | (s_axi_rvalid & ~s_axi_rready)) & ~rst;");
    line("    if (read) begin");
    line("      s_axi_rresp <= okay;");
    line("      case (read_word)");
    static_assert(start_bit == 0 && hold_bit == 1 && keep_bit == 2 && control_bits == 3, "the order below");
    line("        {}: s_axi_rdata <= {{29'd0, keep, hold, start}};", word_literal(control_address));
    line("        {}: s_axi_rdata <= calls;", word_literal(calls_address));
    for (const argument_register& argument : map_.arguments) {
      for (unsigned word = 0; word < argument.words; ++word) {
        line("        {}: s_axi_rdata <= {};", word_literal(argument.address + word * (axi_data_bits / 8)),
             read_value(argument, word));
      }
    }
    line("        default: begin");
    line("          s_axi_rdata <= 32'd0;");
    line("          s_axi_rresp <= slave_error;");
    line("        end");
    line("      endcase");
    line("    end");
    line("  end");
  }

  static std::string read_value(const argument_register& argument, unsigned word) {
    const std::string name = register_name(argument);
    const unsigned low = word * axi_data_bits;
    const unsigned bits = std::min(axi_data_bits, argument.width - low);
    const std::string value = part(name, argument.width, low, bits);
    if (bits == axi_data_bits) return value;
    const std::string sign = part(name, argument.width, argument.width - 1, 1);
    return argument.is_signed ? fmt::format("{{{{{}{{{}}}}}, {}}}", axi_data_bits - bits, sign, value)
                              : fmt::format("{{{}'d0, {}}}", axi_data_bits - bits, value);
  }

  const register_map& map_;
  unsigned index_bits_;
  std::string out_;
};

}  // namespace

std::string emit_axi_lite_slave(const register_map& map) { return slave_writer(map).write(); }

}  // namespace epiline::emit
