#include "emit/module_text.hpp"

namespace epiline::emit {

std::string module_text::comment(dataflow::source_location where) const {
  const std::string place = place_text(g, where);
  return place.empty() ? "" : "  // " + place;
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
