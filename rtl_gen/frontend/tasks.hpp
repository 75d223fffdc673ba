#pragma once

#include <llvm/IR/Module.h>

#include <set>

namespace epiline::frontend {

/// Whether the source has objects of hls::task.
[[nodiscard]] bool has_tasks(const llvm::Module& module);

/// Where an hls::task is given its function, that is called: a process like those of DATAFLOW. Returns the functions in
/// which this is done, constructors of channels (hls_np_channel.h) among them.
/// Refuses functions that are known only at run time, or take anything but streams.
std::set<const llvm::Function*> call_tasks(llvm::Module& module);

}  // namespace epiline::frontend
