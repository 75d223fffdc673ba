#include "emit/interface.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "emit/register_map.hpp"
#include "emit/text.hpp"

namespace epiline::emit {

namespace {

rtl_port describe(const dataflow::port& port) {
  rtl_port described{.name = port.name,
                     .kind = name_of(port.kind),
                     .input = port.input,
                     .width = port.width,
                     .valid = signal_name(port, "tvalid"),
                     .ready = signal_name(port, "tready"),
                     .fields = {},
                     .where = port.where};
  for (const dataflow::field& f : port.fields) {
    described.fields.push_back({f.name, f.signal, signal_name(port, f.signal), f.width, f.offset, f.is_signed});
  }
  return described;
}

rtl_port channel(const std::string& name, bool input, dataflow::source_location where,
                 const std::vector<std::pair<std::string, unsigned>>& fields) {
  const std::string prefix = "s_axi_" + name;
  rtl_port described{.name = prefix,
                     .kind = "axi_lite",
                     .input = input,
                     .width = 0,
                     .valid = prefix + "valid",
                     .ready = prefix + "ready",
                     .fields = {},
                     .where = where};
  for (const auto& [signal, width] : fields) {
    described.fields.push_back({signal, signal, prefix + signal, width, described.width});
    described.width += width;
  }
  return described;
}

}  // namespace

std::vector<rtl_port> interface_of(const dataflow::graph& g, bool axi_lite) {
  std::vector<rtl_port> ports;
  for (const dataflow::port& port : g.ports) {
    if (axi_lite && port.kind == dataflow::port_kind::call) continue;
    ports.push_back(describe(port));
  }
  if (!axi_lite) return ports;
  const register_map map = make_register_map(g);
  const std::vector<rtl_port> channels = {
      channel("aw", true, map.where, {{"addr", map.address_bits}}),
      channel("w", true, map.where, {{"data", axi_data_bits}, {"strb", axi_data_bits / 8}}),
      channel("b", false, map.where, {{"resp", 2}}),
      channel("ar", true, map.where, {{"addr", map.address_bits}}),
      channel("r", false, map.where, {{"data", axi_data_bits}, {"resp", 2}}),
  };
  ports.insert(ports.begin(), channels.begin(), channels.end());
  return ports;
}

std::string module_head(const dataflow::graph& g, const std::vector<rtl_port>& ports) {
  std::string text = fmt::format("module {} (\n  input  wire clk,\n  input  wire rst", g.name);
  for (const rtl_port& port : ports) {
    text += ",\n";
    const auto put = [&](bool input, unsigned width, const std::string& name) {
      fmt::format_to(std::back_inserter(text), "  {} wire {}{}", input ? "input " : "output", range_of(width), name);
    };
    if (const std::string place = place_text(g, port.where); port.where.line != 0)
      text += (place.empty() ? "" : "  // " + place) + "\n";
    for (const rtl_field& f : port.fields) {
      put(port.input, f.width, f.rtl);
      text += ",\n";
    }
    put(port.input, 1, port.valid);
    text += ",\n";
    put(!port.input, 1, port.ready);
  }
  return text + "\n);\n";
}

std::string signal_name(const dataflow::port& port, std::string_view signal) {
  if (port.kind == dataflow::port_kind::call) {
    if (signal == "tvalid" || signal == "tready") return "call_" + std::string(signal);
    return std::string(signal);
  }
  return std::string(port.input ? "s_axis_" : "m_axis_") + port.name + "_" + std::string(signal);
}

}  // namespace epiline::emit
