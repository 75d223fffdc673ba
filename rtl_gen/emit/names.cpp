#include "emit/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "schedule/schedule.hpp"

namespace epiline::emit {

namespace {

constexpr std::string_view keywords[] = {
    "always", "and", "assign", "automatic", "begin", "buf", "bufif0", "bufif1", "case", "casex", "casez", "cell",
    "cmos", "config", "deassign", "default", "defparam", "design", "disable", "edge", "else", "end", "endcase",
    "endconfig", "endfunction", "endgenerate", "endmodule", "endprimitive", "endspecify", "endtable", "endtask",
    "event", "for", "force", "forever", "fork", "function", "generate", "genvar", "highz0", "highz1", "if", "ifnone",
    "incdir", "include", "initial", "inout", "input", "instance", "integer", "join", "large", "liblist", "library",
    "localparam", "macromodule", "medium", "module", "nand", "negedge", "nmos", "nor", "noshowcancelled", "not",
    "notif0", "notif1", "or", "output", "parameter", "pmos", "posedge", "primitive", "pull0", "pull1", "pulldown",
    "pullup", "pulsestyle_onevent", "pulsestyle_ondetect", "rcmos", "real", "realtime", "reg", "release", "repeat",
    "rnmos", "rpmos", "rtran", "rtranif0", "rtranif1", "scalared", "showcancelled", "signed", "small", "specify",
    "specparam", "strong0", "strong1", "supply0", "supply1", "table", "task", "time", "tran", "tranif0", "tranif1",
    "tri", "tri0", "tri1", "triand", "trior", "trireg", "unsigned", "use", "uwire", "vectored", "wait", "wand", "weak0",
    "weak1", "while", "wire", "wor", "xnor", "xor",
    // SystemVerilog's most likely names: tools may read .v files as SystemVerilog.
    "bit", "byte", "char", "class", "const", "do", "enum", "final", "int", "interface", "local", "logic", "longint",
    "new", "null", "package", "priority", "program", "property", "protected", "ref", "return", "sequence", "shortint",
    "shortreal", "static", "string", "struct", "super", "tagged", "this", "type", "typedef", "union", "unique", "var",
    "virtual", "void", "with", "within", "break", "continue", "checker", "clocking", "context", "cover", "cross",
    "dist", "expect", "export", "extends", "extern", "first_match", "foreach", "global", "iff", "import", "inside",
    "join_any", "join_none", "let", "matches", "modport", "packed", "pure", "rand", "randc", "randcase", "solve",
    "strong", "weak", "throughout", "timeprecision", "timeunit", "wildcard", "restrict", "reject_on", "accept_on",
    "assert", "assume", "before", "bind", "bins", "binsof", "covergroup", "coverpoint", "endclass", "implements",
    "implies", "intersect", "nettype", "nexttime", "soft", "untyped", "until", "chandle", "alias", "always_comb",
    "always_ff", "always_latch", "eventually", "forkjoin", "unique0", "s_always"};

}  // namespace

bool is_keyword(std::string_view name) {
  return std::find(std::begin(keywords), std::end(keywords), name) != std::end(keywords);
}

bool is_identifier(std::string_view name) {
  if (name.empty() || (!std::isalpha(static_cast<unsigned char>(name[0])) && name[0] != '_')) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

std::vector<std::string> reserve_signals(const dataflow::graph& g, const std::vector<rtl_port>& interface,
                                         std::unordered_set<std::string>& taken) {
  std::vector<std::string> stems;
  const auto reserve = [&](const std::string& name, std::string_view what, dataflow::source_location where) {
    const std::string place = where.line == 0 ? "" : schedule::describe(g, where) + ": error: ";
    if (!is_identifier(name) || is_keyword(name)) {
      throw std::invalid_argument(
          fmt::format("{}{} '{}' cannot have that name in Verilog: rename it", place, what, name));
    }
    if (!taken.insert(name).second) {
      throw std::invalid_argument(
          fmt::format("{}{} '{}' has the name of another signal of the module: rename it", place, what, name));
    }
    // A scalar named x_s3 keeps other values from being named x, whose copy in stage 3 would be called the same.
    const std::size_t mark = name.find_last_not_of("0123456789");
    if (mark != std::string::npos && mark > 1 && name.compare(mark - 1, 2, "_s") == 0) {
      stems.push_back(name.substr(0, mark - 1));
    }
  };
  reserve(g.name, "top", {});
  reserve("clk", "signal", {});
  reserve("rst", "signal", {});
  for (const rtl_port& port : interface) {
    for (const rtl_field& f : port.fields) reserve(f.rtl, "port signal", port.where);
    reserve(port.valid, "port signal", port.where);
    reserve(port.ready, "port signal", port.where);
  }
  return stems;
}

}  // namespace epiline::emit
