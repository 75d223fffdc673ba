#include "frontend/processes.hpp"

#include <fmt/format.h>
#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/Transforms/Utils/Cloning.h>

#include <algorithm>
#include <optional>
#include <set>

#include "frontend/checks.hpp"
#include "frontend/copies.hpp"
#include "frontend/function_passes.hpp"
#include "frontend/loops.hpp"
#include "frontend/pointer_choices.hpp"
#include "frontend/process_objects.hpp"
#include "frontend/shared_variables.hpp"
#include "frontend/start_up.hpp"
#include "frontend/stream_arrays.hpp"

namespace epiline::frontend {

namespace {

constexpr const char* dataflow_pragma = "__epiline_pragma_dataflow";
constexpr const char* stream_pragma = "__epiline_pragma_stream";
constexpr unsigned most_depth = 1u << 20;

/// The hls::stream that a type is, perhaps in arrays and, if wanted, behind a reference or pointer; null: it is none.
const llvm::DICompositeType* stream_type(const llvm::DIType* type, bool behind_references) {
  while (type != nullptr) {
    if (const auto* derived = llvm::dyn_cast<llvm::DIDerivedType>(type)) {
      const auto tag = derived->getTag();
      const bool same = tag == llvm::dwarf::DW_TAG_typedef || tag == llvm::dwarf::DW_TAG_const_type;
      if (!same && !behind_references) return nullptr;
      type = derived->getBaseType();
      continue;
    }
    const auto* composite = llvm::dyn_cast<llvm::DICompositeType>(type);
    if (composite == nullptr) return nullptr;
    if (composite->getTag() == llvm::dwarf::DW_TAG_array_type) {
      type = composite->getBaseType();
      continue;
    }
    const auto* space = llvm::dyn_cast_or_null<llvm::DINamespace>(composite->getScope());
    const bool is_stream = space != nullptr && space->getName() == "hls" && composite->getName().starts_with("stream<");
    return is_stream ? composite : nullptr;
  }
  return nullptr;
}

/// A stream in a variable: the variable itself, an element or a member of it.
struct placed_stream {
  std::uint64_t offset = 0;  // in bytes
  std::uint64_t array = 0;   // that of the first one of the innermost array it is in, or its own
  const llvm::DICompositeType* type = nullptr;
  std::string name;
};

/// Appends the streams that a type at `offset` holds. `array`, if there is one, is where the array around it begins.
void find_streams_in(const llvm::DIType* type, std::uint64_t offset, std::optional<std::uint64_t> array,
                     const std::string& name, std::vector<placed_stream>& found) {
  while (const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type)) {
    if (derived->getTag() != llvm::dwarf::DW_TAG_typedef && derived->getTag() != llvm::dwarf::DW_TAG_const_type) return;
    type = derived->getBaseType();
  }
  const auto* composite = llvm::dyn_cast_or_null<llvm::DICompositeType>(type);
  if (composite == nullptr) return;
  if (composite->getTag() == llvm::dwarf::DW_TAG_array_type) {
    const std::uint64_t size = composite->getBaseType()->getSizeInBits() / 8;
    for (std::uint64_t i = 0; size != 0 && i < composite->getSizeInBits() / 8 / size; ++i) {
      find_streams_in(composite->getBaseType(), offset + i * size, array.value_or(offset),
                      fmt::format("{}_{}", name, i), found);
      if (found.empty()) return;  // the other elements hold none either
    }
  } else if (stream_type(composite, false) != nullptr) {
    found.push_back({offset, array.value_or(offset), composite, name});
  } else {
    for (const llvm::DINode* element : composite->getElements()) {
      const auto* member = llvm::dyn_cast<llvm::DIDerivedType>(element);
      if (member == nullptr || member->isStaticMember()) continue;
      const bool is_base = member->getTag() == llvm::dwarf::DW_TAG_inheritance;
      if (is_base || member->getTag() == llvm::dwarf::DW_TAG_member)
        find_streams_in(member->getBaseType(), offset + member->getOffsetInBits() / 8, {},
                        is_base ? name : name + "_" + member->getName().str(), found);
    }
  }
}

std::vector<placed_stream> streams_in(const llvm::DIType* type, const std::string& name = "") {
  std::vector<placed_stream> found;
  find_streams_in(type, 0, {}, name, found);
  return found;
}

/// Whether a parameter's type is, refers to or holds streams.
bool brings_streams(const llvm::DIType* type) {
  if (stream_type(type, true) != nullptr) return true;
  const auto* derived = llvm::dyn_cast_or_null<llvm::DIDerivedType>(type);
  const bool refers = derived != nullptr && (derived->getTag() == llvm::dwarf::DW_TAG_reference_type ||
                                             derived->getTag() == llvm::dwarf::DW_TAG_pointer_type);
  return refers && !streams_in(derived->getBaseType()).empty();
}

/// DEPTH of hls::stream<T, DEPTH>; 0 without.
unsigned depth_of(const llvm::DICompositeType& type) {
  llvm::StringRef last = type.getName().rsplit(',').second.trim();
  unsigned depth = 0;
  const bool given = !last.consumeInteger(10, depth) && last.trim() == ">" && depth != 0;
  return given ? std::min(depth, most_depth) : 0;
}

/// A function that can be a process: one that takes streams and is not one of the streams' own.
bool takes_streams(const llvm::Function& function) {
  const llvm::DISubprogram* program = function.getSubprogram();
  if (program == nullptr || program->getName().starts_with("__epiline_") ||  // of a pragma
      stream_type(llvm::dyn_cast_or_null<llvm::DIType>(program->getScope()), false) != nullptr)
    return false;
  const llvm::DITypeRefArray types = program->getType()->getTypeArray();
  for (unsigned i = 1; i < types.size(); ++i)
    if (types[i] != nullptr && !types[i]->isArtificial() && brings_streams(types[i])) return true;
  return false;
}

llvm::Function* called_by(llvm::Instruction& instruction) {
  auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
  return call == nullptr ? nullptr : call->getCalledFunction();
}

/// The calls of the function of that name, in the functions named or, without, in the whole module.
std::vector<llvm::CallInst*> calls_of(llvm::Module& module, const char* name, const llvm::Function* in = nullptr) {
  std::vector<llvm::CallInst*> calls;
  const llvm::Function* function = module.getFunction(name);
  if (function == nullptr) return calls;
  for (llvm::Function& caller : module)
    for (llvm::Instruction& instruction : llvm::instructions(caller))
      if (called_by(instruction) == function && (in == nullptr || in == &caller))
        calls.push_back(llvm::cast<llvm::CallInst>(&instruction));
  return calls;
}

/// The top's place and parameter names, out of its debug information. Each stream of an array counts as a parameter,
/// and what is returned as the last.
top_description describe_top(const llvm::Function* top, llvm::Module& module) {
  top_description result;
  if (top == nullptr) return result;
  const std::map<unsigned, unsigned> arrays = stream_arrays(module);
  const auto add = [&](unsigned position, const std::string& name) {
    const unsigned index = flat_index(arrays, position);
    const auto array = arrays.find(position);
    if (array == arrays.end()) {
      result.parameters.try_emplace(index, name);
      return;
    }
    for (unsigned i = 0; i < array->second; ++i)
      result.parameters.try_emplace(index + i, fmt::format("{}_{}", name, i));
  };
  result.place = place_of(*top);
  for (const llvm::Instruction& instruction : llvm::instructions(*top))
    for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
      if (const unsigned argument = record.getVariable()->getArg();
          argument != 0 && record.getVariable()->getScope()->getSubprogram() == top->getSubprogram())
        add(argument - 1, record.getVariable()->getName().str());
  if (const unsigned returned = returned_position(module); returned != 0) add(returned, returned_name);
  return result;
}

/// Everything that runs when `root` does, itself included.
std::set<llvm::Function*> reached_from(llvm::Function& root) {
  std::set<llvm::Function*> reached{&root};
  std::vector<llvm::Function*> pending{&root};
  while (!pending.empty()) {
    llvm::Function* const function = pending.back();
    pending.pop_back();
    for (llvm::Instruction& instruction : llvm::instructions(*function))
      if (llvm::Function* callee = called_by(instruction); callee != nullptr && reached.insert(callee).second)
        pending.push_back(callee);
  }
  return reached;
}

class splitter {
 public:
  splitter(compiled_source& source, const source_options& options)
      : source_(source), module_(*source.module), process_(*module_.getFunction(process_name)) {
    module_.setIsNewDbgInfoFormat(true);
    top_function_ = find_top(module_, options.top);
    result_.top = describe_top(top_function_, module_);
    if (result_.top.place.line == 0)
      refuse(
          {options.source, line_of_top(options)},
          fmt::format("top '{}' is declared but not defined in this file: name the file that defines it", options.top));
    if (result_.top.parameters.empty())
      refuse(result_.top.place, "the top has no parameters: ports are made of them: give it hls::stream references");
    std::set<std::string> names;
    for (const auto& [index, name] : result_.top.parameters)
      if (!name.empty() && !names.insert(name).second)
        refuse(result_.top.place,
               fmt::format("two ports are named '{}', one of them for a stream of an array: rename a parameter", name));
    result_.name = options.top.substr(options.top.rfind(':') + 1);
  }

