#pragma once
// The top as the user wrote it: where it stands and what its parameters are called.

#include <llvm/IR/Function.h>
#include <llvm/IR/Module.h>

#include <map>
#include <set>
#include <string>

#include "frontend/source.hpp"

namespace epiline::frontend {

/// What only the debug information knows of the top.
struct top_description {
  source_place place;
  std::map<unsigned, std::string> parameters;  // names, by index from 0
};

/// The function of that name, with or without its scopes, that has a body; null: there is none.
[[nodiscard]] llvm::Function* find_top(llvm::Module& module, const std::string& top);

/// Each stream of an array counts as a parameter, and what is returned as the last. Refuses a top that ports cannot be
/// made of: one without parameters, or with two of the same name.
[[nodiscard]] top_description describe_top(const llvm::Function& top, llvm::Module& module);

/// A name like the wanted one that neither is in `taken`, to which it is added, nor a parameter's.
[[nodiscard]] std::string fresh_name(const std::string& wanted, const top_description& top,
                                     std::set<std::string>& taken);

}  // namespace epiline::frontend
