#pragma once
// The variables of a process and the parts that they are made of: a part is named by the path of indices to it.

#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Function.h>

#include <cstdint>
#include <string>
#include <vector>

#include "frontend/source.hpp"

namespace epiline::frontend {

/// A variable: a local of the process, a static, or a constant table.
struct variable {
  llvm::Value* base = nullptr;
  llvm::Type* type = nullptr;
  llvm::Constant* initial = nullptr;  // statics and tables
  bool is_constant = false;
  std::string name;
  const llvm::DIType* debug_type = nullptr;
  source_place place;
};

/// Those that the function uses, locals first. Each use of a static or a table becomes an instruction's.
[[nodiscard]] std::vector<variable> find_variables(llvm::Function& function);

/// One index on the way from a variable to a scalar: constant + dynamic, in a struct or an array.
struct path_step {
  llvm::Type* container = nullptr;
  std::int64_t constant = 0;
  llvm::Value* dynamic = nullptr;  // i64, or null

  [[nodiscard]] bool is_array() const { return llvm::isa<llvm::ArrayType>(container); }
  [[nodiscard]] std::uint64_t size() const { return llvm::cast<llvm::ArrayType>(container)->getNumElements(); }
};
using path_steps = std::vector<path_step>;

/// What the step leads to.
[[nodiscard]] llvm::Type* step_type(const path_step& step);

/// The first `count` steps without array indices: what is decided for a dimension is decided for all its elements.
[[nodiscard]] std::string shape_of(const path_steps& path, std::size_t count);

/// The members and constant indices of a path as the source names them: "_lines_3".
[[nodiscard]] std::string path_name(const variable& of, const path_steps& path, const std::vector<bool>& is_address,
                                    const llvm::DataLayout& layout);

}  // namespace epiline::frontend