  split_top run() {
    const bool several = find_region() && find_parts();
    take_stream_pragmas();
    for (llvm::CallInst* call : calls_of(module_, dataflow_pragma)) call->eraseFromParent();
    if (several)
      make_parts();
    else
      result_.processes.push_back({result_.name, std::move(source_.module), result_.top.place, result_.top, false, {}});
    return std::move(result_);
  }

 private:
  /// An object of streams: one, or an array.
  struct stream_object {
    llvm::Value* object;
    const llvm::DIVariable* variable;
    std::vector<placed_stream> streams;
    std::vector<std::size_t> numbers;  // of these streams, one by one
    bool is_pure = true;               // it is nothing else than streams
  };

  // ---- what the processes are ---------------------------------------------------------------------------------------

  /// The top and the functions with DATAFLOW it calls, which are as if they were written out in it; false: none has
  /// DATAFLOW.
  bool find_region() {
    const std::set<llvm::Function*> reached = reached_from(process_);
    std::set<const llvm::Function*> marked;
    std::vector<llvm::CallInst*> pragmas;
    for (llvm::CallInst* pragma : calls_of(module_, dataflow_pragma)) {
      if (reached.count(pragma->getFunction()) == 0) continue;  // of another top in the same file
      marked.insert(pragma->getFunction());
      pragmas.push_back(pragma);
    }
    if (pragmas.empty()) return false;
    check_functions(module_, process_);
    dataflow_place_ = place_of(*pragmas.front());
    region_ = {top_function_};
    for (std::size_t i = 0; i < region_.size(); ++i)
      for (llvm::Instruction& instruction : llvm::instructions(*region_[i])) {
        llvm::Function* const callee = called_by(instruction);
        if (callee == nullptr || callee->isDeclaration()) continue;
        if (marked.count(callee) != 0)
          add_once(region_, callee);
        else if (takes_streams(*callee))
          add_once(functions_, callee);
      }
    for (const llvm::CallInst* pragma : pragmas)
      if (std::find(region_.begin(), region_.end(), pragma->getFunction()) == region_.end())
        refuse(place_of(*pragma),
               fmt::format("DATAFLOW in '{}', which is called from inside of a process: only the top, and functions "
                           "with DATAFLOW that it calls itself, can be made of processes",
                           readable_name(*pragma->getFunction())));
    note_declared_streams();
    return true;
  }

