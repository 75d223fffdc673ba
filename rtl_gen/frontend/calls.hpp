#pragma once
// Which functions an instruction or a function calls.

#include <llvm/IR/Function.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>

#include <set>
#include <string>
#include <vector>

namespace epiline::frontend {

/// The function that an instruction calls; null: it is no call, or one through a pointer.
[[nodiscard]] llvm::Function* called_by(const llvm::Instruction& instruction);

/// Whether an instruction calls a function whose name begins so.
[[nodiscard]] bool calls_named(const llvm::Instruction& instruction, llvm::StringRef prefix);

/// The calls of the function of that name: in the whole module, or in one function of it.
[[nodiscard]] std::vector<llvm::CallInst*> calls_of(llvm::Module& module, llvm::StringRef name,
                                                    const llvm::Function* in = nullptr);

/// An operand that the source gives as a number.
[[nodiscard]] unsigned number_in(const llvm::CallInst& call, unsigned operand);

/// The type that a token's or a parameter's tag, an operand, stands for.
[[nodiscard]] llvm::Type* payload_type(const llvm::CallInst& call, unsigned operand);

/// Everything that runs when `root` does, itself included.
[[nodiscard]] std::set<const llvm::Function*> reached_from(const llvm::Function& root);

/// The functions that call themselves, directly or through others: what is called comes before its callers.
[[nodiscard]] std::vector<llvm::Function*> recursive_functions(llvm::Module& module);

/// As the source calls the function, without scopes and parameters.
[[nodiscard]] std::string short_name(const llvm::Function& function);

}  // namespace epiline::frontend
