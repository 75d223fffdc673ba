#include "frontend/reference_parameters.hpp"

#include <fmt/format.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Module.h>

#include <set>
#include <vector>

#include "frontend/calls.hpp"
#include "frontend/process_objects.hpp"

namespace epiline::frontend {

namespace {

/// Follows a pointer to an object of `size` bytes.
class reach {
 public:
  reach(const llvm::DataLayout& layout, std::uint64_t size) : layout_(layout), size_(size) {}

  /// Whether more may be accessed than the object.
  bool goes_beyond(const llvm::Value& pointer, std::uint64_t offset) {
    for (const llvm::User* user : pointer.users()) {
      if (const auto* element = llvm::dyn_cast<llvm::GetElementPtrInst>(user)) {
        llvm::APInt more(64, 0);
        if (!element->accumulateConstantOffset(layout_, more)) return true;
        const std::uint64_t at = offset + more.getZExtValue();
        if (at > size_ || goes_beyond(*element, at)) return true;
      } else if (const auto* load = llvm::dyn_cast<llvm::LoadInst>(user)) {
        if (ends_after(offset, layout_.getTypeStoreSize(load->getType()))) return true;
      } else if (const auto* store = llvm::dyn_cast<llvm::StoreInst>(user)) {
        if (store->getValueOperand() == &pointer ||
            ends_after(offset, layout_.getTypeStoreSize(store->getValueOperand()->getType())))
          return true;
      } else if (const auto* block = llvm::dyn_cast<llvm::MemIntrinsic>(user)) {
        const auto* length = llvm::dyn_cast<llvm::ConstantInt>(block->getLength());
        if (length == nullptr || ends_after(offset, length->getZExtValue())) return true;
      } else if (const auto* call = llvm::dyn_cast<llvm::CallBase>(user)) {
        const llvm::Function* callee = call->getCalledFunction();
        if (callee == nullptr) return true;
        if (callee->isDeclaration() || !seen_.insert(callee).second) continue;
        for (unsigned i = 0; i < call->arg_size(); ++i)
          if (call->getArgOperand(i) == &pointer && goes_beyond(*callee->getArg(i), offset)) return true;
        seen_.erase(callee);
      } else {
        return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool ends_after(std::uint64_t offset, std::uint64_t length) const { return offset + length > size_; }

  const llvm::DataLayout& layout_;
  const std::uint64_t size_;
  std::set<const llvm::Function*> seen_;
};

unsigned index_of(const llvm::CallInst& call) { return number_in(call, 0); }

}  // namespace

void pass_what_is_read(llvm::Function& process, const top_description& top) {
  llvm::Module& module = *process.getParent();
  for (llvm::CallInst* call : calls_of(module, "__epiline_single", &process)) {
    const auto size = llvm::cast<llvm::ConstantInt>(call->getArgOperand(2))->getZExtValue();
    if (reach(module.getDataLayout(), size).goes_beyond(*call->getArgOperand(1), 0))
      refuse(
          top.place,
          fmt::format("parameter '{}' is a pointer to more than one value: pass data through hls::stream references, "
                      "or as an array that is written with its size",
                      top.parameters.at(index_of(*call))));
    call->eraseFromParent();
  }
  for (llvm::CallInst* unwritten : calls_of(module, "__epiline_unwritten", &process)) {
    const llvm::Value* const variable = unwritten->getArgOperand(1)->stripPointerCasts();
    if (is_written_through(*variable)) continue;
    std::vector<llvm::CallInst*> results = calls_of(module, "__epiline_result", &process);
    std::erase_if(results, [&](const llvm::CallInst* result) { return index_of(*result) != index_of(*unwritten); });
    // A bool is one thing in memory and another one as a token.
    if (results.size() != 1 || results.front()->getArgOperand(1)->stripPointerCasts() != variable) continue;
    results.front()->eraseFromParent();
    unwritten->setCalledFunction(
        module.getOrInsertFunction("__epiline_argument", unwritten->getFunctionType(), unwritten->getAttributes()));
  }
}

}  // namespace epiline::frontend
