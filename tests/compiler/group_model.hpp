#pragma once
// One module of many that stand in a single Verilator model (written by verilator_group.py): all of a module's signals
// lie in two wide ports of the model, one for each direction, so that a table tells how to drive it and no C++ has to
// be compiled for each module.

#include <verilated.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <vector>

#include "cosim/verilated_model.hpp"

namespace epiline::compiler_test {

/// The signals of one module in the model.
struct member_signals {
  CData* clk;
  CData* rst;
  EData* in;
  const EData* out;
};

/// The model, without its type.
class verilated_group {
 public:
  verilated_group() = default;
  verilated_group(const verilated_group&) = delete;
  verilated_group& operator=(const verilated_group&) = delete;
  virtual ~verilated_group() = default;
  virtual void eval() = 0;
  virtual void final() = 0;
  virtual member_signals signals(unsigned member) = 0;
};

/// A port: `valid`, `ready` and `token` are indices of 32-bit words, of the inputs where the module reads them and of
/// the outputs where it drives them. Token words are as in cosim::token_list.
struct member_port {
  const char* name;
  cosim::port_kind kind;
  bool input;
  unsigned width;  // of a token, in bits
  unsigned valid, ready, token;
};
struct member_field {
  unsigned port;
  const char* name;
  unsigned width, offset;
};
struct member_fifo {
  const char* name;
  const char* instance;
  unsigned depth;
};
/// One module; `index` is what verilated_group::signals() takes.
struct member_table {
  const char* module;
  unsigned index;
  const member_port* ports;
  unsigned port_count;
  const member_field* fields;
  unsigned field_count;
  const member_fifo* fifos;
  unsigned fifo_count;
};
using make_group = std::unique_ptr<verilated_group> (*)(VerilatedContext*);

/// What cosim::verilated_model expects of a class that Verilator wrote.
class group_member {
 public:
  group_member(VerilatedContext* context, make_group make, unsigned index)
      : group_(make(context)), signals_(group_->signals(index)), clk(*signals_.clk), rst(*signals_.rst) {}
  void eval() { group_->eval(); }
  void final() { group_->final(); }
  [[nodiscard]] EData* in() const { return signals_.in; }
  [[nodiscard]] const EData* out() const { return signals_.out; }

 private:
  std::unique_ptr<verilated_group> group_;
  member_signals signals_;

 public:
  CData& clk;
  CData& rst;
};

class group_model final : public cosim::verilated_model<group_member> {
 public:
  group_model(std::uint64_t seed, make_group make, const member_table& table)
      : verilated_model(seed, make, table.index), table_(table) {
    name_ = table.module;
    for (unsigned i = 0; i < table.port_count; ++i) {
      const member_port& port = table.ports[i];
      ports_.push_back({port.name, port.kind, port.input, port.width, {}});
    }
    for (unsigned i = 0; i < table.field_count; ++i) {
      const member_field& field = table.fields[i];
      ports_[field.port].fields.push_back({field.name, field.width, field.offset});
    }
    for (unsigned i = 0; i < table.fifo_count; ++i)
      fifos_.push_back({table.fifos[i].name, table.fifos[i].instance, table.fifos[i].depth});
  }

  void set_token(std::size_t port, const std::uint32_t* token) override {
    std::memcpy(top_->in() + table_.ports[port].token, token, bytes(port));
  }
  void set_valid(std::size_t port, bool value) override { top_->in()[table_.ports[port].valid] = value ? 1 : 0; }
  bool ready(std::size_t port) const override { return top_->out()[table_.ports[port].ready] != 0; }
  void get_token(std::size_t port, std::uint32_t* token) const override {
    std::memcpy(token, top_->out() + table_.ports[port].token, bytes(port));
  }
  bool valid(std::size_t port) const override { return top_->out()[table_.ports[port].valid] != 0; }
  void set_ready(std::size_t port, bool value) override { top_->in()[table_.ports[port].ready] = value ? 1 : 0; }

 private:
  [[nodiscard]] std::size_t bytes(std::size_t port) const { return (table_.ports[port].width + 31) / 32 * 4; }
  const member_table& table_;
};

}  // namespace epiline::compiler_test
