// Text form: nothing is lost either way, mistakes are named with their line, hostile texts are refused.
#include "dataflow/text.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "dataflow/random_graph.hpp"
#include "dataflow/small_graph.hpp"

namespace epiline::dataflow {
namespace {

using llvm::APInt;

auto members(const source_location& w) { return std::tie(w.file, w.line); }

/// Field by field, so that the printer cannot hide a loss by printing too little.
void expect_same(const graph& a, const graph& b) {
  EXPECT_EQ(std::tie(a.name, a.files, a.patient), std::tie(b.name, b.files, b.patient));
  ASSERT_EQ(a.ports.size(), b.ports.size());
  for (std::size_t i = 0; i < a.ports.size(); ++i) {
    const port &p = a.ports[i], &q = b.ports[i];
    EXPECT_EQ(std::tie(p.name, p.kind, p.input, p.width), std::tie(q.name, q.kind, q.input, q.width));
    EXPECT_EQ(members(p.where), members(q.where));
    ASSERT_EQ(p.fields.size(), q.fields.size());
    for (std::size_t f = 0; f < p.fields.size(); ++f) {
      const field &x = p.fields[f], &y = q.fields[f];
      EXPECT_EQ(std::tie(x.name, x.signal, x.width, x.offset, x.is_signed),
                std::tie(y.name, y.signal, y.width, y.offset, y.is_signed));
    }
  }
  ASSERT_EQ(a.registers.size(), b.registers.size());
  for (std::size_t i = 0; i < a.registers.size(); ++i) {
    const register_state &r = a.registers[i], &s = b.registers[i];
    EXPECT_EQ(std::tie(r.name, r.width, r.initial, r.resets, r.next, r.enable, r.patient),
              std::tie(s.name, s.width, s.initial, s.resets, s.next, s.enable, s.patient));
    EXPECT_EQ(members(r.where), members(s.where));
  }
  ASSERT_EQ(a.memories.size(), b.memories.size());
  for (std::size_t i = 0; i < a.memories.size(); ++i) {
    const memory &m = a.memories[i], &n = b.memories[i];
    EXPECT_EQ(std::tie(m.name, m.words, m.width, m.initial, m.distance, m.distance_promised),
              std::tie(n.name, n.words, n.width, n.initial, n.distance, n.distance_promised));
    EXPECT_EQ(members(m.where), members(n.where));
  }
  ASSERT_EQ(a.tables.size(), b.tables.size());
  for (std::size_t i = 0; i < a.tables.size(); ++i) {
    EXPECT_EQ(std::tie(a.tables[i].name, a.tables[i].width, a.tables[i].values, a.tables[i].immediate),
              std::tie(b.tables[i].name, b.tables[i].width, b.tables[i].values, b.tables[i].immediate));
    EXPECT_EQ(members(a.tables[i].where), members(b.tables[i].where));
  }
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const node &n = a.nodes[i], &o = b.nodes[i];
    EXPECT_EQ(std::tie(n.kind, n.width, n.operands, n.object, n.low, n.name),
              std::tie(o.kind, o.width, o.operands, o.object, o.low, o.name));
    if (n.kind == operation::constant) EXPECT_EQ(n.value, o.value);
    EXPECT_EQ(members(n.where), members(o.where));
  }
}

TEST(text, random_graphs_survive_printing_and_parsing) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    graph g = testing::random_graph(seed);
    g.memories[0].distance = 3;
    g.memories[0].distance_promised = true;
    g.memories[1].where = {0, 5};
    g.registers[0].where = {0, 9};
    g.nodes[3].name = "lines_[2].x";
    g.nodes[4].where = {7, 0};
    for (node_id id = 0; id < g.nodes.size(); ++id)
      if (g.nodes[id].width == 1) g.patient = id;
    g.registers[1].patient = true;
    const std::string text = print(g);
    const graph again = parse(text);
    expect_same(g, again);
    EXPECT_EQ(print(again), text);
  }
}

