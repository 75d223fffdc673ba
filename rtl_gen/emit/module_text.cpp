#include "emit/module_text.hpp"

#include <algorithm>

namespace epiline::emit {

std::string module_text::comment(dataflow::source_location where) const {
  const std::string place = place_text(g, where);
  return place.empty() ? "" : "  // " + place;
}

const std::string& module_text::array_read_by(dataflow::node_id read) const {
  const std::size_t memory = g.nodes[read].object;
  const std::vector<read_port>& ports = plan.memories[memory].reads;
  const auto port = std::find_if(ports.begin(), ports.end(), [read](const read_port& one) {
    return std::find(one.reads.begin(), one.reads.end(), read) != one.reads.end();
  });
  return names.memories[memory].at(static_cast<std::size_t>(port - ports.begin()));
}

void module_text::write_moves(const move_list& moves) {
  if (moves.empty()) return;
  line("  always @(posedge clk) begin");
  for (const auto& [target, source] : moves) line("    {} <= {};", target, source);
  line("  end");
}

void module_text::write_copy(const std::string& name, unsigned width, const std::string& source) {
  has_copies = true;
  line("  wire {}{};", range_of(width), name);
  line("  epiline_copy #(.WIDTH({})) {}_register (.clk(clk), .d({}), .q({}));", width, name, source, name);
}

}  // namespace epiline::emit
