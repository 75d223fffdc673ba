#include "emit/register_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "emit/text.hpp"

namespace epiline::emit {

using nlohmann::json;

namespace {

constexpr unsigned word_bytes = axi_data_bits / 8;
constexpr unsigned least_address_bits = 12;  // 4 KiB, the smallest block an AXI interconnect hands out

struct described_bit {
  const char* name;
  unsigned low;
  const char* meaning;
};
constexpr described_bit control[] = {
    {"start", start_bit,
     "write 1: the next call starts as soon as the one before is done, whether its input is there or not; reads 1 "
     "until "
     "then; writing 0 changes nothing"},
    {"hold", hold_bit, "1: no call starts by itself when its first input token comes"},
    {"keep", keep_bit,
     "1: calls start with the arguments of the call before (0 before the first), whatever is written meanwhile"},
};
constexpr const char* control_meaning = "when calls start, and with what";
constexpr const char* calls_meaning = "calls started since reset, modulo 2^32";
constexpr const char* unmapped_meaning =
    "every other address, and writes to read-only registers: nothing happens, response SLVERR, reads give 0";

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string address_text(unsigned address) { return fmt::format("0x{:03x}", address); }

std::string argument_meaning(const register_map& map, const argument_register& argument) {
  return fmt::format(
      "argument '{}' of {}, {}", argument.name, map.top,
      argument.is_signed ? "two's complement, read back with its sign repeated" : "read back with zeros above");
}

}  // namespace

unsigned register_map::flip_flops() const {
  constexpr unsigned handshakes = 8;  // ready and there of three channels, valid of two
  constexpr unsigned responses = 2 + 2 + axi_data_bits;
  const unsigned held_inputs = 2 * (address_bits - 2) + axi_data_bits + axi_data_bits / 8;
  constexpr unsigned fixed_registers = control_bits + axi_data_bits;
  return handshakes + responses + held_inputs + fixed_registers + 2 * argument_bits + 1;
}

register_map make_register_map(const dataflow::graph& g) {
  const auto call = std::find_if(g.ports.begin(), g.ports.end(),
                                 [](const dataflow::port& port) { return port.kind == dataflow::port_kind::call; });
  if (call == g.ports.end()) {
    throw std::invalid_argument(fmt::format(
        "--axi-lite: the top '{}' has no scalar arguments to put into registers: leave the option out", g.name));
  }
  register_map map;
  map.top = g.name;
  map.where = call->where;
  map.place = place_text(g, call->where);
  map.argument_bits = call->width;
  map.waits_for_input = std::any_of(g.ports.begin(), g.ports.end(), [](const dataflow::port& port) {
    return port.input && port.kind == dataflow::port_kind::stream;
  });
  unsigned address = first_argument_address;
  for (const dataflow::field& f : call->fields) {
    const unsigned words = (f.width + axi_data_bits - 1) / axi_data_bits;
    map.arguments.push_back({f.signal, address, words, f.width, f.offset, f.is_signed});
    address += words * word_bytes;
  }
  map.address_bits = std::max(least_address_bits, static_cast<unsigned>(std::bit_width(address - 1)));
  return map;
}

json to_json(const register_map& map) {
  json bits = json::array();
  for (const described_bit& bit : control) {
    bits.push_back({{"name", bit.name}, {"low", bit.low}, {"width", 1}, {"meaning", bit.meaning}});
  }
  const auto entry = [](std::string_view name, std::string_view kind, unsigned address, unsigned words, unsigned width,
                        bool is_signed, std::string_view access, std::string_view meaning) {
    return json{{"name", name},        {"kind", kind},     {"address", address}, {"words", words},    {"width", width},
                {"signed", is_signed}, {"access", access}, {"reset", 0},         {"meaning", meaning}};
  };
  json registers = json::array();
  registers.push_back(
      entry("control", "control", control_address, 1, control_bits, false, "read-write", control_meaning));
  registers.back()["bits"] = bits;
  registers.push_back(entry("calls", "status", calls_address, 1, axi_data_bits, false, "read-only", calls_meaning));
  for (const argument_register& argument : map.arguments) {
    registers.push_back(entry(argument.name, "argument", argument.address, argument.words, argument.width,
                              argument.is_signed, "read-write", argument_meaning(map, argument)));
    registers.back()["offset"] = argument.offset;
  }
  return {{"schema", "epiline-registers/1"},
          {"top", map.top},
          {"prefix", "s_axi"},
          {"data_bits", axi_data_bits},
          {"address_bits", map.address_bits},
          {"calls_wait_for_input", map.waits_for_input},
          {"unmapped", unmapped_meaning},
          {"registers", registers}};
}

std::string to_markdown(const register_map& map) {
  std::string text = fmt::format(
      "# Registers of {}\n\nMade by epiline-hls{}. AXI4-Lite slave `s_axi_*`, {} bits of data, {} bits of address. "
      "Every register is 0 after reset.\n\n| address | bits | name | access | meaning |\n|---|---|---|---|---|\n",
      map.top, map.place.empty() ? "" : " from " + map.place, axi_data_bits, map.address_bits);
  const auto row = [&](unsigned address, const std::string& bits, std::string_view name, std::string_view access,
                       std::string_view meaning) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", address_text(address), bits, name, access, meaning);
  };
  for (const described_bit& bit : control) {
    row(control_address, fmt::format("{}", bit.low), fmt::format("control: `{}`", bit.name), "read-write", bit.meaning);
  }
  row(calls_address, "31..0", "calls", "read-only", calls_meaning);
  for (const argument_register& argument : map.arguments) {
    for (unsigned word = 0; word < argument.words; ++word) {
      const unsigned low = word * axi_data_bits;
      const unsigned width = std::min(axi_data_bits, argument.width - low);
      const std::string bits = width == 1 ? "0" : fmt::format("{}..0", width - 1);
      const std::string part = argument.words == 1 ? ""
                               : width == 1        ? fmt::format("[{}]", low)
                                                   : fmt::format("[{}:{}]", low + width - 1, low);
      row(argument.address + word * word_bytes, bits, fmt::format("`{}`{}", argument.name, part), "read-write",
          word == 0 ? argument_meaning(map, argument) : "continued");
    }
  }
  text += fmt::format("\nUnmapped: {}.\n\n", unmapped_meaning);
  text += map.waits_for_input
              ? "A call starts, and takes the arguments as they are at that moment, when the call before is done and "
                "the first token of an input stream waits.\n"
              : "The top has no input stream: every call is started with the bit `start`, and takes the arguments as "
                "they are then.\n";
  return text;
}

