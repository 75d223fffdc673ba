#pragma once
// The C library's mathematics, for code that runs when the source is compiled: the functions of this machine's library,
// which are those that the program natively calls.

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/StringRef.h>
#include <llvm/IR/Constants.h>

namespace epiline::frontend {

/// Whether the C library's function of that name takes and gives numbers only (`cos`, `expf`, `ldexp`).
[[nodiscard]] bool is_host_mathematics(llvm::StringRef name);

/// What the function gives for these arguments; null where they are not numbers that it takes.
[[nodiscard]] llvm::Constant* call_host_mathematics(llvm::StringRef name, llvm::Type* result,
                                                    llvm::ArrayRef<llvm::Constant*> arguments);

}  // namespace epiline::frontend