TEST(text, prints_what_the_header_describes) {
  const std::string text =
      "graph \"sum\"\n"
      "file \"sum.cpp\"\n"
      "input stream \"in\" 9 @0:3\n"
      "  field \"value\" \"tdata\" 8 signed\n"
      "  field \"last\" \"tlast\" 1\n"
      "output result \"total\" 16\n"
      "  field \"total\" \"tdata\" 16\n"
      "register \"acc\" 16 initial 0x0 next %5 enable %0 patient @0:5\n"
      "memory \"ram\" 4 words 16 distance 2 promised @0:6\n"
      "  words 0x1 0x2 0x3 0xffff\n"
      "table \"rom\" 8\n"
      "  words 0x1f 0x20\n"
      "%0 = constant 1 0x1\n"
      "%1 = read 9 port 0 (%0) \"beat\" @0:7\n"
      "%2 = slice 8 low 0 (%1)\n"
      "%3 = extend_zero 16 (%2)\n"
      "%4 = register_value 16 register 0 \"acc\"\n"
      "%5 = add 16 (%4, %3)\n"
      "%6 = memory_write 0 memory 0 (%2, %5, %0)\n"
      "%7 = write 0 port 1 (%0, %5)\n"
      "patient %0\n";
  const graph g = parse(text);
  EXPECT_EQ(print(g), text);
  EXPECT_TRUE(g.ports[0].fields[0].is_signed);
  EXPECT_FALSE(g.ports[0].fields[1].is_signed);
  EXPECT_EQ(g.ports[0].fields[1].offset, 8u);
  EXPECT_EQ(g.memories[0].initial[3], APInt(16, 0xffff));
  EXPECT_TRUE(g.registers[0].patient);
  EXPECT_EQ(g.nodes[1].name, "beat");
}

TEST(text, strange_names_and_comments) {
  testing::small_graph s;
  s.g.name = "a \"quoted\" \\ name;\n\t\x01\xff";
  s.write("out", s.read("in", 3));
  s.g.nodes[1].name = "; no comment";
  const graph again = parse(print(s.g));
  expect_same(s.g, again);
  expect_same(s.g, parse("; first\n\n" + print(s.g) + "  ; last\r\n\n"));
}

