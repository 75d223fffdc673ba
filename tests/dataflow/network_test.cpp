// Networks: their rules, their text, and their meaning: tokens that do not depend on depths, and a standstill that says
// which streams are full and which are empty.
#include "dataflow/network.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dataflow/network_interpreter.hpp"
#include "dataflow/network_text.hpp"
#include "dataflow/small_networks.hpp"

namespace epiline::dataflow {
namespace {

using llvm::APInt;
using namespace testing;

std::vector<std::uint64_t> run(network_interpreter& machine, const std::vector<unsigned>& tokens) {
  for (const unsigned token : tokens) machine.push(machine.find_port("in", true), APInt(8, token));
  EXPECT_EQ(machine.run_until_blocked(100'000).last, outcome::blocked);
  std::vector<std::uint64_t> out;
  while (const auto token = machine.pop(machine.find_port("out", false))) out.push_back(token->getZExtValue());
  return out;
}

TEST(network_interpreter, gives_the_same_tokens_whatever_the_depth) {
  const std::vector<unsigned> tokens = {1, 3, 2, 4, 6, 5, 8, 7, 9, 10};
  const std::vector<std::uint64_t> wanted = {2, 1, 4, 3, 6, 5, 8, 7, 10, 9};
  for (const unsigned depth : {2u, 3u, 100u}) {
    network_interpreter machine(sort_and_merge(depth));
    EXPECT_EQ(run(machine, tokens), wanted) << depth;
    EXPECT_EQ(machine.available(machine.find_port("in", true)), 0u);
    EXPECT_EQ(machine.fill(0) + machine.fill(1), 0u);
    EXPECT_LE(machine.peak(0), depth);
    EXPECT_GE(machine.peak(0), 2u);
    EXPECT_EQ(machine.iterations(), 10u);
  }
}

TEST(network_interpreter, names_the_full_and_the_empty_stream_of_a_standstill) {
  network_interpreter machine(sort_and_merge(3));
  // Five odd ones: three in the FIFO, one that waits for room, one unread. The merger wants an even one first.
  EXPECT_TRUE(run(machine, {1, 3, 5, 7, 9, 2}).empty());
  EXPECT_EQ(machine.available(machine.find_port("in", true)), 2u);
  EXPECT_EQ(machine.peak(0), 3u);
  EXPECT_EQ(machine.message(),
            "process 'sorter' waits for room in stream 'odd', which is full (3 of 3); process 'merger' waits for a "
            "token of stream 'even', which is empty");
}

TEST(network_interpreter, at_its_end_waits_for_the_tops_own_ports) {
  network_interpreter machine(sort_and_merge(3));
  EXPECT_EQ(run(machine, {2, 1}).size(), 2u);
  EXPECT_NE(machine.message().find("process 'sorter' waits: "), std::string::npos) << machine.message();
  EXPECT_NE(machine.message().find("'in'"), std::string::npos) << machine.message();
}

TEST(network_interpreter, stops_at_the_limit_of_iterations) {
  network_interpreter machine(sort_and_merge(2));
  for (unsigned i = 0; i < 64; ++i) machine.push(0, APInt(8, i));
  const interpreter::progress some = machine.run_until_blocked(10);
  EXPECT_EQ(some.last, outcome::advanced);
  EXPECT_EQ(some.iterations, 10u);
  EXPECT_EQ(machine.run_until_blocked(1000).last, outcome::blocked);
  EXPECT_EQ(machine.iterations(), 64u);
}

TEST(network_interpreter, gives_every_process_its_scalars_of_a_call) {
  network_interpreter machine(two_adders());
  const port_id call = machine.find_port("call", true);
  machine.push(call, APInt(20, 0x0a31f));  // a = 0x0a, b = 0x31
  machine.push(call, APInt(20, 0x02203));  // a = 2, b = 0x20
  EXPECT_EQ(machine.available(call), 2u);
  EXPECT_EQ(run(machine, {1, 100, 7}), (std::vector<std::uint64_t>{1 + 0x0a + 0x31, 100 + 2 + 0x20}));
  EXPECT_EQ(machine.available(call), 0u);
}

TEST(network_interpreter, refuses_ports_and_tokens_that_are_not_there) {
  network_interpreter machine(two_adders());
  EXPECT_THROW(machine.push(1, APInt(8, 0)), std::invalid_argument);
  EXPECT_THROW(machine.push(9, APInt(8, 0)), std::invalid_argument);
  EXPECT_THROW(machine.push(0, APInt(9, 0)), std::invalid_argument);
  EXPECT_THROW(machine.push(2, APInt(8, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(machine.pop(0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(machine.available(9)), std::invalid_argument);
  EXPECT_EQ(machine.find_port("between", true), none);
}

TEST(network, breaks_no_rule_and_each_rule_can_be_broken) {
  EXPECT_EQ(find_violation(sort_and_merge(2)), "");
  EXPECT_EQ(find_violation(two_adders()), "");
  EXPECT_EQ(find_violation(network_of(sorter())), "");
  const auto broken = [](const char* words, auto&& change) {
    network n = two_adders();
    change(n);
    EXPECT_NE(find_violation(n).find(words), std::string::npos) << find_violation(n);
    EXPECT_THROW(network_interpreter{n}, std::invalid_argument);
  };
  broken("has no process", [](network& n) { n.processes.clear(); });
  broken("places", [](network& n) { n.called.pop_back(); });
  broken("process 'second'", [](network& n) { n.processes[1].nodes[1].operands.clear(); });
  broken("two processes are named", [](network& n) { n.processes[1].name = "first"; });
  broken("two streams are named", [](network& n) { n.fifos.push_back(n.fifos[0]); });
  broken("two streams are named", [](network& n) { n.ports[0].name = "between"; });
  broken("has 0 writers", [](network& n) { n.processes[0].ports[2].name = "elsewhere"; });
  broken("has 0 readers", [](network& n) { n.processes[1].ports[0].name = "elsewhere"; });
  broken("has 2 readers", [](network& n) { n.processes[0].ports[0].name = "between"; });
  broken("has 9 bits", [](network& n) { n.fifos[0].width = 9; });
  broken("no legal size", [](network& n) { n.fifos[0].depth = 0; });
  broken("belongs to 0 processes", [](network& n) { n.ports.push_back(outer("more", true)); });
  broken("joined to nothing", [](network& n) { n.fifos.clear(); });
  broken("no scalar 'b'", [](network& n) { n.ports[2].fields[1].signal = "c"; });
  broken("two call ports", [](network& n) { n.ports.push_back(n.ports[2]); });
}

TEST(network_text, loses_nothing) {
  for (const network& n : {sort_and_merge(5), two_adders()}) {
    const std::string text = print(n);
    const network again = parse_network(text);
    EXPECT_EQ(print(again), text);
    EXPECT_EQ(again.files, n.files);
    ASSERT_EQ(again.fifos.size(), n.fifos.size());
    for (std::size_t i = 0; i < n.fifos.size(); ++i) {
      EXPECT_EQ(again.fifos[i].name, n.fifos[i].name);
      EXPECT_EQ(again.fifos[i].width, n.fifos[i].width);
      EXPECT_EQ(again.fifos[i].depth, n.fifos[i].depth);
      EXPECT_EQ(again.fifos[i].where.line, n.fifos[i].where.line);
    }
    ASSERT_EQ(again.processes.size(), 2u);
    EXPECT_EQ(print(again.processes[1]), print(n.processes[1]));
    EXPECT_EQ(again.called[1].line, n.called[1].line);
    ASSERT_EQ(again.ports.size(), n.ports.size());
    EXPECT_EQ(again.ports.back().fields.size(), n.ports.back().fields.size());
  }
}

TEST(network_text, of_a_graph_is_a_network_of_one_process) {
  const network n = parse_network("; a comment\n" + print(sorter()));
  EXPECT_TRUE(is_single(n));
  EXPECT_EQ(n.name, "sorter");
  EXPECT_EQ(print(n.processes.front()), print(sorter()));
}

TEST(network_text, names_mistakes_with_their_line) {
  const auto mistake = [](const std::string& text) {
    try {
      static_cast<void>(parse_network(text));
    } catch (const text_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(mistake(""), "line 1: found the end of the line, expected 'network'");
  EXPECT_EQ(mistake("net \"x\""), "line 1: found 'net', expected 'network'");
  EXPECT_EQ(mistake("network \"x\"\n\nfifo \"a\" 8\n"), "line 3: found the end of the line, expected 'depth'");
  EXPECT_EQ(mistake("network \"x\"\nfifo \"a\" 8 depth 0\n"), "line 2: found 0, expected a depth from 1 to 1048576");
  EXPECT_EQ(mistake("network \"x\"\nfield \"a\" \"b\" 8\n"),
            "line 2: a field stands here, expected it after input or output");
  EXPECT_EQ(mistake("network \"x\"\nregister"),
            "line 2: found 'register', expected file, input, output, field, fifo or process");
  EXPECT_EQ(mistake("network \"x\"\nprocess\ngraph \"y\"\n; nothing\nnonsense\n"),
            "line 5: found 'nonsense', expected file, input, output, field, register, memory, table, words, patient or "
            "%N");
  EXPECT_EQ(mistake("network \"x\"\n"), "line 1: the network breaks a rule: network 'x' has no process");
}

}  // namespace
}  // namespace epiline::dataflow
