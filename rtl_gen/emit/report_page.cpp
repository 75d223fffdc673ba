#include "emit/report_page.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace epiline::emit {

using nlohmann::json;

namespace {

constexpr const char* style = R"(
:root{color-scheme:light dark;--page:#fff;--text:#1b1f24;--soft:#5b6570;--line:#d8dde3;--card:#f4f6f8;--mark:#b3261e;
--mark-back:#fdecea;--bar:#3b6ea8;--heat:214,92,20}
@media (prefers-color-scheme:dark){:root{--page:#14171a;--text:#e4e7ea;--soft:#98a2ad;--line:#333a41;--card:#1d2226;
--mark:#ff8a80;--mark-back:#3b1f1d;--bar:#7fb0e6;--heat:230,120,50}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1rem;max-width:80rem;background:var(--page);color:var(--text);
font:16px/1.5 system-ui,sans-serif}
h1{margin:0 0 .2rem;font-size:1.6rem;overflow-wrap:anywhere}
h2{margin:2rem 0 .5rem;font-size:1.2rem;border-bottom:1px solid var(--line)}
p{margin:.4rem 0}
a{color:inherit;text-decoration-color:var(--soft)}
.soft{color:var(--soft)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(9rem,1fr));gap:.6rem;margin:1rem 0}
.tiles div{background:var(--card);border-radius:.4rem;padding:.6rem .8rem}
.tiles b{display:block;font-size:1.3rem}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.9rem}
td,th{padding:.1rem .5rem;text-align:left;vertical-align:top;white-space:nowrap}
th{color:var(--soft);font-weight:normal;border-bottom:1px solid var(--line)}
.n{text-align:right;font-variant-numeric:tabular-nums}
.code{width:100%;font-size:.8rem}
.code td{padding:0 .5rem;line-height:1.45}
.code td:last-child,code{font-family:ui-monospace,monospace;white-space:pre}
.way{min-width:10rem;background:var(--card)}
.way i,.bar i{display:block;height:.6rem;margin-top:.25rem;min-width:2px;background:var(--bar);border-radius:1px}
.bar{min-width:8rem}
.chain td{background:var(--mark-back)}
.chain td:first-child{box-shadow:inset 3px 0 var(--mark)}
.limit{border-left:3px solid var(--mark);padding:.3rem .8rem;background:var(--mark-back)}
summary{cursor:pointer;margin:.5rem 0}
:target td{outline:1px solid var(--mark)}
)";

std::string escaped(std::string_view text) {
  std::string printable;  // control characters are not text of a page
  std::copy_if(text.begin(), text.end(), std::back_inserter(printable),
               [](char c) { return static_cast<unsigned char>(c) >= 0x20 || c == '\t'; });
  std::string result;
  llvm::raw_string_ostream out(result);
  llvm::printHTMLEscaped(printable, out);
  return result;
}

std::uint64_t whole(const json& j) { return j.get<std::uint64_t>(); }
std::string text_of(const json& j) { return escaped(j.get<std::string>()); }

std::string head_of(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{} - epiline-hls</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
      title, style, title);
}

constexpr const char* foot = "</body>\n</html>\n";

class page {
 public:
  /// `prefix` makes the lines' anchors differ from those of other pipelines on the same page.
  page(const json& report, const std::map<std::string, std::string>& sources, std::string prefix = "")
      : report_(report), sources_(sources), prefix_(std::move(prefix)) {
    for (const json& line : report["lines"]) {
      by_place_[place_of(line["where"])] = &line;
      number_of(line["where"]["file"]);
    }
    for (const json& link : report["critical_chain"]["links"]) chain_.insert(place_of(link["where"]));
    chain_.erase(place());
  }

  /// What stands below the heading.
  std::string write() {
    write_summary();
    write_limit();
    write_sources();
    write_schedule();
    write_variables();
    write_memories();
    write_ports();
    return std::move(out_);
  }

