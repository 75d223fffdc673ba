#include "dataflow/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace epiline::dataflow {

namespace {

/// The place of a scalar in the top's call token; null: it has none of that name and width.
const field* find_field(const port& call, const field& wanted) {
  for (const field& f : call.fields)
    if (f.signal == wanted.signal && f.width == wanted.width) return &f;
  return nullptr;
}

std::string check_fifo(const network& n, const fifo& f) {
  if (f.width == 0 || f.width > max_width || f.depth == 0 || f.depth > max_fifo_depth)
    return fmt::format("FIFO '{}' has no legal size", f.name);
  for (const bool input : {false, true}) {
    unsigned ends = 0;
    for (const graph& g : n.processes)
      for (const port& p : g.ports) {
        if (p.kind != port_kind::stream || p.input != input || p.name != f.name) continue;
        ++ends;
        if (p.width != f.width)
          return fmt::format("FIFO '{}' has {} bits, port of process '{}' has {}", f.name, f.width, g.name, p.width);
      }
    if (ends != 1) return fmt::format("FIFO '{}' has {} {}, not one", f.name, ends, input ? "readers" : "writers");
  }
  return "";
}

std::string check_port_of_process(const network& n, const graph& g, const port& p) {
  if (p.kind == port_kind::stream &&
      std::any_of(n.fifos.begin(), n.fifos.end(), [&](const fifo& f) { return f.name == p.name; }))
    return "";
  for (const port& outer : n.ports) {
    if (outer.kind != p.kind || outer.input != p.input) continue;
    if (p.kind == port_kind::call) {
      for (const field& f : p.fields)
        if (find_field(outer, f) == nullptr)
          return fmt::format("the call port has no scalar '{}' of {} bits, which process '{}' takes", f.name, f.width,
                             g.name);
      return "";
    }
    if (outer.name == p.name && outer.width == p.width) return "";
  }
  return fmt::format("port '{}' of process '{}' is joined to nothing", p.name, g.name);
}

}  // namespace

network network_of(graph g) {
  network n;
  n.name = g.name;
  n.files = g.files;
  n.ports = g.ports;
  n.processes.push_back(std::move(g));
  n.called.emplace_back();
  return n;
}

endpoint find_end(const network& n, const std::string& stream, bool input) {
  for (process_id process = 0; process < n.processes.size(); ++process)
    for (port_id port = 0; port < n.processes[process].ports.size(); ++port) {
      const dataflow::port& p = n.processes[process].ports[port];
      if (p.kind != port_kind::call && p.name == stream && p.input == input) return {process, port};
    }
  return {};
}

std::string find_violation(const network& n) {
  if (n.processes.empty()) return fmt::format("network '{}' has no process", n.name);
  if (n.called.size() != n.processes.size())
    return fmt::format("{} processes have {} places", n.processes.size(), n.called.size());
  std::set<std::string> names, graph_names;
  for (const graph& g : n.processes) {
    if (std::string what = find_violation(g); !what.empty()) return fmt::format("process '{}': {}", g.name, what);
    if (!graph_names.insert(g.name).second) return fmt::format("two processes are named '{}'", g.name);
  }
  for (const fifo& f : n.fifos) {
    if (!names.insert(f.name).second) return fmt::format("two streams are named '{}'", f.name);
    if (std::string what = check_fifo(n, f); !what.empty()) return what;
  }
  unsigned calls = 0;
  for (const port& outer : n.ports) {
    if (outer.kind == port_kind::call) {
      if (++calls > 1) return "there are two call ports";
      continue;
    }
    if (!names.insert(outer.name).second) return fmt::format("two streams are named '{}'", outer.name);
    unsigned ends = 0;
    for (const graph& g : n.processes)
      for (const port& p : g.ports) ends += p.kind == outer.kind && p.input == outer.input && p.name == outer.name;
    if (ends != 1) return fmt::format("port '{}' belongs to {} processes, not one", outer.name, ends);
  }
  for (const graph& g : n.processes)
    for (const port& p : g.ports)
      if (std::string what = check_port_of_process(n, g, p); !what.empty()) return what;
  return "";
}

}  // namespace epiline::dataflow