std::string to_c_header(const register_map& map) {
  const std::string& top = map.top;
  const std::string guard = upper_case(top) + "_REGISTERS_H";
  std::string text = fmt::format(
      "/* Registers of {}: made by epiline-hls{}.\n"
      "   `registers` is where the AXI4-Lite slave is mapped. Addresses are in bytes. */\n"
      "#ifndef {}\n#define {}\n\n#include <stdint.h>\n\n",
      top, map.place.empty() ? "" : " from " + map.place, guard, guard);
  const auto define = [&](const std::string& name, const std::string& value) {
    text += fmt::format("#define {}_{} {}\n", top, name, value);
  };
  text += fmt::format("/* {}. */\n", control_meaning);
  define("CONTROL", address_text(control_address) + "u");
  for (const described_bit& bit : control) {
    text += fmt::format("/* {}. */\n", bit.meaning);
    define("CONTROL_" + upper_case(bit.name), fmt::format("0x{:x}u", 1u << bit.low));
  }
  text += fmt::format("/* {}; read-only. */\n", calls_meaning);
  define("CALLS", address_text(calls_address) + "u");
  for (const argument_register& argument : map.arguments) {
    text += fmt::format("\n/* {}. */\n", argument_meaning(map, argument));
    define(argument.name + "_ADDRESS", address_text(argument.address) + "u");
    define(argument.name + "_BITS", fmt::format("{}", argument.width));
    define(argument.name + "_WORDS", fmt::format("{}", argument.words));
    define(argument.name + "_SIGNED", argument.is_signed ? "1" : "0");
  }

  const auto at = [&](const std::string& name, unsigned word) {
    const std::string index = fmt::format("{}_{} / {}", top, name, word_bytes);
    return fmt::format("registers[{}{}]", index, word == 0 ? "" : fmt::format(" + {}", word));
  };
  const std::string control_word = at("CONTROL", 0);
  const std::string others = fmt::format("({} & ~{}_CONTROL_START)", control_word, top);
  const auto function = [&](std::string_view comment, std::string_view type, std::string_view name, bool writes,
                            const std::string& parameter, const std::string& body) {
    text += fmt::format("\n{}static inline {} {}_{}({}volatile uint32_t* registers{}) {{\n{}}}\n",
                        comment.empty() ? "" : fmt::format("/* {} */\n", comment), type, top, name,
                        writes ? "" : "const ", parameter, body);
  };
  function("The next call starts as soon as the one before is done, whether its input is there or not.", "void",
           "start", true, "", fmt::format("  {} |= {}_CONTROL_START;\n", control_word, top));
  function("No call starts by itself from now on.", "void", "hold", true, "",
           fmt::format("  {} = {} | {}_CONTROL_HOLD;\n", control_word, others, top));
  function("Calls start by themselves again when their input comes.", "void", "release", true, "",
           fmt::format("  {} = {} & ~{}_CONTROL_HOLD;\n", control_word, others, top));
  function("What is set between begin_update and end_update takes effect in one and the same call.", "void",
           "begin_update", true, "", fmt::format("  {} = {} | {}_CONTROL_KEEP;\n", control_word, others, top));
  function("", "void", "end_update", true, "",
           fmt::format("  {} = {} & ~{}_CONTROL_KEEP;\n", control_word, others, top));
  function("Calls started since reset, modulo 2^32.", "uint32_t", "calls", false, "",
           fmt::format("  return {};\n", at("CALLS", 0)));
  for (const argument_register& argument : map.arguments) {
    const std::string address = argument.name + "_ADDRESS";
    const std::string set = "set_" + argument.name;
    const std::string get = "get_" + argument.name;
    if (argument.words == 1) {
      const char* const type = argument.is_signed ? "int32_t" : "uint32_t";
      function("", "void", set, true, fmt::format(", {} value", type),
               fmt::format("  {} = (uint32_t)value;\n", at(address, 0)));
      function("", type, get, false, "", fmt::format("  return ({}){};\n", type, at(address, 0)));
    } else if (argument.words == 2) {
      const char* const type = argument.is_signed ? "int64_t" : "uint64_t";
      function("", "void", set, true, fmt::format(", {} value", type),
               fmt::format("  {} = (uint32_t)(uint64_t)value;\n  {} = (uint32_t)((uint64_t)value >> {});\n",
                           at(address, 0), at(address, 1), axi_data_bits));
      function(
          "", type, get, false, "",
          fmt::format("  const uint64_t low = {};\n  const uint64_t high = {};\n  return ({})(high << {} | low);\n",
                      at(address, 0), at(address, 1), type, axi_data_bits));
    } else {
      const std::string index = fmt::format("{}_{} / {} + word", top, address, word_bytes);
      const std::string loop =
          fmt::format("  int word;\n  for (word = 0; word < {}_{}_WORDS; ++word) ", top, argument.name);
      function("Low words first.", "void", set, true, fmt::format(", const uint32_t value[{}]", argument.words),
               fmt::format("{}registers[{}] = value[word];\n", loop, index));
      function("", "void", get, false, fmt::format(", uint32_t value[{}]", argument.words),
               fmt::format("{}value[word] = registers[{}];\n", loop, index));
    }
  }
  return text + fmt::format("\n#endif /* {} */\n", guard);
}

}  // namespace epiline::emit
