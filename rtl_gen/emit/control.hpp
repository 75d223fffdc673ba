#pragma once
// What decides when an iteration is issued and what a reset does: the module's only control. From the issue on nothing
// stops an iteration.

#include <optional>

#include "dataflow/graph.hpp"
#include "emit/module_text.hpp"

namespace epiline::emit {

void write_control_declarations(module_text& m);
/// The reset on its way to the state, where much state is reset.
void write_reset_rows(module_text& m);
/// `fire`, and the counter that keeps issues apart.
void write_issue(module_text& m);
void write_valids(module_text& m);
/// Registers that wait for the pipeline to drain before they change.
void write_patient(module_text& m);

/// The register that says whether the next iteration reads a token of `port`, if there is one whose next value is known
/// when an iteration is issued.
[[nodiscard]] std::optional<dataflow::node_id> need_register(const module_design& m, dataflow::port_id port);

}  // namespace epiline::emit
