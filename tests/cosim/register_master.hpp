#pragma once
// An AXI4-Lite master for the stream driver: writes and reads of registers become tokens of the slave's five channels,
// kept in order only where order means something. Knows a module's registers from its register map in JSON.

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "cosim/stream_driver.hpp"

namespace epiline::cosim {

struct mapped_register {
  unsigned address = 0;
  unsigned words = 1;
  unsigned width = 1;
  unsigned offset = 0;  // of an argument, in the token of all arguments
  bool is_signed = false;
  bool is_argument = false;
};

inline std::map<std::string, mapped_register> read_register_map(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file);
  std::map<std::string, mapped_register> registers;
  const nlohmann::json map = nlohmann::json::parse(stream);
  for (const nlohmann::json& entry : map.at("registers")) {
    const bool is_argument = entry.at("kind") == "argument";
    registers[entry.at("name")] = {.address = entry.at("address"),
                                   .words = entry.at("words"),
                                   .width = entry.at("width"),
                                   .offset = is_argument ? entry.at("offset").get<unsigned>() : 0,
                                   .is_signed = entry.at("signed"),
                                   .is_argument = is_argument};
  }
  return registers;
}

class register_master {
 public:
  static constexpr std::uint32_t okay = 0;
  static constexpr std::uint32_t slave_error = 2;
  static constexpr unsigned control = 0x0;  // address, and its bits
  static constexpr std::uint32_t start = 1, hold = 2, keep = 4;
  static constexpr unsigned calls = 0x4;

  /// A condition on what has passed so far; empty: holds.
  using condition = std::function<bool(const drive_result&)>;

  void write(unsigned address, std::uint32_t data, std::uint32_t strobe = 0xf, std::uint32_t response = okay) {
    writes_.push_back({address, data, strobe, response, reads_.size(), only_when_});
    only_when_ = {};
  }

  /// The value, of `words` words, of one register, in a random order of its words.
  template <class Random>
  void write_register(const mapped_register& where, std::span<const std::uint32_t> token, Random& random) {
    std::vector<unsigned> order(where.words);
    for (unsigned word = 0; word < where.words; ++word) order[word] = word;
    std::shuffle(order.begin(), order.end(), random);
    for (const unsigned word : order) {
      const unsigned bits = std::min(32u, where.width - 32 * word);
      const auto junk = static_cast<std::uint32_t>(random());  // bits that the register does not have
      std::vector<std::uint32_t> data{junk};
      set_bits_at(data, 0, bits, bits_at(token, where.offset + 32 * word, bits));
      write(where.address + 4 * word, data[0]);
    }
  }

  /// `expected` is what the slave must answer.
  void read(unsigned address, std::uint32_t expected, std::uint32_t response = okay) {
    reads_.push_back({address, expected, response, writes_.size(), only_when_});
    only_when_ = {};
  }

  /// The next write or read comes only when this holds.
  void only_when(condition holds) { only_when_ = std::move(holds); }

  [[nodiscard]] std::size_t writes() const { return writes_.size(); }
  /// Whether the first `count` writes have their response.
  static bool written(const drive_result& so_far, std::size_t count) {
    return so_far.outputs.at("s_axi_b").tokens.size() >= count;
  }

  /// Adds the master's tokens; `others` decides about the ports that are not the slave's. The master must live until
  /// the request was played.
  void play(drive_request& request, const rtl_model& model,
            std::function<bool(const std::string&, std::size_t, const drive_result&)> others = {}) const {
    const auto port = std::ranges::find(model.ports(), std::string("s_axi_aw"), &model_port::name);
    if (port == model.ports().end()) throw std::runtime_error("no AXI4-Lite slave");
    token_list write_addresses(port->width), data(36), read_addresses(port->width);
    for (const write_access& access : writes_) {
      write_addresses.push_integer(access.address);
      data.push_integer(access.data | std::uint64_t{access.strobe} << 32);
    }
    for (const read_access& access : reads_) read_addresses.push_integer(access.address);
    request.inputs["s_axi_aw"] = write_addresses;
    request.inputs["s_axi_w"] = data;
    request.inputs["s_axi_ar"] = read_addresses;
    request.expected["s_axi_b"] = writes_.size();
    request.expected["s_axi_r"] = reads_.size();
    request.may_offer = [this, others = std::move(others)](const std::string& name, std::size_t index,
                                                           const drive_result& so_far) {
      // A read sees the writes before it, and a write comes after the reads before it: each waits for the responses.
      if (name == "s_axi_aw" || name == "s_axi_w") {
        const write_access& access = writes_[index];
        return so_far.outputs.at("s_axi_r").tokens.size() >= access.after_reads &&
               (!access.only_when || access.only_when(so_far));
      }
      if (name == "s_axi_ar") {
        const read_access& access = reads_[index];
        return written(so_far, access.after_writes) && (!access.only_when || access.only_when(so_far));
      }
      return !others || others(name, index, so_far);
    };
  }

  /// Whether every response is the expected one; the first that is not as text, else "".
  [[nodiscard]] std::string wrong_response(const drive_result& result) const {
    const token_list& responses = result.outputs.at("s_axi_b").tokens;
    for (std::size_t index = 0; index < writes_.size(); ++index) {
      if (responses.integer(index) == writes_[index].response) continue;
      return text("write", index, writes_[index].address, responses.integer(index), writes_[index].response);
    }
    const token_list& words = result.outputs.at("s_axi_r").tokens;
    for (std::size_t index = 0; index < reads_.size(); ++index) {
      const std::uint64_t wanted = reads_[index].expected | std::uint64_t{reads_[index].response} << 32;
      if (words.integer(index) != wanted)
        return text("read", index, reads_[index].address, words.integer(index), wanted);
    }
    return "";
  }

 private:
  struct write_access {
    unsigned address;
    std::uint32_t data, strobe, response;
    std::size_t after_reads;
    condition only_when;
  };
  struct read_access {
    unsigned address;
    std::uint32_t expected, response;
    std::size_t after_writes;
    condition only_when;
  };

  static std::string text(const char* what, std::size_t index, unsigned address, std::uint64_t got,
                          std::uint64_t wanted) {
    std::ostringstream line;
    line << what << ' ' << index << " of address 0x" << std::hex << address << ": answered 0x" << got << ", not 0x"
         << wanted;
    return line.str();
  }

  std::vector<write_access> writes_;
  std::vector<read_access> reads_;
  condition only_when_;
};

}  // namespace epiline::cosim