  static void add_once(std::vector<llvm::Function*>& list, llvm::Function* function) {
    if (std::find(list.begin(), list.end(), function) == list.end()) list.push_back(function);
  }

  /// The local streams of the region, before those that nobody uses vanish.
  void note_declared_streams() {
    for (const llvm::Function* function : region_)
      for (const llvm::Instruction& instruction : llvm::instructions(*function))
        for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
          if (!streams_in(record.getVariable()->getType()).empty()) declared_.insert(record.getVariable());
  }

  /// Inlines all but the processes; false when one function without internal streams is left: an ordinary top.
  bool find_parts() {
    std::vector<llvm::Function*> roots = start_up_functions(module_);
    roots.push_back(&process_);
    roots.insert(roots.end(), functions_.begin(), functions_.end());
    inline_everything(module_, roots, managers_);
    is_inlined_ = true;
    for (llvm::Function* function : functions_) clean_up(*function);
    clean_up(process_);
    find_calls();
    unroll_calls();
    find_streams();
    if (calls_.size() == 1 && result_.streams.empty()) return false;
    check_calls();
    share_variables();
    for (const llvm::DILocalVariable* variable : declared_)
      if (std::none_of(objects_.begin(), objects_.end(),
                       [&](const stream_object& object) { return object.variable == variable; }))
        refuse(place_of(*variable),
               fmt::format("the stream '{}' is never read or written: remove it", variable->getName().str()));
    std::set<const llvm::Value*> joined = stream_objects();
    for (const shared_variable& one : shared_) joined.insert(one.slot);
    writers_ = check_objects(process_, calls_, joined);
    return true;
  }

