#pragma once
// LLVM IR as text, for tests.

#include <gtest/gtest.h>
#include <llvm/AsmParser/Parser.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/SourceMgr.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "frontend/source.hpp"

namespace epiline::frontend {

class small_module {
 public:
  explicit small_module(const std::string& text) {
    llvm::SMDiagnostic error;
    // The layout of x86-64, which clang compiles the tops for.
    module_ = llvm::parseAssemblyString(
        "target datalayout = "
        "\"e-m:e-p270:32:32-p271:32:32-p272:64:64-i64:64-i128:128-f80:128-n8:16:32:64-S128\"\n" +
            text,
        error, context_);
    if (module_ == nullptr)
      throw std::invalid_argument(error.getMessage().str() + ": " + error.getLineContents().str());
  }

  [[nodiscard]] const llvm::Module& module() const { return *module_; }
  [[nodiscard]] llvm::Function& function(const char* name = "f") { return *module_->getFunction(name); }
  [[nodiscard]] llvm::StructType* type(const char* name) { return llvm::StructType::getTypeByName(context_, name); }
  [[nodiscard]] const llvm::DataLayout& layout() const { return module_->getDataLayout(); }

  /// The opcodes of a function in order, without calls of intrinsics about debugging.
  [[nodiscard]] std::vector<std::string> opcodes(const char* name = "f") {
    std::vector<std::string> names;
    for (const llvm::Instruction& instruction : llvm::instructions(function(name))) {
      names.emplace_back(instruction.getOpcodeName());
    }
    return names;
  }
  [[nodiscard]] std::size_t count(const std::string& opcode) {
    const std::vector<std::string> all = opcodes();
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), opcode));
  }
  /// "", or what LLVM finds wrong with the module.
  [[nodiscard]] std::string problem() const {
    std::string text;
    llvm::raw_string_ostream stream(text);
    return llvm::verifyModule(*module_, &stream) ? text : "";
  }

 private:
  llvm::LLVMContext context_;
  std::unique_ptr<llvm::Module> module_;
};

/// What an action is refused with; "" when it is not.
template <class Action>
std::string refusal_of(Action action) {
  try {
    action();
  } catch (const refused& refusal) {
    return refusal.what();
  }
  return "";
}

}  // namespace epiline::frontend
