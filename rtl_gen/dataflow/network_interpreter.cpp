#include "dataflow/network_interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace epiline::dataflow {

network_interpreter::network_interpreter(const network& n) {
  if (const std::string what = find_violation(n); !what.empty()) throw std::invalid_argument(what);
  ports_ = n.ports;
  for (process_id process = 0; process < n.processes.size(); ++process) {
    const graph& g = n.processes[process];
    names_.push_back(g.name);
    machines_.emplace_back(g);
    last_.push_back(outcome::advanced);
    for (port_id port = 0; port < g.ports.size(); ++port) {
      if (g.ports[port].kind != port_kind::call) continue;
      call_taker taker{{process, port}, {}};
      for (const field& f : g.ports[port].fields)
        for (const dataflow::port& outer : ports_)
          if (outer.kind == port_kind::call)
            for (const field& whole : outer.fields)
              if (whole.signal == f.signal) taker.fields.push_back({whole.offset, whole.width});
      takers_.push_back(std::move(taker));
    }
  }
  for (const fifo& f : n.fifos) joints_.push_back({f, find_end(n, f.name, false), find_end(n, f.name, true)});
  for (const port& outer : ports_)
    inside_.push_back(outer.kind != port_kind::call ? find_end(n, outer.name, outer.input)
                      : takers_.empty()             ? endpoint{}
                                                    : takers_.front().at);
}

void network_interpreter::push(port_id port, const llvm::APInt& token) {
  if (port >= ports_.size() || !ports_[port].input)
    throw std::invalid_argument(fmt::format("port {} is no input of the network", port));
  if (token.getBitWidth() != ports_[port].width)
    throw std::invalid_argument(fmt::format("port '{}' takes tokens of {} bits, not {}", ports_[port].name,
                                            ports_[port].width, token.getBitWidth()));
  if (ports_[port].kind != port_kind::call) return machines_[inside_[port].process].push(inside_[port].port, token);
  for (const call_taker& taker : takers_) {
    unsigned width = 0;
    for (const call_field& f : taker.fields) width += f.width;
    llvm::APInt part(width, 0);
    unsigned low = 0;
    for (const call_field& f : taker.fields) {
      part.insertBits(token.extractBits(f.width, f.low), low);
      low += f.width;
    }
    machines_[taker.at.process].push(taker.at.port, part);
  }
}

std::optional<llvm::APInt> network_interpreter::pop(port_id port) {
  if (port >= ports_.size() || ports_[port].input)
    throw std::invalid_argument(fmt::format("port {} is no output of the network", port));
  return machines_[inside_[port].process].pop(inside_[port].port);
}

std::size_t network_interpreter::available(port_id port) const {
  if (port >= ports_.size()) throw std::invalid_argument(fmt::format("there is no port {}", port));
  if (ports_[port].kind != port_kind::call) return machines_[inside_[port].process].available(inside_[port].port);
  std::size_t most = 0;  // a call is used up when all have taken it
  for (const call_taker& taker : takers_) most = std::max(most, machines_[taker.at.process].available(taker.at.port));
  return most;
}

port_id network_interpreter::find_port(std::string_view name, bool input) const {
  for (port_id id = 0; id < ports_.size(); ++id)
    if (ports_[id].name == name && ports_[id].input == input) return id;
  return none;
}

std::uint64_t network_interpreter::iterations() const {
  std::uint64_t most = 0;
  for (const interpreter& machine : machines_) most = std::max(most, machine.iterations());
  return most;
}

std::size_t network_interpreter::fill(fifo_id id) const {
  const joint& j = joints_.at(id);
  return machines_[j.reader.process].available(j.reader.port);
}

bool network_interpreter::move_tokens() {
  bool moved = false;
  for (fifo_id id = 0; id < joints_.size(); ++id) {
    joint& j = joints_[id];
    interpreter& writer = machines_[j.writer.process];
    interpreter& reader = machines_[j.reader.process];
    while (writer.available(j.writer.port) > 0 && reader.available(j.reader.port) < j.what.depth) {
      reader.push(j.reader.port, *writer.pop(j.writer.port));
      moved = true;
    }
    j.peak = std::max(j.peak, fill(id));
  }
  return moved;
}

const network_interpreter::joint* network_interpreter::full_output(process_id process) const {
  for (const joint& j : joints_)
    if (j.writer.process == process && machines_[process].available(j.writer.port) > 0) return &j;
  return nullptr;
}

interpreter::progress network_interpreter::run_until_blocked(std::uint64_t max_iterations) {
  if (machines_.size() == 1 && joints_.empty()) return machines_.front().run_until_blocked(max_iterations);
  const std::uint64_t before = iterations();
  const std::uint64_t limit = before + max_iterations;
  interpreter::progress progress{outcome::blocked, 0};
  for (bool moves = true; moves;) {
    moves = move_tokens();
    for (process_id process = 0; process < machines_.size(); ++process) {
      if (full_output(process) != nullptr) continue;
      last_[process] = machines_[process].step();
      if (last_[process] == outcome::broken_promise) {
        progress.last = outcome::broken_promise;
        progress.iterations = iterations() - before;
        return progress;
      }
      moves = moves || last_[process] == outcome::advanced;
    }
    if (iterations() >= limit) {
      progress.last = moves ? outcome::advanced : outcome::blocked;
      break;
    }
  }
  progress.iterations = iterations() - before;
  return progress;
}

std::string network_interpreter::message() const {
  if (machines_.size() == 1) return machines_.front().message();
  for (process_id process = 0; process < machines_.size(); ++process)
    if (last_[process] == outcome::broken_promise)
      return fmt::format("process '{}': {}", names_[process], machines_[process].message());
  std::string text;
  for (process_id process = 0; process < machines_.size(); ++process) {
    fmt::format_to(std::back_inserter(text), "{}process '{}' ", text.empty() ? "" : "; ", names_[process]);
    if (const joint* j = full_output(process); j != nullptr) {
      fmt::format_to(std::back_inserter(text), "waits for room in stream '{}', which is full ({} of {})", j->what.name,
                     machines_[j->reader.process].available(j->reader.port), j->what.depth);
    } else if (last_[process] == outcome::blocked) {
      const port_id port = machines_[process].blocked_on();
      const auto inner = std::find_if(joints_.begin(), joints_.end(), [&](const joint& candidate) {
        return candidate.reader.process == process && candidate.reader.port == port;
      });
      if (inner != joints_.end())
        fmt::format_to(std::back_inserter(text), "waits for a token of stream '{}', which is empty", inner->what.name);
      else
        fmt::format_to(std::back_inserter(text), "waits: {}", machines_[process].message());
    } else {
      text += "can go on";
    }
  }
  return text;
}

}  // namespace epiline::dataflow
