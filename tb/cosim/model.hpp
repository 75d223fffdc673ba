#pragma once
// A generated module in simulation, seen only through the RTL interface: clock, reset and ports of valid, ready and
// payload. Verilator is hidden behind it; tb/cosim/make_model.py writes the binding of each module.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace epiline::cosim {

enum class port_kind : std::uint8_t {
  stream,    // s_axis_NAME_* or m_axis_NAME_*
  call,      // the scalars by value: one token a call of the top
  result,    // a scalar by reference: one token a call
  axi_lite,  // a channel of the AXI4-Lite slave: s_axi_aw, s_axi_w, s_axi_b, s_axi_ar, s_axi_r
};

/// One signal of a port's payload.
struct model_field {
  std::string name;     // "tdata", "tlast", ...; of a call port the scalar's name
  unsigned width = 1;   // bits
  unsigned offset = 0;  // its lowest bit in the token
};

struct model_port {
  std::string name;
  port_kind kind = port_kind::stream;
  bool input = true;
  unsigned width = 1;  // bits of a token
  std::vector<model_field> fields;

  /// The field of that name, or null.
  [[nodiscard]] const model_field* find(std::string_view field_name) const {
    for (const model_field& field : fields) {
      if (field.name == field_name) return &field;
    }
    return nullptr;
  }
};

/// A FIFO between two processes inside of the module.
struct model_fifo {
  std::string name;  // of the stream in the source
  std::string instance;
  unsigned depth = 0;  // tokens it holds
};

/// What is in it: now, and the most since reset.
struct fifo_fill {
  unsigned now = 0;
  unsigned peak = 0;
};

/// One instance of a module. A port is named by its index in ports().
///
/// A clock period of a test is: set the inputs, settle(), look at the outputs, rising_edge(). Outputs are meaningful
/// only after settle().
class rtl_model {
 public:
  rtl_model() = default;
  rtl_model(const rtl_model&) = delete;
  rtl_model& operator=(const rtl_model&) = delete;
  virtual ~rtl_model() = default;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<model_port>& ports() const { return ports_; }

  /// The FIFOs between its processes, and what is in one, by its index; empty if the model does not tell.
  [[nodiscard]] const std::vector<model_fifo>& fifos() const { return fifos_; }
  [[nodiscard]] virtual std::optional<fifo_fill> fill([[maybe_unused]] std::size_t fifo) const { return {}; }

  virtual void set_reset(bool active) = 0;
  /// Clock low; combinational logic follows the inputs.
  virtual void settle() = 0;
  virtual void rising_edge() = 0;

  /// Payload and tvalid of an input port; tready of it. `token` holds (width + 31) / 32 words.
  virtual void set_token(std::size_t port, const std::uint32_t* token) = 0;
  virtual void set_valid(std::size_t port, bool value) = 0;
  [[nodiscard]] virtual bool ready(std::size_t port) const = 0;

  /// Payload and tvalid of an output port; tready of it.
  virtual void get_token(std::size_t port, std::uint32_t* token) const = 0;
  [[nodiscard]] virtual bool valid(std::size_t port) const = 0;
  virtual void set_ready(std::size_t port, bool value) = 0;

 protected:
  std::string name_;
  std::vector<model_port> ports_;
  std::vector<model_fifo> fifos_;
};

}  // namespace epiline::cosim
