#include "emit/network_verilog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <unordered_set>

#include "emit/fifo.hpp"
#include "emit/interface.hpp"
#include "emit/names.hpp"
#include "emit/text.hpp"

namespace epiline::emit {

using dataflow::fifo;
using dataflow::graph;
using dataflow::network;
using dataflow::port;
using dataflow::port_kind;

namespace {

class network_writer {
 public:
  network_writer(const network& n, const schedule::delay_model& model, const std::vector<schedule::result>& schedules,
                 const verilog_options& options)
      : n_(n),
        model_(model),
        schedules_(schedules),
        options_(options),
        outside_(outside_of(n)),
        interface_(interface_of(outside_, false)) {}

  verilog_text write() {
    reserve_signals(outside_, interface_, taken_);
    for (const graph& g : n_.processes) taken_.insert(g.name);
    for (const fifo& f : n_.fifos) taken_.insert(fifo_instance_name(f));  // testbenches look for it
    write_heading();
    out_ += module_head(outside_, interface_);
    for (const fifo& f : n_.fifos) write_fifo(f);
    write_calls();
    for (const graph& g : n_.processes) write_process(g);
    line("\nendmodule");
    line("\n/* verilator lint_off DECLFILENAME */");
    std::vector<module_signals> modules = {{n_.name, n_.files, signals()}};
    for (std::size_t i = 0; i < n_.processes.size(); ++i) {
      verilog_text process = emit_module(n_.processes[i], model_, schedules_[i], options_);
      out_ += "\n" + process.text;
      modules.push_back(std::move(process.modules.front()));
    }
    line("/* verilator lint_on DECLFILENAME */");
    line("`default_nettype none");
    std::set<schedule::storage_kind> used;
    for (const fifo& f : n_.fifos) used.insert(plan_fifo(f, model_).storage);
    for (const schedule::storage_kind storage : used) line("{}", fifo_module(storage));
    line("`default_nettype wire");
    return {std::move(out_), std::move(modules)};
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += '\n';
  }

  std::string fresh(const std::string& wanted) {
    std::string name = wanted;
    for (unsigned number = 2; is_keyword(name) || !taken_.insert(name).second; ++number)
      name = fmt::format("{}_{}", wanted, number);
    return name;
  }

  [[nodiscard]] std::string comment(dataflow::source_location where) const {
    const std::string place = place_text(outside_, where);
    return place.empty() ? "" : "  // " + place;
  }

  void write_heading() {
    line("// {}: made by epiline-hls.", n_.name);
    line("// {} processes that run side by side, joined by {} FIFO{}; target {}.", n_.processes.size(), n_.fifos.size(),
         n_.fifos.size() == 1 ? "" : "s", model_.target());
    line("//");
    line("// A call is accepted when every process that wants to know of it can take it.");
    line("// UNUSED is waived because a scalar may be used by no process.");
    line("/* verilator lint_off UNUSED */");
    line("`default_nettype none");
    line("");
  }

  /// The wires of one end of a FIFO: of the writer's output or of the reader's input.
  struct end_wires {
    std::string data, valid, ready;
  };

  void write_fifo(const fifo& f) {
    const fifo_plan p = plan_fifo(f, model_);
    line("\n  // ---- stream {}, {} deep ----{}", f.name, p.depth, comment(f.where));
    const auto make_end = [&](const char* side) {
      end_wires wires{fresh(fmt::format("{}_{}_tdata", f.name, side)), fresh(fmt::format("{}_{}_tvalid", f.name, side)),
                      fresh(fmt::format("{}_{}_tready", f.name, side))};
      line("  wire {}{};", range_of(f.width), wires.data);
      line("  wire {}, {};", wires.valid, wires.ready);
      return wires;
    };
    const end_wires in = make_end("in");
    const end_wires out = make_end("out");
    line("  {} #(.WIDTH({}), .DEPTH({}), .POINTER({}), .LAST({}'d{})) {} (", fifo_module_name(p.storage), f.width,
         p.depth, p.pointer_bits, p.pointer_bits, p.depth - 1, fifo_instance_name(f));
    line("    .clk(clk), .rst(rst),");
    line("    .in_tdata({}), .in_tvalid({}), .in_tready({}),", in.data, in.valid, in.ready);
    line("    .out_tdata({}), .out_tvalid({}), .out_tready({})", out.data, out.valid, out.ready);
    line("  );");
    ends_.push_back({in, out});
  }

  void write_calls() {
    const auto call = std::find_if(outside_.ports.begin(), outside_.ports.end(),
                                   [](const port& p) { return p.kind == port_kind::call; });
    if (call == outside_.ports.end()) return;
    line("\n  // ---- calls ----{}", comment(call->where));
    std::string all;
    for (const graph& g : n_.processes) {
      const bool takes =
          std::any_of(g.ports.begin(), g.ports.end(), [](const port& p) { return p.kind == port_kind::call; });
      call_ready_.push_back(takes ? fresh(g.name + "_call_tready") : "");
      if (!takes) continue;
      line("  wire {};", call_ready_.back());
      all += (all.empty() ? "" : " & ") + call_ready_.back();
    }
    line("  assign call_tready = {};", all);
    call_accepted_ = fresh("call_accepted");
    line("  wire {} = call_tvalid & call_tready;", call_accepted_);
  }

