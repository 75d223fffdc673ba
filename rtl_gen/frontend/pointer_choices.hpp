#pragma once

#include <llvm/IR/Function.h>

namespace epiline::frontend {

/// `condition ? a : b` on objects chooses between addresses: replaces it by a choice between the values behind them,
/// which is what hardware can do. Addresses chosen in ways this cannot follow are left for later steps to refuse.
void resolve_pointer_choices(llvm::Function& function);

}  // namespace epiline::frontend
