#include "check/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "check/files.hpp"
#include "emit/interface.hpp"
#include "emit/network_verilog.hpp"

namespace epiline::check {

namespace {

/// Clocks watched for surplus tokens after the last expected one.
constexpr unsigned quiet_clocks = 200;

constexpr const char* head =
    R"(// Written by epiline-hls --check. Drives the module through its streams with random pauses.
`timescale 1ns / 1ns

module epiline_check_bench (
  input wire clk
);
  integer file, pattern, seed;
  reg [8*64-1:0] name;
  reg rst = 1'b1;
  reg [31:0] clocks = 0;  // since reset
  reg [31:0] still = 0;   // clocks since a token moved
  reg [31:0] quiet = 0;   // clocks since the last expected token
  function [31:0] next_random(input [31:0] last);
    reg [31:0] x;
    begin
      x = last ^ (last << 13);
      x = x ^ (x >> 17);
      next_random = x ^ (x << 5);
    end
  endfunction
  function [31:0] share_of(input [31:0] random, input integer kind);
    case (kind)
      0: share_of = 0;
      1: share_of = 50;
      default: share_of = random[9:8] == 0 ? 0 : random[9:8] == 1 ? 25 : random[9:8] == 2 ? 50 : 90;
    endcase
  endfunction
  function [31:0] burst_of(input integer kind);
    burst_of = kind == 2 ? 8 : kind == 3 ? 40 : 1;
  endfunction
)";

/// What every port has: when it pauses.
constexpr const char* pauses = R"(
  // ---- {name}
  reg [31:0] random_{i};
  reg [31:0] share_{i};
  reg [31:0] hold_{i} = 0;
  reg pause_{i} = 1'b0;
  always @(posedge clk) begin
    random_{i} <= next_random(random_{i});
    if (hold_{i} == 0) begin
      pause_{i} <= random_{i}[15:0] % 100 < share_{i};
      hold_{i} <= random_{i}[31:16] % burst_of(pattern);
    end else begin
      hold_{i} <= hold_{i} - 1;
    end
  end
)";

constexpr const char* input_port = R"(  reg [{top}:0] tokens_{i} [0:{last}];
  initial $readmemh("in_{i}.hex", tokens_{i});
  reg [31:0] index_{i} = 0;  // of the token that is offered or comes next
  reg valid_{i} = 1'b0;
  reg [{top}:0] token_{i};
  wire ready_{i};
  wire moves_{i} = valid_{i} && ready_{i} && !rst;
  always @(posedge clk) begin
    if (!rst && ready_{i} !== 1'b0 && ready_{i} !== 1'b1) begin
      $fdisplay(file, "rule {name}: tready is unknown (X) in clock %0d", clocks);
      $finish;
    end
    if (moves_{i}) index_{i} <= index_{i} + 1;
    if (!valid_{i} || moves_{i}) begin
      // Nobody may look at what is not offered.
      valid_{i} <= index_{i} + moves_{i} < {count} && !pause_{i} && !rst;
      token_{i} <= index_{i} + moves_{i} < {count} && !pause_{i} ? tokens_{i}[index_{i} + moves_{i}] : {width}'bx;
    end
  end
)";

constexpr const char* output_port = R"(  reg ready_{i} = 1'b0;
  wire valid_{i};
  wire [{top}:0] token_{i};
  wire moves_{i} = valid_{i} && ready_{i} && !rst;
  reg [31:0] count_{i} = 0;
  reg waits_{i} = 1'b0;
  reg [{top}:0] waiting_{i};
  always @(posedge clk) begin
    ready_{i} <= !pause_{i} && !rst && (pattern != 3 || (valid_{i} && !ready_{i}));
    waits_{i} <= valid_{i} && !ready_{i} && !rst;
    waiting_{i} <= token_{i};
    if (!rst && valid_{i} !== 1'b0 && valid_{i} !== 1'b1) begin
      $fdisplay(file, "rule {name}: tvalid is unknown (X) in clock %0d", clocks);
      $finish;
    end
    if (!rst && waits_{i} && !valid_{i}) begin
      $fdisplay(file, "rule {name}: tvalid is withdrawn before tready in clock %0d", clocks);
      $finish;
    end
    if (!rst && waits_{i} && token_{i} !== waiting_{i}) begin
      $fdisplay(file, "rule {name}: the token changes while it waits for tready in clock %0d", clocks);
      $finish;
    end
    if (moves_{i}) begin
      $fdisplay(file, "out {i} %h", token_{i});
      count_{i} <= count_{i} + 1;
    end
  end
)";

constexpr const char* tail = R"(
  wire moves = {moves};
  wire complete = {complete};
  initial begin
    if (!$value$plusargs("pattern=%d", pattern)) pattern = 0;
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("out=%s", name)) name = "bench.out";
    file = $fopen(name, "w");
{start}  end
  always @(posedge clk) begin
    rst <= clocks < 4 && rst;
    clocks <= clocks + 1;
    still <= moves ? 0 : still + 1;
    quiet <= complete ? quiet + 1 : 0;
    if (quiet == {quiet} || still == {patience}) begin
{peaks}      $fdisplay(file, "clocks %0d", clocks - still);
      $fclose(file);
      $finish;
    end
  end
endmodule

module epiline_check_clock;
  reg clk = 1'b0;
  always #1 clk = !clk;
  epiline_check_bench bench (.clk(clk));
endmodule
)";

}  // namespace

const char* pattern_name(unsigned pattern) {
  static constexpr const char* names[bench_patterns] = {"without pauses", "with 50 % pauses everywhere",
                                                        "with random pauses", "with random pauses, ready after valid"};
  return names[pattern];
}

std::string bench_text(const dataflow::network& n, const reference& wanted, std::uint64_t patience, bool sees_fifos) {
  using namespace fmt::literals;
  const std::vector<emit::rtl_port> ports = emit::interface_of(emit::outside_of(n), false);
  std::string text = head;
  std::string connections = ".clk(clk), .rst(rst)", moves, complete, start;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const emit::rtl_port& port = ports[i];
    const std::size_t count = wanted.inputs[i].size();
    text += fmt::format(fmt::runtime(pauses), "name"_a = port.name, "i"_a = i);
    text += fmt::format(fmt::runtime(port.input ? input_port : output_port), "name"_a = port.name, "i"_a = i,
                        "top"_a = port.width - 1, "width"_a = port.width, "last"_a = count == 0 ? 0 : count - 1,
                        "count"_a = count);
    for (const emit::rtl_field& field : port.fields)
      connections +=
          fmt::format(",\n    .{}(token_{}[{}:{}])", field.rtl, i, field.offset + field.width - 1, field.offset);
    connections += fmt::format(",\n    .{}(valid_{}),\n    .{}(ready_{})", port.valid, i, port.ready, i);
    start += fmt::format(
        "    random_{0} = next_random(next_random((seed * 40503 + {0} * 7919) | 1));\n"
        "    share_{0} = share_of(random_{0}, pattern);\n",
        i);
    moves += fmt::format("{}moves_{}", moves.empty() ? "" : " || ", i);
    if (!port.input) complete += fmt::format("{}count_{} >= {}", complete.empty() ? "" : " && ", i, wanted.at_least[i]);
  }
  std::string peaks;
  for (std::size_t i = 0; sees_fifos && i < n.fifos.size(); ++i)
    peaks +=
        fmt::format("      $fdisplay(file, \"fifo {} %0d\", dut.{}.peak);\n", i, emit::fifo_instance_name(n.fifos[i]));
  text += fmt::format("\n  {} dut (\n    {}\n  );\n", n.name, connections);
  text += fmt::format(fmt::runtime(tail), "start"_a = start, "moves"_a = moves, "complete"_a = complete,
                      "quiet"_a = wanted.may_give_more ? 1 : quiet_clocks, "patience"_a = patience, "peaks"_a = peaks);
  return text;
}

void write_inputs(const std::filesystem::path& folder, const dataflow::network& n, const reference& wanted) {
  for (dataflow::port_id id = 0; id < n.ports.size(); ++id) {
    if (!n.ports[id].input) continue;
    std::string text;
    for (const llvm::APInt& token : wanted.inputs[id]) text += to_hexadecimal(token) + '\n';
    if (text.empty()) text = "0\n";  // an empty file is a warning
    write_file(folder / fmt::format("in_{}.hex", id), text);
  }
}

bench_answer read_bench_answer(const std::filesystem::path& file, const dataflow::network& n) {
  bench_answer result;
  result.outputs.resize(n.ports.size());
  std::ifstream in(file);
  bool is_complete = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word, digits;
    words >> word;
    if (word == "rule") {
      result.problem = line.substr(5);
      return result;
    }
    if (word == "fifo") {
      std::size_t number = 0;
      std::uint64_t peak = 0;
      words >> number >> peak;
      if (!words || number != result.peak_fills.size()) break;
      result.peak_fills.push_back(peak);
    }
    if (word == "clocks") is_complete = static_cast<bool>(words >> result.clocks);
    if (word != "out") continue;
    dataflow::port_id port = 0;
    words >> port >> digits;
    if (!words || port >= n.ports.size()) break;
    if (digits.find_first_of("xXzZ") != std::string::npos) {
      result.problem = fmt::format("output '{}': token {} is {}, which has bits that are not known (X)",
                                   n.ports[port].name, result.outputs[port].size(), digits);
      return result;
    }
    std::optional<llvm::APInt> token = from_hexadecimal(digits, n.ports[port].width);
    if (!token) break;
    result.outputs[port].push_back(std::move(*token));
  }
  if (!is_complete) throw std::runtime_error("the simulation ended before its end");
  return result;
}

}  // namespace epiline::check