 private:
  using place = std::pair<std::string, unsigned>;

  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
  }

  static place place_of(const json& where) {
    return where.is_null() ? place() : place(where["file"].get<std::string>(), where["line"].get<unsigned>());
  }

  std::size_t number_of(const json& file) {
    return files_.try_emplace(file.get<std::string>(), files_.size()).first->second;
  }

  /// "file.cpp:12", a link when the line is on this page.
  std::string link(const json& where) {
    if (where.is_null()) return "<span class=\"soft\">unknown line</span>";
    const auto [file, line] = place_of(where);
    const std::string name = file.substr(file.rfind('/') + 1);
    if (sources_.count(file) == 0 || files_.count(file) == 0) return escaped(fmt::format("{}:{}", name, line));
    return fmt::format("<a href=\"#{}f{}l{}\">{}:{}</a>", prefix_, files_.at(file), line, escaped(name), line);
  }

  void begin_table(std::initializer_list<const char*> heads) {
    put("<div class=\"wide\"><table>\n<tr>");
    for (const std::string_view head : heads)  // a leading '#': numbers
      put("<th{}>{}</th>", head.starts_with('#') ? " class=\"n\"" : "", head.substr(head.starts_with('#') ? 1 : 0));
    put("</tr>\n");
  }
  void end_table() { put("</table></div>\n"); }

  void write_summary() {
    const double period = report_["clock"]["period_ns"];
    put("<p class=\"soft\">{}, {:.2f} ns ({:.1f} MHz), {} stages, one iteration every {}</p>\n",
        text_of(report_["target"]), period, 1000 / period, whole(report_["depth"]),
        report_["initiation_interval"] == 1 ? "clock"
                                            : fmt::format("{} clocks", whole(report_["initiation_interval"])));
    put("<div class=\"tiles\">");
    const auto tile = [&](const std::string& number, const char* unit) { put("<div><b>{}</b>{}</div>", number, unit); };
    tile(fmt::format("{:.0f}", report_["estimate"]["lut4"].get<double>()), "LUT4 (estimated)");
    tile(fmt::format("{}", whole(report_["registers"]["total_bits"])), "flip-flops");
    tile(fmt::format("{}", whole(report_["estimate"]["block_rams"])), "block RAMs");
    std::uint64_t latency = 0;
    for (const auto& [port, clocks] : report_["latency_clocks"].items()) latency = std::max(latency, whole(clocks));
    tile(fmt::format("{}", latency), "clocks from input to output");
    put("</div>\n");
  }

  void write_limit() {
    put("<h2>What limits the speed</h2>\n<p class=\"limit\">{}<br>{}</p>\n", text_of(report_["limit"]["text"]),
        text_of(report_["limit"]["suggestion"]));
    const json& chain = report_["critical_chain"];
    const double total = std::max(0.01, chain["delay_ns"].get<double>());
    put("<p>The slowest chain, {:.2f} ns from clock to clock:</p>\n", chain["delay_ns"].get<double>());
    begin_table({"#ns", "", "#stage", "operation", "#bits", "name", "source"});
    for (const json& one : chain["links"]) {
      const double delay = one["delay_ns"];
      put("<tr class=\"chain\"><td class=\"n\">{:.2f}</td><td class=\"bar\"><i style=\"width:{:.0f}%\"></i></td>"
          "<td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
          delay, 100 * delay / total, one["stage"].get<int>() < 0 ? "-" : std::to_string(one["stage"].get<int>()),
          text_of(one["operation"]), whole(one["width"]), text_of(one["name"]), link(one["where"]));
    }
    end_table();
  }

  /// Where in the pipeline a line works, as a bar from its first to its last stage.
  std::string way_of(const json& line) const {
    if (line["stages"].empty()) return "";
    const int first = line["stages"].front()["stage"];
    const int last = line["stages"].back()["stage"];
    const double depth = std::max(1.0, report_["depth"].get<double>());
    return fmt::format("<i style=\"margin-left:{:.1f}%;width:{:.1f}%\" title=\"stages {} to {}\"></i>",
                       100 * first / depth, 100 * (last - first + 1) / depth, first, last);
  }

  void write_sources() {
    put("<h2>Source lines</h2>\n<p class=\"soft\">LUT4 and waiting flip-flops a line, and the stages it works in, "
        "first "
        "to last from left to right. Lines of the slowest chain are marked.</p>\n");
    double costliest = 1;
    for (const json& line : report_["lines"]) costliest = std::max(costliest, line["luts"].get<double>());
    std::vector<std::pair<double, std::string>> order;  // the costliest file first
    for (const auto& [file, number] : files_) {
      double luts = 0;
      for (const auto& [at, line] : by_place_)
        if (at.first == file) luts += (*line)["luts"].get<double>();
      order.emplace_back(-luts, file);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [luts, file] : order) {
      const auto source = sources_.find(file);
      put("<details{}><summary>{} <span class=\"soft\">{:.0f} LUT4</span></summary>\n<div class=\"wide\">"
          "<table class=\"code\">\n<tr><th class=\"n\">line</th><th class=\"n\">LUT4</th><th class=\"n\">bits</th>"
          "<th>stages</th><th></th></tr>\n",
          &order.front().second == &file ? " open" : "", escaped(file), -luts);
      if (source == sources_.end())
        write_known_lines(file, costliest);
      else
        write_source(file, source->second, costliest);
      put("</table></div></details>\n");
    }
  }

  void write_known_lines(const std::string& file, double costliest) {
    for (const auto& [at, line] : by_place_)
      if (at.first == file) write_line(file, at.second, "", costliest);
  }

  void write_source(const std::string& file, std::string_view text, double costliest) {
    for (unsigned number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      write_line(file, number, text.substr(0, end), costliest);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  void write_line(const std::string& file, unsigned number, std::string_view code, double costliest) {
    const auto found = by_place_.find({file, number});
    put("<tr id=\"{}f{}l{}\"{}><td class=\"n\">{}</td>", prefix_, files_.at(file), number,
        chain_.count({file, number}) != 0 ? " class=\"chain\"" : "", number);
    if (found == by_place_.end()) {
      put("<td></td><td></td><td></td>");
    } else {
      const json& line = *found->second;
      const double luts = line["luts"];
      // The root makes cheap lines visible beside costly ones.
      put("<td class=\"n\" style=\"background:rgba(var(--heat),{:.2f})\">{}</td><td class=\"n\">{}</td>"
          "<td class=\"way\">{}</td>",
          0.8 * std::sqrt(luts / costliest), luts > 0 ? fmt::format("{:.0f}", luts) : "",
          line["waiting_bits"] == 0 ? "" : std::to_string(whole(line["waiting_bits"])), way_of(line));
    }
    put("<td>{}</td></tr>\n", escaped(code));
  }

  void write_schedule() {
    std::vector<std::vector<std::pair<const json*, const json*>>> at(whole(report_["depth"]));  // line, operations
    for (const json& line : report_["lines"])
      for (const json& stage : line["stages"])
        at.at(whole(stage["stage"])).emplace_back(&line["where"], &stage["operations"]);
    put("<h2>Schedule</h2>\n<p class=\"soft\">What happens in each stage, one clock after the other.</p>\n");
    begin_table({"#stage", "#register bits", "operations by source line"});
    for (const json& stage : report_["stages"]) {
      put("<tr><td class=\"n\">{}</td><td class=\"n\">{}</td><td style=\"white-space:normal\">", whole(stage["stage"]),
          whole(stage["register_bits"]));
      bool first = true;
      for (const auto& [where, operations] : at[whole(stage["stage"])]) {
        std::string list;
        for (const auto& [name, count] : operations->items())
          list += fmt::format("{}{} {}", list.empty() ? "" : ", ", whole(count), escaped(name));
        put("{}{}: {}", first ? "" : "; ", link(*where), list);
        first = false;
      }
      put("</td></tr>\n");
    }
    end_table();
  }

  void write_variables() {
    constexpr std::size_t most = 200;
    put("<h2>Variables</h2>\n<p class=\"soft\">Flip-flops that hold state from one iteration to the next, flip-flops "
        "in "
        "which values wait for later stages, and bits of RAM.</p>\n");
    begin_table({"variable", "#state", "#waiting", "#RAM bits", "source"});
    const json& variables = report_["variables"];
    for (std::size_t i = 0; i < std::min(most, variables.size()); ++i) {
      const json& v = variables[i];
      put("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
          v["name"] == "" ? "<span class=\"soft\">(no name)</span>" : text_of(v["name"]), whole(v["state_bits"]),
          whole(v["waiting_bits"]), whole(v["memory_bits"]), link(v["where"]));
    }
    end_table();
    if (variables.size() > most) put("<p class=\"soft\">and {} smaller ones</p>\n", variables.size() - most);
  }

  void write_memories() {
    put("<h2>Memories, tables and FIFOs</h2>\n");
    begin_table({"", "name", "#words", "#bits", "#copies", "kept in", "#block RAMs", "source"});
    const auto row = [&](const char* kind, const std::string& name, std::uint64_t words, std::uint64_t width,
                         const std::string& copies, const std::string& storage, const std::string& blocks,
                         const std::string& where) {
      put("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td>"
          "<td class=\"n\">{}</td><td>{}</td></tr>\n",
          kind, name, words, width, copies, storage, blocks, where);
    };
    for (const json& m : report_["memories"])
      row("memory", text_of(m["name"]), whole(m["words"]), whole(m["width"]), std::to_string(whole(m["copies"])),
          text_of(m["storage"]), std::to_string(whole(m["block_rams"])), link(m["where"]));
    for (const json& t : report_["tables"])
      row("table", text_of(t["name"]), whole(t["words"]), whole(t["width"]), std::to_string(whole(t["readers"])),
          text_of(t["storage"]), std::to_string(whole(t["block_rams"])), link(t["where"]));
    for (const json& f : report_["fifos"])
      row("output FIFO", text_of(f["port"]), whole(f["depth"]), whole(f["width"]), "", "", "", "");
    for (const json& l : report_["delay_lines"])
      row("delay line", fmt::format("stage {} to {}", whole(l["from"]), whole(l["to"])),
          whole(l["to"]) - whole(l["from"]), whole(l["width"]), "", text_of(l["storage"]),
          std::to_string(whole(l["block_rams"])), "");
    end_table();
  }

  void write_ports() {
    put("<h2>Ports</h2>\n");
    begin_table({"port", "", "signal", "#bits", "#latency"});
    for (const json& port : report_["interface"]["ports"]) {
      const std::string name = port["name"];
      const json& latency = report_["latency_clocks"];
      for (const json& f : port["fields"])
        put("<tr><td>{}</td><td>{}</td><td><code>{}</code></td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>\n",
            escaped(name), text_of(port["direction"]), text_of(f["rtl"]), whole(f["width"]),
            latency.contains(name) ? std::to_string(whole(latency[name])) : "");
    }
    end_table();
  }

  const json& report_;
  const std::map<std::string, std::string>& sources_;
  std::string prefix_;
  std::map<place, const json*> by_place_;
  std::set<place> chain_;
  std::map<std::string, std::size_t> files_;
  std::string out_;
};

std::string place_text(const json& where) {
  if (where.is_null()) return "";
  const std::string file = where["file"];
  return escaped(fmt::format("{}:{}", file.substr(file.rfind('/') + 1), where["line"].get<unsigned>()));
}

/// Of a top made of processes: its streams, and every process as a page of its own to open.
std::string processes_page(const json& report, const std::map<std::string, std::string>& sources) {
  std::string text = head_of(text_of(report["top"]));
  const auto put = [&]<class... Arguments>(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
  };
  put("<p class=\"soft\">{}, {} processes side by side, joined by {} streams</p>\n<div class=\"tiles\">",
      text_of(report["target"]), report["processes"].size(), report["streams"].size());
  put("<div><b>{:.0f}</b>LUT4 (estimated)</div><div><b>{}</b>flip-flops</div><div><b>{}</b>block RAMs</div></div>\n",
      report["estimate"]["lut4"].get<double>(), whole(report["registers"]["total_bits"]),
      whole(report["estimate"]["block_rams"]));
  put("<h2>Streams between processes</h2>\n<p class=\"soft\">Peak fill: the most tokens that the FIFO held while the "
      "Verilog was simulated by --check, with and without pauses.</p>\n<div "
      "class=\"wide\"><table>\n<tr><th>stream</th><th>from</th><th>to</th>"
      "<th class=\"n\">depth</th><th class=\"n\">peak fill</th><th class=\"n\">bits</th><th>kept in</th><th "
      "class=\"n\">LUT4</th>"
      "<th class=\"n\">flip-flops</th><th class=\"n\">block RAMs</th><th>source</th></tr>\n");
  for (const json& stream : report["streams"])
    put("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td>{}</td><td class=\"n\">{:.0f}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>\n",
        text_of(stream["name"]), text_of(stream["writer"]), text_of(stream["reader"]), whole(stream["depth"]),
        stream["peak_fill"].is_null() ? "not simulated" : std::to_string(whole(stream["peak_fill"])),
        whole(stream["width"]), text_of(stream["storage"]), stream["lut4"].get<double>(), whole(stream["flip_flops"]),
        whole(stream["block_rams"]), place_text(stream["where"]));
  put("</table></div>\n<h2>Processes</h2>\n");
  for (std::size_t i = 0; i < report["processes"].size(); ++i) {
    const json& process = report["processes"][i];
    put("<details{}><summary>{} <span class=\"soft\">{}</span></summary>\n{}</details>\n", i == 0 ? " open" : "",
        text_of(process["report"]["top"]), place_text(process["called"]),
        page(process["report"], sources, fmt::format("p{}", i)).write());
  }
  return text + foot;
}

}  // namespace

std::string report_page(const json& report, const std::map<std::string, std::string>& sources) {
  if (report.contains("processes")) return processes_page(report, sources);
  return head_of(text_of(report["top"])) + page(report, sources).write() + foot;
}

}  // namespace epiline::emit
