#include "schedule/balance_fifos.hpp"

#include <algorithm>

namespace epiline::schedule {

using dataflow::endpoint;
using dataflow::network;
using dataflow::operation;

namespace {

constexpr int around_the_pipeline = 4;  // the input register before the issue, the output's FIFO, its flag and register
constexpr int spare_places = 2;         // so that a FIFO that is just deep enough need not wait for its own handshake

}  // namespace

int latency_of(const dataflow::graph& g, const result& s, dataflow::port_id port) {
  int stage = 0;
  for (std::size_t id = 0; id < g.nodes.size(); ++id)
    if (g.nodes[id].kind == operation::write && g.nodes[id].object == port) stage = std::max(stage, s.stage[id]);
  return stage + around_the_pipeline;
}

void balance_fifos(network& n, const std::vector<result>& schedules, const std::vector<bool>& may_grow) {
  struct way {
    endpoint writer, reader;
    int latency;
  };
  std::vector<way> ways;
  for (const dataflow::fifo& f : n.fifos) {
    const endpoint writer = find_end(n, f.name, false);
    const endpoint reader = find_end(n, f.name, true);
    ways.push_back({writer, reader,
                    latency_of(n.processes[writer.process], schedules[writer.process], writer.port) + fifo_latency});
  }
  // When a token that enters the top now reaches each process. Writers are called before readers; what leads backwards
  // belongs to the call before.
  std::vector<int> arrival(n.processes.size(), 0);
  for (std::size_t reader = 0; reader < n.processes.size(); ++reader)
    for (const way& w : ways)
      if (w.reader.process == reader && w.writer.process < reader)
        arrival[reader] = std::max(arrival[reader], arrival[w.writer.process] + w.latency);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const way& w = ways[i];
    if (!may_grow[i] || w.writer.process >= w.reader.process) continue;
    const int waits = arrival[w.reader.process] - arrival[w.writer.process] - w.latency;
    if (waits > 0) n.fifos[i].depth = std::max(n.fifos[i].depth, static_cast<unsigned>(waits + spare_places));
  }
}

}  // namespace epiline::schedule