  void write_process(const graph& g) {
    const std::size_t index = static_cast<std::size_t>(&g - n_.processes.data());
    line("\n  // ---- process {} ----{}", g.name, comment(n_.called[index]));
    process_names_.push_back(fresh(g.name + "_process"));
    std::string text = fmt::format("  {} {} (\n    .clk(clk), .rst(rst)", g.name, process_names_.back());
    const auto connect = [&](const std::string& own, const std::string& wire) {
      fmt::format_to(std::back_inserter(text), ",\n    .{}({})", own, wire);
    };
    for (const port& p : g.ports) {
      const auto joint =
          std::find_if(n_.fifos.begin(), n_.fifos.end(), [&](const fifo& f) { return f.name == p.name; });
      const bool inner = p.kind == port_kind::stream && joint != n_.fifos.end();
      const std::string valid = signal_name(p, "tvalid");
      const std::string ready = signal_name(p, "tready");
      if (inner) {
        const auto& [in, out] = ends_[static_cast<std::size_t>(joint - n_.fifos.begin())];
        const end_wires& wires = p.input ? out : in;
        for (const dataflow::field& f : p.fields) {
          const std::string bits = p.width == f.width ? wires.data
                                   : f.width == 1
                                       ? fmt::format("{}[{}]", wires.data, f.offset)
                                       : fmt::format("{}[{}:{}]", wires.data, f.offset + f.width - 1, f.offset);
          connect(signal_name(p, f.signal), bits);
        }
        connect(valid, wires.valid);
        connect(ready, wires.ready);
      } else if (p.kind == port_kind::call) {
        for (const dataflow::field& f : p.fields) connect(signal_name(p, f.signal), f.signal);
        connect(valid, call_accepted_);
        connect(ready, call_ready_[index]);
      } else {
        for (const dataflow::field& f : p.fields) connect(signal_name(p, f.signal), signal_name(p, f.signal));
        connect(valid, valid);
        connect(ready, ready);
      }
    }
    line("{}\n  );", text);
  }

  /// What the names of the top module come from.
  [[nodiscard]] std::vector<signal> signals() const {
    std::vector<signal> all = interface_signals(n_.name, interface_);
    for (std::size_t i = 0; i < n_.fifos.size(); ++i) {
      const fifo& f = n_.fifos[i];
      const auto add = [&](const end_wires& wires, const char* side) {
        const std::string what = fmt::format("{} of the stream '{}'", side, f.name);
        all.push_back({wires.data, "FIFO", what, f.width, -1, {f.where}});
        all.push_back({wires.valid, "FIFO", what, 1, -1, {f.where}});
        all.push_back({wires.ready, "FIFO", what, 1, -1, {f.where}});
      };
      add(ends_[i].first, "the writer's end");
      add(ends_[i].second, "the reader's end");
      all.push_back({fifo_instance_name(f), "FIFO", "the instance of '" + f.name + "'", f.width, -1, {f.where}});
    }
    for (std::size_t i = 0; i < n_.processes.size(); ++i) {
      const std::string what = "the process '" + n_.processes[i].name + "'";
      all.push_back({n_.processes[i].name, "control", what, 0, -1, {n_.called[i]}});
      all.push_back({process_names_[i], "control", "the instance of " + what, 0, -1, {n_.called[i]}});
      if (i < call_ready_.size() && !call_ready_[i].empty())
        all.push_back({call_ready_[i], "control", "1 when " + what + " can take a call", 1, -1, {}});
    }
    if (!call_accepted_.empty())
      all.push_back({call_accepted_, "control", "1 when all processes take a call", 1, -1, {}});
    return all;
  }

  const network& n_;
  const schedule::delay_model& model_;
  const std::vector<schedule::result>& schedules_;
  const verilog_options& options_;
  const graph outside_;
  const std::vector<rtl_port> interface_;
  std::string out_;
  std::unordered_set<std::string> taken_;
  std::vector<std::pair<end_wires, end_wires>> ends_;  // of the FIFOs, in order
  std::vector<std::string> call_ready_;                // by process; empty without a call port
  std::string call_accepted_;
  std::vector<std::string> process_names_;
};

}  // namespace

dataflow::graph outside_of(const network& n) {
  graph g;
  g.name = n.name;
  g.files = n.files;
  g.ports = n.ports;
  return g;
}

std::string fifo_instance_name(const fifo& f) { return f.name + "_fifo"; }

verilog_text emit_network(const network& n, const schedule::delay_model& model,
                          const std::vector<schedule::result>& schedules, const verilog_options& options) {
  if (is_single(n)) return emit_module(n.processes.front(), model, schedules.front(), options);
  return network_writer(n, model, schedules, options).write();
}

}  // namespace epiline::emit
