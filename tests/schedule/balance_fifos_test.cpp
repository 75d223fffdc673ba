// FIFOs on the shorter of two ways between processes hold what the longer one has under way.

#include "schedule/balance_fifos.hpp"

#include <gtest/gtest.h>

#include "dataflow/small_networks.hpp"

namespace epiline::schedule {
namespace {

using dataflow::graph;
using dataflow::network;
using dataflow::node_id;
using dataflow::operation;
using dataflow::testing::small_graph;

/// Reads one stream and writes it to others, in so many stages.
struct process {
  graph g;
  result s;
};
process make_process(const std::string& name, const std::vector<std::string>& in, const std::vector<std::string>& out,
                     int stages) {
  small_graph made;
  made.g.name = name;
  node_id token = dataflow::none;
  for (const std::string& stream : in) token = made.read(stream, 8);
  for (const std::string& stream : out) made.write(stream, token);
  process p{made.g, {}};
  p.s.stage.assign(made.g.nodes.size(), 0);
  for (std::size_t id = 0; id < made.g.nodes.size(); ++id)
    if (made.g.nodes[id].kind == operation::write) p.s.stage[id] = stages;
  return p;
}

struct fork_and_join {
  network n;
  std::vector<result> schedules;

  explicit fork_and_join(int slow) {
    for (process& p : std::vector<process>{make_process("fork", {"in"}, {"short", "long"}, 2),
                                           make_process("slow", {"long"}, {"late"}, slow),
                                           make_process("join", {"short", "late", "back"}, {"out"}, 1),
                                           make_process("after", {"out"}, {"back", "end"}, 1)}) {
      n.processes.push_back(p.g);
      schedules.push_back(p.s);
    }
    for (const char* stream : {"short", "long", "late", "out", "back"}) n.fifos.push_back({stream, 8, 2, {}});
  }
};

TEST(balance_fifos, deepens_the_short_way_by_what_the_long_one_takes_more) {
  fork_and_join made(40);
  balance_fifos(made.n, made.schedules, std::vector<bool>(5, true));
  // The long way: another FIFO, and a process of 40 stages between its registers.
  EXPECT_EQ(made.n.fifos[0].depth,
            static_cast<unsigned>(latency_of(made.n.processes[1], made.schedules[1], 1) + fifo_latency + 2));
  EXPECT_EQ(latency_of(made.n.processes[1], made.schedules[1], 1), 44);
  // The others are the longest ways themselves, or lead backwards.
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(made.n.fifos[i].depth, 2u) << i;
}

TEST(balance_fifos, leaves_what_the_source_says_and_never_takes_places_away) {
  fork_and_join said(40);
  said.n.fifos[0].depth = 5;
  balance_fifos(said.n, said.schedules, {false, true, true, true, true});
  EXPECT_EQ(said.n.fifos[0].depth, 5u);
  fork_and_join deep(4);
  deep.n.fifos[0].depth = 100;
  balance_fifos(deep.n, deep.schedules, std::vector<bool>(5, true));
  EXPECT_EQ(deep.n.fifos[0].depth, 100u);
}

}  // namespace
}  // namespace epiline::schedule