  /// What processes give each other beside streams becomes streams.
  void share_variables() {
    shared_ = find_shared_variables(process_, calls_, keep_results(process_, calls_), stream_objects());
    for (const shared_variable& one : shared_) {
      std::string name = one.slot->getName().split('.').first.str();
      source_place place = place_of(*calls_[one.writer]);
      for (const llvm::DbgVariableRecord* record : llvm::findDVRDeclares(one.slot)) {
        name = record->getVariable()->getName().str();
        place = place_of(*record->getVariable());
      }
      shared_numbers_.push_back(result_.streams.size());
      // What is given to an earlier call is for its next run, in a loop around the calls.
      result_.streams.push_back({fresh(name, stream_names_), default_depth, false, one.reader < one.writer, place});
    }
  }

  void clean_up(llvm::Function& function) {
    note_loops_of_pragmas(function);
    split_whole_structs(function);
    expand_copies(function, unknown_types::kept);
    managers_.function.invalidate(function, llvm::PreservedAnalyses::none());
    run_passes(function, managers_, early_cleanup());
  }

  /// In the order in which they take place, when each does once.
  void find_calls() {
    calls_.clear();
    llvm::ReversePostOrderTraversal<llvm::Function*> order(&process_);
    for (llvm::BasicBlock* block : order)
      for (llvm::Instruction& instruction : *block)
        if (std::find(functions_.begin(), functions_.end(), called_by(instruction)) != functions_.end() &&
            called_by(instruction) != nullptr)
          calls_.push_back(llvm::cast<llvm::CallInst>(&instruction));
  }

  /// `for (int i = 0; i < 4; ++i) worker(in[i], out[i]);` are four processes: the loop chooses streams. Any other loop
  /// stays one, in every process.
  void unroll_calls() {
    const auto chooses = [&](const llvm::Use& argument) {
      llvm::APInt offset(64, 0);
      return argument->getType()->isPointerTy() &&
             llvm::isa<llvm::GetElementPtrInst>(
                 argument->stripAndAccumulateConstantOffsets(module_.getDataLayout(), offset, true));
    };
    if (std::none_of(calls_.begin(), calls_.end(), [&](const llvm::CallInst* call) {
          return std::any_of(call->arg_begin(), call->arg_end(), chooses);
        }))
      return;
    rotate_loops(process_, managers_.function);
    managers_.function.invalidate(process_, llvm::PreservedAnalyses::none());
    static_cast<void>(unroll_loops(process_, managers_.function, true));
    managers_.function.invalidate(process_, llvm::PreservedAnalyses::none());
    run_passes(process_, managers_, early_cleanup());
    find_calls();
  }

  void check_calls() {
    if (calls_.empty())
      refuse(dataflow_place_,
             "DATAFLOW, but no function that takes streams is called here: its body must be local streams and calls of "
             "functions that take them, one after another");
    for (const llvm::CallInst* call : calls_) {
      const std::string function = short_name(*call->getCalledFunction());
      if (!call->getType()->isVoidTy() && !call->getType()->isIntegerTy())
        refuse(place_of(*call), fmt::format("DATAFLOW: the process '{}' returns a struct: a process returns an integer "
                                            "or void, and gives its results through an hls::stream or by reference",
                                            function));
    }
    for (llvm::Instruction& instruction : llvm::instructions(process_))
      if (const llvm::Function* callee = called_by(instruction);
          callee != nullptr && callee->getName().starts_with("__epiline_stream_"))
        refuse(place_of(instruction),
               "DATAFLOW: a stream is accessed beside the calls: put the access into a function that takes the stream");
  }

  // ---- the streams between them -------------------------------------------------------------------------------------

