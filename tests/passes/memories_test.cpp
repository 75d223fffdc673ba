// Order, forwarding and packing of memories.
#include "dataflow/interpreter.hpp"
#include "passes/forward_memories.hpp"
#include "passes/pack_memories.hpp"
#include "passes/pass_fixture.hpp"
#include "passes/pipeline.hpp"
#include "passes/simplify.hpp"

namespace epiline::passes {
namespace {

using namespace testing;
using op = operation;
using llvm::APInt;

/// hist[in]++, and the old count goes out.
small_graph histogram() {
  small_graph s;
  const node_id one = s.constant(1, 1), address = s.read("in", 2);
  const auto m = s.add_memory("histogram", 4, 8);
  const node_id old = s.make(op::memory_read, 8, {address, one}, m);
  s.make(op::memory_write, 0, {address, s.make(op::add, 8, {old, s.constant(8, 1)}), one}, m);
  s.write("out", old);
  return s;
}

TEST(forward_memories, a_histogram_may_lag_and_still_counts_consecutive_equal_values) {
  for (const unsigned writes : {1u, 2u, 4u}) {
    const graph before = histogram().g;
    const graph after = run(before, [writes](graph& g) { forward_memories(g, writes); });
    EXPECT_EQ(after.memories[0].distance, 1 + writes);
    EXPECT_FALSE(after.memories[0].distance_promised);
    EXPECT_EQ(after.registers.size(), 3 * writes);
    dataflow::interpreter counts(after);
    for (int i = 0; i < 10; ++i) counts.push(0, 2);
    counts.run_until_blocked(100);
    for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(counts.pop_word(1), i);
  }
}

TEST(forward_memories, without_the_registers_the_lag_would_be_seen) {
  graph g = histogram().g;
  g.memories[0].distance = 2;
  EXPECT_NE(dataflow::testing::find_difference(histogram().g, g, 1, 300), "");
}

TEST(forward_memories, leaves_promises_and_memories_without_feedback_alone) {
  graph promised = histogram().g;
  promised.memories[0].distance_promised = true;
  forward_memories(promised, 1);
  EXPECT_TRUE(promised.registers.empty());
  EXPECT_EQ(promised.memories[0].distance, 1u);

  small_graph s;
  const node_id one = s.constant(1, 1), address = s.read("a", 2);
  const auto m = s.add_memory("line", 4, 8);
  s.write("out", s.make(op::memory_read, 8, {address, one}, m));
  s.make(op::memory_write, 0, {address, s.read("d", 8), one}, m);
  const graph after = run(s.g, [](graph& g) { forward_memories(g); });
  EXPECT_TRUE(after.registers.empty());
  EXPECT_EQ(after.memories[0].distance, 1u);
}

/// Write first, then read: the read sees the data of its own iteration. Three words, so address 3 is past the end.
small_graph write_then_read() {
  small_graph s;
  const node_id wa = s.read("wa", 2), ra = s.read("ra", 2), data = s.read("d", 8);
  const node_id write = s.read("w", 1), enable = s.read("e", 1);
  const auto m = s.add_memory("ram", 3, 8);
  s.make(op::memory_write, 0, {wa, data, write}, m);
  s.write("out", s.make(op::memory_read, 8, {ra, enable}, m));
  return s;
}

TEST(order_memory_accesses, puts_reads_before_the_write) {
  const graph after = run(write_then_read().g, order_memory_accesses);
  std::size_t read = 0, write = 0;
  for (std::size_t i = 0; i < after.nodes.size(); ++i) {
    if (after.nodes[i].kind == op::memory_read) read = i;
    if (after.nodes[i].kind == op::memory_write) write = i;
  }
  EXPECT_LT(read, write);
}

TEST(order_memory_accesses, names_a_memory_with_two_writes) {
  small_graph s = write_then_read();
  s.make(op::memory_write, 0, {s.constant(2, 0), s.constant(8, 0), s.constant(1, 1)}, 0);
  for (const auto& pass :
       {order_memory_accesses, +[](graph& g) { run_default_pipeline(g); }, +[](graph& g) { forward_memories(g); }}) {
    graph g = s.g;
    try {
      pass(g);
      ADD_FAILURE() << "accepted";
    } catch (const memory_error& error) {
      EXPECT_STREQ(error.what(), "small.cpp:7: memory 'ram' is written more than once in an iteration");
    }
  }
}

/// Two memories of different widths, same accesses but for what `different` changes.
small_graph two_memories(const std::string& different) {
  small_graph s;
  const node_id one = s.constant(1, 1), wa = s.read("wa", 2), ra = s.read("ra", 2), other = s.read("other", 2);
  const node_id bit = s.read("bit", 1), data = s.read("d", 20);
  const auto low = s.add_memory("low", 4, 8), high = s.add_memory("high", 4, 12);
  if (different != "contents")
    for (std::uint64_t i = 0; i < 4; ++i) {
      s.g.memories[low].initial.push_back(APInt(8, i + 1));
      s.g.memories[high].initial.push_back(APInt(12, i + 100));
    }
  else
    s.g.memories[low].initial.assign(4, APInt(8, 1));
  if (different == "distance") s.g.memories[high].distance = 2, s.g.memories[high].distance_promised = false;
  const node_id x = s.make(op::memory_read, 8, {ra, one}, low);
  const node_id y = s.make(op::memory_read, 12, {different == "read address" ? other : ra, one}, high);
  s.make(op::memory_write, 0, {wa, s.make(op::slice, 8, {data}), one}, low);
  node_id word = s.make(op::slice, 12, {data}, none, 8);
  if (different == "arrival")
    for (unsigned sum = 0; sum < 5; ++sum) word = s.make(op::add, 12, {word, s.make(op::slice, 12, {data}, none, sum)});
  s.make(op::memory_write, 0, {different == "write address" ? other : wa, word, different == "enable" ? bit : one},
         high);
  s.write("out", s.make(op::concat, 20, {y, x}));
  return s;
}

TEST(pack_memories, equal_accesses_make_one_wide_memory) {
  const graph after = run(two_memories("").g, pack_memories);
  ASSERT_EQ(after.memories.size(), 1u);
  EXPECT_EQ(after.memories[0].name, "low_x2");
  EXPECT_EQ(after.memories[0].width, 20u);
  EXPECT_EQ(after.memories[0].initial[1], APInt(20, 101 << 8 | 2));
  EXPECT_EQ(count(after, op::memory_read), 1u);
  EXPECT_EQ(count(after, op::memory_write), 1u);
}

TEST(pack_memories, unequal_accesses_stay_apart) {
  for (const char* different : {"read address", "write address", "enable", "contents", "distance", "arrival"}) {
    SCOPED_TRACE(different);
    graph g = two_memories(different).g;
    pack_memories(g);
    EXPECT_EQ(g.memories.size(), 2u);
  }
}

TEST(pack_memories, words_end_where_one_address_would_go_too_far) {
  small_graph s;
  const node_id one = s.constant(1, 1), address = s.read("a", 2), data = s.read("d", 24);
  for (unsigned i = 0; i < 14; ++i) {
    const auto line = s.add_memory("line", 4, 24);
    s.write("out" + std::to_string(i), s.make(op::memory_read, 24, {address, one}, line));
    s.make(op::memory_write, 0, {address, data, one}, line);
  }
  const graph after = run(s.g, pack_memories);
  ASSERT_EQ(after.memories.size(), 2u);
  EXPECT_EQ(after.memories[0].width, 12 * 24u);
  EXPECT_EQ(after.memories[1].width, 2 * 24u);
}

TEST(pack_memories, reads_of_one_memory_at_one_address_become_one_in_the_pipeline) {
  graph g = two_memories("").g;
  run_default_pipeline(g);
  EXPECT_EQ(g.memories.size(), 1u);
  EXPECT_EQ(count(g, op::memory_read), 1u);
}

}  // namespace
}  // namespace epiline::passes
