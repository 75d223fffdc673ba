#include "frontend/process_streams.hpp"

#include <fmt/format.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>

#include <algorithm>

#include "frontend/calls.hpp"

namespace epiline::frontend {

void process_streams::note_declared(const llvm::Function& function) {
  for (const llvm::Instruction& instruction : llvm::instructions(function))
    for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
      if (!streams_in(record.getVariable()->getType()).empty()) declared_.insert(record.getVariable());
}

void process_streams::find(llvm::Function& process, bool locals_are_kept) {
  for (llvm::Instruction& instruction : llvm::instructions(process))
    for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange())) {
      if (!record.isAddressOfVariable()) continue;
      auto* slot = llvm::dyn_cast_or_null<llvm::AllocaInst>(record.getVariableLocationOp(0));
      if (slot != nullptr) add_object(*slot, *record.getVariable(), locals_are_kept);
    }
  for (llvm::GlobalVariable& variable : module_.globals()) {
    llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> described;
    variable.getDebugInfo(described);
    if (!variable.isDeclaration() && !variable.use_empty() && !described.empty())
      add_object(variable, *described.front()->getVariable(), true);
  }
}

void process_streams::add_object(llvm::Value& object, const llvm::DIVariable& variable, bool is_static) {
  std::vector<placed_stream> streams = streams_in(variable.getType(), variable.getName().str());
  const bool known = std::any_of(objects_.begin(), objects_.end(),
                                 [&](const stream_object& other) { return other.object == &object; });
  if (streams.empty() || known) return;
  std::vector<std::size_t> numbers;
  for (const placed_stream& stream : streams) {
    const unsigned given = depth_of(*stream.type);
    numbers.push_back(streams_.size());
    streams_.push_back({fresh_name(stream.name, top_, names_), given == 0 ? default_depth : given, given != 0,
                        is_static, place_of(variable)});
  }
  objects_.push_back(
      {&object, &variable, std::move(streams), numbers, stream_type(variable.getType(), false) != nullptr});
}

void process_streams::add(llvm::Value& channel, const std::string& name, bool is_static, const source_place& place) {
  channels_.emplace_back(&channel, streams_.size());
  streams_.push_back({fresh_name(name, top_, names_), default_depth, false, is_static, place});
}

void process_streams::check_declared() const {
  for (const llvm::DILocalVariable* variable : declared_)
    if (std::none_of(objects_.begin(), objects_.end(),
                     [&](const stream_object& object) { return object.variable == variable; }))
      refuse(place_of(*variable),
             fmt::format("the stream '{}' is never read or written: remove it", variable->getName().str()));
}

void process_streams::take_pragmas(llvm::function_ref<bool(const llvm::Function&)> is_left_over,
                                   std::vector<std::string>& notes) {
  for (llvm::CallInst* call : calls_of(module_, "__epiline_pragma_stream")) {
    if (!is_left_over(*call->getFunction())) take_pragma(*call, notes);
    call->eraseFromParent();
  }
}

void process_streams::take_pragma(const llvm::CallInst& call, std::vector<std::string>& notes) {
  llvm::APInt offset(64, 0);
  const llvm::Value* const base =
      call.getArgOperand(0)->stripAndAccumulateConstantOffsets(module_.getDataLayout(), offset, true);
  const auto found = std::find_if(objects_.begin(), objects_.end(),
                                  [&](const stream_object& object) { return object.object == base; });
  const auto* depth = llvm::dyn_cast<llvm::ConstantInt>(call.getArgOperand(1));
  const source_place place = place_of(call);
  if (depth == nullptr || depth->getSExtValue() < 0 || depth->getSExtValue() > most_depth)
    refuse(place, fmt::format("#pragma HLS STREAM: the depth is not a number from 1 to {}", most_depth));
  if (found == objects_.end() || depth->isZero()) {
    if (place.line != 0)
      notes.push_back(
          fmt::format("{}:{}: note: #pragma HLS STREAM has no effect: it does where it gives the depth of a stream "
                      "between processes, beside its declaration",
                      place.file, place.line));
    return;
  }
  for (std::size_t i = 0; i < found->numbers.size(); ++i)
    // The name of an array speaks of all its streams.
    if (offset == found->streams[i].array || offset == found->streams[i].offset) {
      streams_[found->numbers[i]].depth = static_cast<unsigned>(depth->getZExtValue());
      streams_[found->numbers[i]].depth_given = true;
    }
}

void process_streams::mark(llvm::Function& process) const {
  llvm::IRBuilder<> builder(&*process.getEntryBlock().getFirstNonPHIOrDbgOrAlloca());
  llvm::FunctionCallee mark = module_.getOrInsertFunction(
      internal_stream_name,
      llvm::FunctionType::get(builder.getVoidTy(), {builder.getInt32Ty(), builder.getPtrTy(), builder.getInt64Ty()},
                              false));
  llvm::cast<llvm::Function>(mark.getCallee())->setDoesNotThrow();
  const auto mark_one = [&](std::size_t number, llvm::Value* object, std::uint64_t array) {
    builder.CreateCall(mark, {builder.getInt32(static_cast<std::uint32_t>(number)), object, builder.getInt64(array)});
  };
  for (const stream_object& object : objects_)
    for (std::size_t i = 0; i < object.numbers.size(); ++i)
      mark_one(object.numbers[i],
               builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), object.object, object.streams[i].offset),
               object.streams[i].array);
  for (const auto& [channel, number] : channels_) mark_one(number, channel, 0);
}

std::set<const llvm::Value*> process_streams::objects() const {
  std::set<const llvm::Value*> all;
  for (const stream_object& object : objects_)
    if (object.is_pure) all.insert(object.object);
  return all;
}

}  // namespace epiline::frontend
