#include "emit/network_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "emit/fifo.hpp"
#include "emit/network_verilog.hpp"
#include "emit/report_breakdown.hpp"

namespace epiline::emit {

using nlohmann::json;

json make_network_report(const dataflow::network& n, const schedule::delay_model& model,
                         const std::vector<schedule::result>& schedules, const std::vector<json>& passes, bool axi_lite,
                         const std::optional<device_delays>& delays) {
  json processes = json::array();
  double period = 0;
  double estimated = 0;
  double luts = 0;
  std::uint64_t flip_flops = 0;
  unsigned block_rams = 0;
  int interval = 1;
  for (std::size_t i = 0; i < n.processes.size(); ++i) {
    processes.push_back(make_report(n.processes[i], model, schedules[i],
                                    {.delay_lines = {}, .axi_lite = axi_lite, .passes = passes[i], .delays = delays}));
    const json& report = processes.back();
    period = std::max(period, schedules[i].period);
    estimated = std::max(estimated, schedules[i].critical_delay);
    interval = std::max(interval, schedules[i].initiation_interval);
    luts += report["estimate"]["lut4"].get<double>();
    block_rams += report["estimate"]["block_rams"].get<unsigned>();
    flip_flops += report["registers"]["total_bits"].get<std::uint64_t>();
  }
  if (is_single(n)) return processes.front();

  const dataflow::graph outside = outside_of(n);
  json streams = json::array();
  for (const dataflow::fifo& f : n.fifos) {
    const fifo_plan p = plan_fifo(f, model);
    luts += p.luts;
    flip_flops += p.flip_flops;
    block_rams += p.block_rams;
    streams.push_back({{"name", f.name},
                       {"instance", fifo_instance_name(f)},
                       {"width", f.width},
                       {"depth", p.depth},
                       {"peak_fill", nullptr},
                       {"writer", n.processes[find_end(n, f.name, false).process].name},
                       {"reader", n.processes[find_end(n, f.name, true).process].name},
                       {"storage", schedule::name_of(p.storage)},
                       {"lut4", p.luts},
                       {"flip_flops", p.flip_flops},
                       {"block_rams", p.block_rams},
                       {"where", location(outside, f.where)}});
  }
  // Wires are as long as the whole network makes them.
  json slowest = nullptr;
  for (std::size_t i = 0; delays && i < n.processes.size(); ++i) {
    const dataflow::graph& g = n.processes[i];
    const plan p = make_plan(g, model, schedules[i]);
    const design_size size{luts, static_cast<double>(flip_flops)};
    json prediction = to_json(g, predict_clock(g, model, schedules[i], p, *delays, size));
    processes[i]["prediction"] = prediction;
    if (slowest.is_null() || prediction["period_ns"] > slowest["period_ns"]) slowest = std::move(prediction);
  }

  json report;
  report["schema"] = processes.front()["schema"];
  report["schema_version"] = processes.front()["schema_version"];
  report["top"] = n.name;
  report["target"] = model.target();
  report["clock"] = {{"period_ns", period}, {"estimated_period_ns", estimated}};
  report["prediction"] = slowest;
  report["initiation_interval"] = interval;
  report["interface"] = describe_interface(outside, false);
  report["streams"] = streams;
  report["estimate"] = {{"lut4", luts}, {"block_rams", block_rams}};
  report["registers"] = {{"total_bits", flip_flops}};
  report["processes"] = json::array();
  for (std::size_t i = 0; i < processes.size(); ++i)
    report["processes"].push_back({{"called", location(outside, n.called[i])}, {"report", processes[i]}});
  return report;
}

void add_peak_fills(json& report, const std::vector<std::uint64_t>& peak_fills) {
  for (std::size_t i = 0; i < peak_fills.size(); ++i) report["streams"].at(i)["peak_fill"] = peak_fills[i];
}

std::string network_report_text(const json& report) {
  if (!report.contains("processes")) return report_text(report);
  std::string text;
  const auto line = [&]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    text += '\n';
  };
  const auto name = [](const json& j) { return j.get<std::string>(); };
  const auto number = [](const json& j) { return j.get<std::uint64_t>(); };
  line("{}: {} processes side by side, joined by {} streams", name(report["top"]), report["processes"].size(),
       report["streams"].size());
  line("target {}, period {:.2f} ns; slowest chain {:.2f} ns (estimated)", name(report["target"]),
       report["clock"]["period_ns"].get<double>(), report["clock"]["estimated_period_ns"].get<double>());
  if (!report["prediction"].is_null()) line("{}", prediction_text(report["prediction"]));
  line("\nEstimated size: {:.0f} LUT4, {} flip-flops, {} block RAMs", report["estimate"]["lut4"].get<double>(),
       number(report["registers"]["total_bits"]), number(report["estimate"]["block_rams"]));
  line("\nStreams between processes");
  for (const json& stream : report["streams"]) {
    line("  {}: {} x {} bits{}, from {} to {}, {}, {:.0f} LUT4, {} flip-flops, {} block RAMs  {}", name(stream["name"]),
         number(stream["depth"]), number(stream["width"]),
         stream["peak_fill"].is_null() ? "" : fmt::format(" (at most {} held)", number(stream["peak_fill"])),
         name(stream["writer"]), name(stream["reader"]), name(stream["storage"]), stream["lut4"].get<double>(),
         number(stream["flip_flops"]), number(stream["block_rams"]), location_text(stream["where"]));
  }
  for (const json& process : report["processes"]) text += "\n---- process " + report_text(process["report"]);
  return text;
}

}  // namespace epiline::emit
