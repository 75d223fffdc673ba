#pragma once
// Runs code of the source while it is compiled: what fills tables before a program begins, or before it looks at its
// input. A value that only the hardware will know ends the run.

#include <llvm/ADT/DenseMap.h>
#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/DataLayout.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/Operator.h>

#include <cstdint>
#include <map>
#include <vector>

namespace epiline::frontend {

class compile_time_run {
 public:
  /// Some seconds: a table of 65536 words with a few hundred operations a word.
  static constexpr std::uint64_t most_steps_of_a_table = 30'000'000;

  /// A run of more instructions than `most_steps` counts as one of which something is not known.
  explicit compile_time_run(const llvm::Module& module, std::uint64_t most_steps = most_steps_of_a_table)
      : layout_(module.getDataLayout()), most_steps_(most_steps) {}

  /// Runs a function without parameters to its end. Returns whether everything was known.
  bool run_function(const llvm::Function& function);

  /// What a call with constant arguments returns, which must be a number; null where that depends on anything else.
  [[nodiscard]] llvm::Constant* result_of(const llvm::CallBase& call);

  /// A way out of the code that was run.
  struct edge {
    const llvm::BasicBlock* from = nullptr;  // null: something is not known
    const llvm::BasicBlock* to = nullptr;
  };

  /// Runs a part of a function, from the beginning of `start`, to which control comes from `before`, up to the first
  /// block that `is_part` does not know.
  edge run_part(const llvm::BasicBlock& start, const llvm::BasicBlock& before,
                llvm::function_ref<bool(const llvm::BasicBlock&)> is_part);

  /// A result of the part that was run; null: none that code behind it could use.
  [[nodiscard]] llvm::Constant* value_of(const llvm::Instruction& at) const;

  /// The variables, and the local variables of the part's function, whose contents were looked at before the run wrote
  /// them, and those that it wrote.
  [[nodiscard]] std::vector<const llvm::Value*> read_variables() const;
  [[nodiscard]] std::vector<const llvm::Value*> written_variables() const;

  /// What a variable holds after the run: what is not known is undefined. Null where it holds a place that has no name.
  [[nodiscard]] llvm::Constant* contents_of(const llvm::Value& variable, llvm::Type* type) const;

  /// Which bytes of a variable the run wrote.
  [[nodiscard]] const std::vector<bool>& written_bytes(const llvm::Value& variable) const;

  /// Variables that the run declared constant from here on.
  [[nodiscard]] const std::vector<const llvm::GlobalVariable*>& constant_from_now() const { return constant_; }

 private:
  /// Something that is not known, or takes too long: the run ends.
  struct unknown {};

  /// A number (or a struct of numbers), or a place in an object.
  struct value {
    llvm::Constant* number = nullptr;
    std::size_t object = 0;
    std::int64_t offset = 0;
  };
  struct object {
    const llvm::Value* variable = nullptr;  // null: local to a function that the run called
    std::vector<std::uint8_t> bytes;
    std::vector<bool> known;
    std::vector<bool> written;
    std::map<std::uint64_t, value> places;  // what is stored there, byte for byte, is a place
    bool is_read = false;                   // before it was written
    bool is_written = false;
  };
  using frame = llvm::DenseMap<const llvm::Value*, value>;

  edge run_blocks(const llvm::BasicBlock& start, const llvm::BasicBlock* before,
                  llvm::function_ref<bool(const llvm::BasicBlock&)> is_part, frame& values, value& returned);
  void enter(const llvm::BasicBlock& block, const llvm::BasicBlock* before, frame& values);
  const llvm::BasicBlock* leave(const llvm::BasicBlock& block, frame& values);
  void execute(const llvm::Instruction& at, frame& values);
  value call(const llvm::CallBase& call, frame& values);
  value call_intrinsic(const llvm::CallBase& call, frame& values);
  void copy_bytes(const value& to, const value& from, std::uint64_t size);

  value value_of(const llvm::Value* of, const frame& values);
  llvm::Constant* number_of(const llvm::Value* of, const frame& values);
  value place_of(const llvm::Value* of, const frame& values);
  value place_of_element(const llvm::GEPOperator& element, const frame& values);

  value place_of_variable(const llvm::Value& variable, llvm::Type* type);
  object& accessed(const value& place, std::uint64_t size);
  value load(llvm::Type* type, const value& place);
  llvm::Constant* load_number(llvm::Type* type, const value& place);
  void store(const value& stored, llvm::Type* type, const value& place, bool counts = true);
  void store_number(llvm::Constant* stored, const value& place, bool counts);
  llvm::Constant* constant_at(const object& from, std::uint64_t offset, llvm::Type* type) const;
  [[nodiscard]] const object* find(const llvm::Value& variable) const;

  const llvm::DataLayout& layout_;
  std::vector<object> objects_;
  llvm::DenseMap<const llvm::Value*, std::size_t> variables_;
  std::vector<const llvm::GlobalVariable*> constant_;
  frame values_;  // of the part that is run
  std::uint64_t most_steps_;
  std::uint64_t steps_ = 0;
  unsigned depth_ = 0;
};

}  // namespace epiline::frontend
