// Every rule of graph.hpp: a legal graph is accepted, and each way to break a rule is found and named.
#include "dataflow/graph.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "dataflow/small_graph.hpp"

namespace epiline::dataflow {
namespace {

using llvm::APInt;
using testing::small_graph;

/// One of everything; node ids are the positions in this order.
small_graph legal() {
  small_graph s;
  s.constant(1, 1);                    // 0
  const node_id in = s.read("in", 8);  // 1 constant, 2 read
  const register_id r = s.add_register("state", 8, 5);
  const node_id value = s.value_of(r);  // 3
  const memory_id m = s.add_memory("ram", 4, 8);
  s.g.memories[m].initial.assign(4, APInt(8, 1));
  const node_id address = s.make(operation::slice, 2, {in}, none, 1);       // 4
  const node_id word = s.make(operation::memory_read, 8, {address, 0}, m);  // 5
  s.make(operation::memory_write, 0, {address, in, 0}, m);                  // 6
  s.g.tables.push_back({"rom", 8, {APInt(8, 1), APInt(8, 2)}, false, {}});
  const node_id entry = s.make(operation::table, 8, {address}, 0);             // 7
  const node_id sum = s.make(operation::add, 8, {word, entry});                // 8
  const node_id less = s.make(operation::less_signed, 1, {sum, value});        // 9
  const node_id chosen = s.make(operation::select, 8, {less, sum, value});     // 10
  const node_id both = s.make(operation::concat, 16, {chosen, in});            // 11
  const node_id wide = s.make(operation::extend_sign, 20, {both});             // 12
  const node_id shifted = s.make(operation::shift_left, 20, {wide, address});  // 13
  s.make(operation::bit_not, 20, {shifted});                                   // 14
  s.write("out", shifted);                                                     // 15 constant, 16 write
  s.update(r, sum, less);
  s.g.patient = less;
  return s;
}

TEST(graph, a_legal_graph_has_no_violation) { EXPECT_EQ(find_violation(legal().g), ""); }

TEST(graph, every_operation_has_its_own_name) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(operation::extend_sign); ++i) names.insert(name_of(static_cast<operation>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(operation::extend_sign) + 1);
  EXPECT_STREQ(name_of(operation::add), "add");
  EXPECT_STREQ(name_of(operation::memory_write), "memory_write");
  EXPECT_STREQ(name_of(static_cast<operation>(200)), "unknown");
}

TEST(graph, each_broken_rule_is_named) {
  struct broken {
    const char* expected;
    std::function<void(graph&)> damage;
  };
  const broken cases[] = {
      {"port 0 'in' (small.cpp:7): width 0 is not in 1..65536", [](graph& g) { g.ports[0].width = 0; }},
      {"port 0 'in' (small.cpp:7): width 65537 is not in 1..65536", [](graph& g) { g.ports[0].width = 65537; }},
      {"field 'value' starts at bit 1 instead of 0", [](graph& g) { g.ports[0].fields[0].offset = 1; }},
      {"field 'value': width 0 is not in", [](graph& g) { g.ports[0].fields[0].width = 0; }},
      {"field 'value' reaches past the token's end", [](graph& g) { g.ports[0].fields[0].width = 9; }},
      {"the fields have 7 bits, the token 8", [](graph& g) { g.ports[0].fields[0].width = 7; }},
      {"the fields have 0 bits, the token 8", [](graph& g) { g.ports[0].fields.clear(); }},
      {"a call port must be an input", [](graph& g) { g.ports[1].kind = port_kind::call; }},
      {"a result port must be an output", [](graph& g) { g.ports[0].kind = port_kind::result; }},
      {"port 0 'in' (file 3, line 7): there is no file 3", [](graph& g) { g.ports[0].where.file = 3; }},
      {"memory 0 'ram' (small.cpp:7): it has no words", [](graph& g) { g.memories[0].words = 0; }},
      {"memory 0 'ram' (small.cpp:7): width 0 is not", [](graph& g) { g.memories[0].width = 0; }},
      {"distance 0, which must be at least 1", [](graph& g) { g.memories[0].distance = 0; }},
      {"3 initial values for 4 words", [](graph& g) { g.memories[0].initial.pop_back(); }},
      {"an initial value has 9 bits instead of 8", [](graph& g) { g.memories[0].initial[2] = APInt(9, 0); }},
      {"memory 0 'ram' (file 1, line 7): there is no file 1", [](graph& g) { g.memories[0].where.file = 1; }},
      {"table 0 'rom': width 0 is not", [](graph& g) { g.tables[0].width = 0; }},
      {"table 0 'rom': a value has 7 bits instead of 8", [](graph& g) { g.tables[0].values[1] = APInt(7, 0); }},
      {"there is no file 2", [](graph& g) { g.tables[0].where = {2, 1}; }},
      {"register 0 'state' (small.cpp:7): width 70000 is not",
       [](graph& g) {
         g.registers[0].width = 70000;
         g.nodes[3].width = 70000;
         g.nodes[3].kind = operation::constant;
         g.nodes[3].value = APInt(8, 0);
         g.nodes[3].width = 8;
       }},
      {"the initial value has 4 bits instead of 8", [](graph& g) { g.registers[0].initial = APInt(4, 0); }},
      {"its next value is no node", [](graph& g) { g.registers[0].next = none; }},
      {"its enable is no node", [](graph& g) { g.registers[0].enable = 17; }},
      {"its next value has 16 bits instead of 8", [](graph& g) { g.registers[0].next = 11; }},
      {"its enable is not one bit wide", [](graph& g) { g.registers[0].enable = 11; }},
      {"it is patient but no iteration is marked patient",
       [](graph& g) {
         g.registers[0].patient = true;
         g.patient = none;
       }},
      {"register 0 'state' (file 8, line 7): there is no file 8", [](graph& g) { g.registers[0].where.file = 8; }},
      {"patient: there is no node 17", [](graph& g) { g.patient = 17; }},
      {"patient: node 8 is not one bit wide", [](graph& g) { g.patient = 8; }},
      {"node 0 (unknown) (small.cpp:7): the operation is unknown",
       [](graph& g) { g.nodes[0].kind = static_cast<operation>(99); }},
      {"node 0 (constant) (small.cpp:7): width 0 is not in", [](graph& g) { g.nodes[0].width = 0; }},
      {"node 6 (memory_write) (small.cpp:7): width 8 is not 0", [](graph& g) { g.nodes[6].width = 8; }},
      {"operand 0 (node 8) does not stand before it", [](graph& g) { g.nodes[8].operands[0] = 8; }},
      {"operand 1 (node 4294967295) does not stand before it", [](graph& g) { g.nodes[8].operands[1] = none; }},
      {"operand 0 (node 6) has no value", [](graph& g) { g.nodes[8].operands[0] = 6; }},
      {"the value has 2 bits instead of 1", [](graph& g) { g.nodes[0].value = APInt(2, 0); }},
      {"node 3 (constant) (small.cpp:7): 1 operands instead of 0",
       [](graph& g) {
         g.nodes[3].kind = operation::constant;
         g.nodes[3].value = APInt(8, 0);
         g.nodes[3].operands = {0};
       }},
      {"there is no port 2", [](graph& g) { g.nodes[2].object = 2; }},
      {"port 'out' is an output", [](graph& g) { g.nodes[2].object = 1; }},
      {"port 'in' is an input",
       [](graph& g) {
         g.nodes[16].object = 0;
         g.nodes[2] = g.nodes[0];
         g.nodes[2].width = 8;
         g.nodes[2].value = APInt(8, 0);
       }},
      {"port 'out' is accessed a second time", [](graph& g) { g.nodes.push_back(g.nodes[16]); }},
      {"7 bits, the token of 'in' 8", [](graph& g) { g.nodes[2].width = 7; }},
      {"node 2 (read) (small.cpp:7): 0 operands instead of 1", [](graph& g) { g.nodes[2].operands.clear(); }},
      {"node 16 (write) (small.cpp:7): operand 0 has 16 bits instead of 1",
       [](graph& g) { g.nodes[16].operands[0] = 11; }},
      {"node 16 (write) (small.cpp:7): operand 1 has 16 bits instead of 20",
       [](graph& g) { g.nodes[16].operands[1] = 11; }},
      {"there is no register 1", [](graph& g) { g.nodes[3].object = 1; }},
      {"9 bits, the register 8", [](graph& g) { g.nodes[3].width = 9; }},
      {"there is no memory 1", [](graph& g) { g.nodes[5].object = 1; }},
      {"9 bits, a word of the memory 8", [](graph& g) { g.nodes[5].width = 9; }},
      {"node 5 (memory_read) (small.cpp:7): operand 1 has 2 bits instead of 1",
       [](graph& g) { g.nodes[5].operands[1] = 4; }},
      {"node 6 (memory_write) (small.cpp:7): operand 1 has 2 bits instead of 8",
       [](graph& g) { g.nodes[6].operands[1] = 4; }},
      {"there is no table 1", [](graph& g) { g.nodes[7].object = 1; }},
      {"9 bits, a word of the table 8", [](graph& g) { g.nodes[7].width = 9; }},
      {"node 8 (add) (small.cpp:7): operand 1 has 2 bits instead of 8", [](graph& g) { g.nodes[8].operands[1] = 4; }},
      {"node 14 (bit_not) (small.cpp:7): 2 operands instead of 1", [](graph& g) { g.nodes[14].operands.push_back(0); }},
      {"node 13 (shift_left) (small.cpp:7): operand 0 has 16 bits instead of 20",
       [](graph& g) { g.nodes[13].operands[0] = 11; }},
      {"the result must be one bit wide", [](graph& g) { g.nodes[9].width = 8; }},
      {"node 9 (less_signed) (small.cpp:7): operand 0 has 8 bits instead of 2",
       [](graph& g) { g.nodes[9].operands[1] = 4; }},
      {"node 9 (less_signed) (small.cpp:7): 1 operands instead of 2", [](graph& g) { g.nodes[9].operands.pop_back(); }},
      {"node 10 (select) (small.cpp:7): operand 0 has 8 bits instead of 1",
       [](graph& g) { g.nodes[10].operands[0] = 8; }},
      {"it needs at least two operands", [](graph& g) { g.nodes[11].operands.pop_back(); }},
      {"16 bits, its operands 10", [](graph& g) { g.nodes[11].operands[0] = 4; }},
      {"bits 7 and 2 more of an operand of 8", [](graph& g) { g.nodes[4].low = 7; }},
      {"bits 4294967295 and 2 more of an operand of 8", [](graph& g) { g.nodes[4].low = 0xffffffffu; }},
      {"it does not widen its operand of 16 bits", [](graph& g) { g.nodes[12].width = 16; }},
      {"node 8 (add) (file 4, line 7): there is no file 4", [](graph& g) { g.nodes[8].where.file = 4; }},
  };
  for (const broken& b : cases) {
    graph g = legal().g;
    b.damage(g);
    EXPECT_NE(find_violation(g).find(b.expected), std::string::npos)
        << "expected: " << b.expected << "\nfound: " << find_violation(g);
  }
}

}  // namespace
}  // namespace epiline::dataflow