TEST(text, mistakes_are_named_with_their_line) {
  struct {
    const char* text;
    const char* expected;
  } const cases[] = {
      {"", "line 1: found the end of the text, expected 'graph'"},
      {"\n;\n", "line 3: found the end of the text, expected 'graph'"},
      {"grap", "line 1: found 'grap', expected 'graph'"},
      {"graph g", "line 1: found 'g', expected the graph's name in quotes"},
      {"graph \"g", "line 1: the string has no end, expected '\"'"},
      {"graph \"g\\", "line 1: unknown escape in a string, expected \\\" \\\\ \\n \\t or \\xNN"},
      {"graph \"\\x4\"", "line 1: unknown escape in a string, expected \\\" \\\\ \\n \\t or \\xNN"},
      {"graph \"g\" x", "line 1: found 'x', expected the end of the line"},
      {"graph \"g\"\nnonsense",
       "line 2: found 'nonsense', expected file, input, output, field, register, memory, table, words, patient or %N"},
      {"graph \"g\"\n\x02",
       "line 2: found byte 0x02, expected file, input, output, field, register, memory, table, words, patient or %N"},
      {"graph \"g\"\nfile", "line 2: found the end of the line, expected a file name in quotes"},
      {"graph \"g\"\ninput pipe", "line 2: found 'pipe', expected stream, call or result"},
      {"graph \"g\"\ninput stream \"a\" 0", "line 2: found 0, expected a width from 1 to 65536"},
      {"graph \"g\"\ninput stream \"a\" 99999999999999999999999",
       "line 2: found 99999999999999999999, expected a width from 1 to 65536"},
      {"graph \"g\"\ninput stream \"a\" 8x", "line 2: found '8x', expected a width"},
      {"graph \"g\"\nfield \"a\" \"b\" 1", "line 2: a field stands here, expected it after input or output"},
      {"graph \"g\"\nwords 0x1", "line 2: words stand here, expected them after memory or table"},
      {"graph \"g\"\ninput stream \"a\" 8\nwords 0x1", "line 3: words stand here, expected them after memory or table"},
      {"graph \"g\"\ntable \"t\" 8\nwords 0x100", "line 3: the value does not fit, expected at most 8 bits"},
      {"graph \"g\"\ntable \"t\" 1\nwords 0x2", "line 3: the value does not fit, expected at most 1 bits"},
      {"graph \"g\"\ntable \"t\" 1\nwords 0x", "line 3: found '0x', expected a value 0x..."},
      {"graph \"g\"\ntable \"t\" 1\nwords", "line 3: found the end of the line, expected a value 0x..."},
      {"graph \"g\"\ntable \"t\" 1\nwords 0x0g", "line 3: found '0x0g', expected a value 0x..."},
      {"graph \"g\"\nmemory \"m\" 4294967295 words 65536",
       "line 2: the memories are too large, expected at most 2^32 bits in total"},
      {"graph \"g\"\nmemory \"m\" 0 words 1", "line 2: found 0, expected a number of words from 1 to 4294967295"},
      {"graph \"g\"\nregister \"r\" 1 enable %0", "line 2: found 'enable', expected 'next'"},
      {"graph \"g\"\nregister \"r\" 1 next 0", "line 2: found '0', expected a node %N"},
      {"graph \"g\"\n%1 = constant 1 0x0", "line 2: found node %1, expected %0"},
      {"graph \"g\"\n%0 constant", "line 2: found 'constant', expected '='"},
      {"graph \"g\"\n%0 = ", "line 2: found the end of the line, expected an operation"},
      {"graph \"g\"\n%0 = nop 1", "line 2: found 'nop', expected an operation"},
      {"graph \"g\"\n%0 = constant 0 0x0", "line 2: found width 0, expected a width from 1"},
      {"graph \"g\"\n%0 = read 8 (%0)", "line 2: found '(', expected 'port'"},
      {"graph \"g\"\n%0 = slice 8 (%0)", "line 2: found '(', expected 'low'"},
      {"graph \"g\"\n%0 = add 8 (%0 %0)", "line 2: found '%', expected ')'"},
      {"graph \"g\"\n%0 = constant 8 0x1 @0", "line 2: found the end of the line, expected ':'"},
      {"graph \"g\"\n%0 = add 8 (%0, %0)",
       "line 2: the graph breaks a rule: node 0 (add): operand 0 (node 0) does not stand before it"},
      {"graph \"g\"\npatient %3\npatient %4", "line 3: a second 'patient', expected one at most"},
  };
  for (const auto& c : cases) {
    try {
      (void)parse(c.text);
      ADD_FAILURE() << "accepted: " << c.text;
    } catch (const text_error& error) {
      EXPECT_STREQ(error.what(), c.expected);
    }
  }
}

TEST(text, a_short_text_cannot_ask_for_much_memory) {
  std::string text = "graph \"g\"\ntable \"t\" 65536\nwords";
  for (int i = 0; i < 40000; ++i) text += " 0x0";
  EXPECT_THROW((void)parse(text), text_error);
  std::string fields = "graph \"g\"\ninput stream \"a\" 8\n";
  for (int i = 0; i < 3; ++i) fields += "field \"f\" \"s\" 65536\n";
  EXPECT_THROW((void)parse(fields), text_error);
}

TEST(text, damaged_texts_give_an_error_or_a_legal_graph) {
  std::mt19937_64 random(1);
  unsigned refused = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::string text = print(testing::random_graph(seed));
    for (int i = 0; i < 100; ++i) {
      std::string damaged = text;
      for (std::uint64_t k = 0; k <= random() % 3; ++k) {
        const std::size_t at = random() % damaged.size();
        switch (random() % 4) {
          case 0:
            damaged[at] = static_cast<char>(random());
            break;
          case 1:
            damaged.erase(at, random() % 8);
            break;
          case 2:
            damaged.insert(at, std::to_string(random()));
            break;
          default:
            damaged.resize(at + 1);
        }
      }
      try {
        EXPECT_EQ(find_violation(parse(damaged)), "");
      } catch (const text_error& error) {
        EXPECT_EQ(std::string(error.what()).rfind("line ", 0), 0u);
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 1000u);
}

}  // namespace
}  // namespace epiline::dataflow
