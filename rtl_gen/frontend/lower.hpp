#pragma once
// From clang's IR to one function in which everything is inlined, constant loops are unrolled, state is in SSA values,
// and ports, memories and tables appear only as the calls of vocabulary.hpp.

#include <llvm/IR/Function.h>

#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "frontend/processes.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

struct lowered_process {
  llvm::Function* function = nullptr;
  source_place top_place;
  std::vector<dataflow::port> ports;
  dataflow::port
      whole_call;  // all scalars of the top, of which the process may use some; without fields: there are none
  std::vector<dataflow::memory> memories;
  std::vector<dataflow::table> tables;
  std::vector<source_place> memory_places;  // of memories, in order
  std::vector<source_place> table_places;
  unsigned initiation_interval = 1;  // the largest one a PIPELINE pragma allows
  std::vector<std::string> notes;    // "FILE:LINE: note: ..."
};

/// Lowers the module in place. Throws `refused` for what the flow does not support.
[[nodiscard]] lowered_process lower(process_source& source);

}  // namespace epiline::frontend
