#pragma once

#include <llvm/IR/Module.h>

namespace epiline::frontend {

/// Whether the source has objects of hls::task.
[[nodiscard]] bool has_tasks(const llvm::Module& module);

/// Where an hls::task is made, its function is called: a process like those of DATAFLOW.
/// Refuses functions that are known only at run time, or take anything but streams.
void call_tasks(llvm::Module& module);

}  // namespace epiline::frontend