  void find_streams() {
    for (llvm::Instruction& instruction : llvm::instructions(process_))
      for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange())) {
        if (!record.isAddressOfVariable()) continue;
        auto* slot = llvm::dyn_cast_or_null<llvm::AllocaInst>(record.getVariableLocationOp(0));
        if (slot != nullptr) add_streams(*slot, *record.getVariable(), false);
      }
    for (llvm::GlobalVariable& variable : module_.globals()) {
      llvm::SmallVector<llvm::DIGlobalVariableExpression*, 1> described;
      variable.getDebugInfo(described);
      if (!variable.isDeclaration() && !variable.use_empty() && !described.empty())
        add_streams(variable, *described.front()->getVariable(), true);
    }
  }

  void add_streams(llvm::Value& object, const llvm::DIVariable& variable, bool is_static) {
    std::vector<placed_stream> streams = streams_in(variable.getType(), variable.getName().str());
    const bool known = std::any_of(objects_.begin(), objects_.end(),
                                   [&](const stream_object& other) { return other.object == &object; });
    if (streams.empty() || known) return;
    std::vector<std::size_t> numbers;
    for (const placed_stream& stream : streams) {
      const unsigned given = depth_of(*stream.type);
      numbers.push_back(result_.streams.size());
      result_.streams.push_back({fresh(stream.name, stream_names_), given == 0 ? default_depth : given, given != 0,
                                 is_static, place_of(variable)});
    }
    objects_.push_back(
        {&object, &variable, std::move(streams), numbers, stream_type(variable.getType(), false) != nullptr});
  }

  [[nodiscard]] std::set<const llvm::Value*> stream_objects() const {
    std::set<const llvm::Value*> all;
    for (const stream_object& object : objects_)
      if (object.is_pure) all.insert(object.object);
    return all;
  }

  /// A name like the wanted one that no other has.
  std::string fresh(const std::string& wanted, std::set<std::string>& taken) const {
    std::string name = wanted;
    const auto is_parameter = [&] {
      return std::any_of(result_.top.parameters.begin(), result_.top.parameters.end(),
                         [&](const auto& parameter) { return parameter.second == name; });
    };
    for (unsigned number = 2; taken.count(name) != 0 || is_parameter(); ++number)
      name = fmt::format("{}_{}", wanted, number);
    taken.insert(name);
    return name;
  }

  void take_stream_pragmas() {
    for (llvm::CallInst* call : calls_of(module_, stream_pragma)) {
      const llvm::Function* const in = call->getFunction();
      if (is_inlined_ && in != &process_ && std::find(functions_.begin(), functions_.end(), in) == functions_.end()) {
        call->eraseFromParent();  // in what is left of a function that was inlined
        continue;
      }
      llvm::APInt offset(64, 0);
      const llvm::Value* const base =
          call->getArgOperand(0)->stripAndAccumulateConstantOffsets(module_.getDataLayout(), offset, true);
      const auto found = std::find_if(objects_.begin(), objects_.end(),
                                      [&](const stream_object& object) { return object.object == base; });
      const auto* depth = llvm::dyn_cast<llvm::ConstantInt>(call->getArgOperand(1));
      const source_place place = place_of(*call);
      if (depth == nullptr || depth->getSExtValue() < 0 || depth->getSExtValue() > most_depth)
        refuse(place, fmt::format("#pragma HLS STREAM: the depth is not a number from 1 to {}", most_depth));
      if (found == objects_.end() || depth->isZero()) {
        if (place.line != 0)
          source_.notes.push_back(
              fmt::format("{}:{}: note: #pragma HLS STREAM has no effect: it does where it gives the depth of a stream "
                          "between processes, beside its declaration",
                          place.file, place.line));
      } else {
        for (std::size_t i = 0; i < found->numbers.size(); ++i)
          // The name of an array speaks of all its streams.
          if (offset == found->streams[i].array || offset == found->streams[i].offset) {
            result_.streams[found->numbers[i]].depth = static_cast<unsigned>(depth->getZExtValue());
            result_.streams[found->numbers[i]].depth_given = true;
          }
      }
      call->eraseFromParent();
    }
  }

  // ---- one module a process -----------------------------------------------------------------------------------------

  static std::string short_name(const llvm::Function& function) {
    const llvm::DISubprogram* program = function.getSubprogram();
    return program != nullptr ? program->getName().str() : readable_name(function);
  }

  /// As an identifier, without template arguments.
  static std::string identifier(const std::string& text) {
    std::string name;
    for (const char c : llvm::StringRef(text).take_until([](char c) { return c == '<'; }))
      if (llvm::isAlnum(c))
        name += c;
      else if (!name.empty() && name.back() != '_')
        name += '_';
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name.empty() ? "process" : name;
  }

  /// Says which object is which stream, where they all exist.
  void mark_streams() {
    llvm::IRBuilder<> builder(&*process_.getEntryBlock().getFirstNonPHIOrDbgOrAlloca());
    llvm::FunctionCallee mark = module_.getOrInsertFunction(
        internal_stream_name,
        llvm::FunctionType::get(builder.getVoidTy(), {builder.getInt32Ty(), builder.getPtrTy()}, false));
    llvm::cast<llvm::Function>(mark.getCallee())->setDoesNotThrow();
    for (const stream_object& object : objects_)
      for (std::size_t i = 0; i < object.numbers.size(); ++i)
        builder.CreateCall(
            mark, {builder.getInt32(static_cast<std::uint32_t>(object.numbers[i])),
                   builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), object.object, object.streams[i].offset)});
    for (std::size_t i = 0; i < shared_.size(); ++i)
      builder.CreateCall(mark, {builder.getInt32(static_cast<std::uint32_t>(shared_numbers_[i])), shared_[i].channel});
  }

  /// The process that writes a result: the variable behind it is the one that begins unwritten.
  std::size_t writer_of(const llvm::CallInst& result) {
    for (const llvm::CallInst* unwritten : calls_of(module_, "__epiline_unwritten", &process_))
      if (unwritten->getArgOperand(0) == result.getArgOperand(0))
        if (const auto found = writers_.find(unwritten->getArgOperand(1)->stripPointerCasts()); found != writers_.end())
          return found->second;
    return 0;
  }

  void make_parts() {
    mark_streams();
    std::vector<std::string> stream_names;
    for (const internal_stream& stream : result_.streams) stream_names.push_back(stream.name);
    std::set<std::string> names;
    for (std::size_t i = 0; i < calls_.size(); ++i) {
      llvm::ValueToValueMapTy copies;
      std::unique_ptr<llvm::Module> module = llvm::CloneModule(module_, copies);
      pass_shared_variables(shared_, i, copies);
      for (std::size_t other = 0; other < calls_.size(); ++other) {
        if (other == i) continue;
        auto* const call = llvm::cast<llvm::CallInst>(copies[calls_[other]]);
        if (!call->getType()->isVoidTy()) call->replaceAllUsesWith(llvm::PoisonValue::get(call->getType()));
        call->eraseFromParent();
      }
      // A result that only the top itself computes is given by the first process.
      for (llvm::CallInst* call : calls_of(module_, "__epiline_result", &process_))
        if (writer_of(*call) != i) llvm::cast<llvm::CallInst>(copies[call])->eraseFromParent();
      const std::string name =
          fresh(fmt::format("{}_{}", result_.name, identifier(short_name(*calls_[i]->getCalledFunction()))), names);
      result_.processes.push_back({name, std::move(module), place_of(*calls_[i]), result_.top, true, stream_names});
    }
  }

  compiled_source& source_;
  llvm::Module& module_;
  llvm::Function& process_;
  llvm::Function* top_function_ = nullptr;
  analysis_managers managers_;
  split_top result_;
  source_place dataflow_place_;
  bool is_inlined_ = false;                 // all but the processes
  std::vector<llvm::Function*> region_;     // what is written out in the top
  std::vector<llvm::Function*> functions_;  // that are processes
  std::vector<llvm::CallInst*> calls_;      // one a process
  std::set<const llvm::DILocalVariable*> declared_;
  std::vector<stream_object> objects_;
  std::set<std::string> stream_names_;
  std::map<const llvm::Value*, std::size_t> writers_;  // of variables: the process
  std::vector<shared_variable> shared_;
  std::vector<std::size_t> shared_numbers_;  // of their streams
};

}  // namespace

llvm::Function* find_top(llvm::Module& module, const std::string& top) {
  const std::size_t scope = top.rfind("::");
  const std::string base = scope == std::string::npos ? top : top.substr(scope + 2);
  llvm::Function* found = nullptr;
  for (llvm::Function& function : module)
    if (const llvm::DISubprogram* program = function.getSubprogram();
        !function.isDeclaration() && program != nullptr && program->getName() == base)
      found = &function;
  return found;
}

split_top split_into_processes(compiled_source& source, const source_options& options) {
  return splitter(source, options).run();
}

}  // namespace epiline::frontend
