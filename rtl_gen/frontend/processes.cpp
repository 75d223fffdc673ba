#include "frontend/processes.hpp"

#include <fmt/format.h>
#include <llvm/ADT/StringExtras.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/Transforms/Utils/Cloning.h>

#include <algorithm>
#include <set>

#include "frontend/calls.hpp"
#include "frontend/checks.hpp"
#include "frontend/code_processes.hpp"
#include "frontend/constant_calls.hpp"
#include "frontend/copies.hpp"
#include "frontend/data_arrays.hpp"
#include "frontend/fill_tables.hpp"
#include "frontend/function_passes.hpp"
#include "frontend/loops.hpp"
#include "frontend/pointer_choices.hpp"
#include "frontend/process_objects.hpp"
#include "frontend/reference_parameters.hpp"
#include "frontend/shared_variables.hpp"
#include "frontend/start_up.hpp"
#include "frontend/tasks.hpp"

namespace epiline::frontend {

namespace {

constexpr const char* dataflow_pragma = "__epiline_pragma_dataflow";

/// Nothing is named after `this`, but every method that is inlined would take along where it is.
void forget_this(llvm::Module& module) {
  for (llvm::Function& function : module)
    for (llvm::Instruction& instruction : llvm::instructions(function))
      for (llvm::DbgVariableRecord& record :
           llvm::make_early_inc_range(llvm::filterDbgVars(instruction.getDbgRecordRange())))
        if (record.getVariable()->getName() == "this") record.eraseFromParent();
}

class splitter {
 public:
  splitter(compiled_source& source, const source_options& options)
      : source_(source),
        module_(*source.module),
        process_(*module_.getFunction(process_name)),
        top_function_(find_defined_top(options)),
        streams_(module_, result_.top) {
    module_.setIsNewDbgInfoFormat(true);
    forget_this(module_);
    result_.top = describe_top(top_function_, module_);
    result_.name = options.top.substr(options.top.rfind(':') + 1);
  }

  split_top run() {
    const std::set<const llvm::Function*> with_tasks = call_tasks(module_);
    has_tasks_ = !with_tasks.empty();
    const bool several = find_region(with_tasks) && find_parts();
    streams_.take_pragmas([this](const llvm::Function& in) { return is_left_over(in); }, source_.notes);
    for (llvm::CallInst* call : calls_of(module_, dataflow_pragma)) call->eraseFromParent();
    result_.streams = streams_.all();
    if (several)
      make_parts();
    else
      result_.processes.push_back({result_.name, std::move(source_.module), result_.top.place, result_.top, false, {}});
    return std::move(result_);
  }

 private:
  [[nodiscard]] llvm::Function& find_defined_top(const source_options& options) const {
    llvm::Function* const top = find_top(module_, options.top);
    if (top == nullptr)
      refuse(
          {options.source, line_of_top(options)},
          fmt::format("top '{}' is declared but not defined in this file: name the file that defines it", options.top));
    return *top;
  }

  // ---- what the processes are ---------------------------------------------------------------------------------------

  /// The top and the functions it calls that have DATAFLOW, tasks or streams of their own, which are as if they were
  /// written out in it; false: none does.
  bool find_region(const std::set<const llvm::Function*>& with_tasks) {
    const auto leads_to_tasks = [&](const llvm::Function& function) {
      return std::any_of(with_tasks.begin(), with_tasks.end(),
                         [&](const llvm::Function* one) { return reached_from(function).count(one) != 0; });
    };
    const std::set<const llvm::Function*> reached = reached_from(process_);
    std::set<const llvm::Function*> marked;
    std::vector<llvm::CallInst*> pragmas;
    for (llvm::CallInst* pragma : calls_of(module_, dataflow_pragma)) {
      if (reached.count(pragma->getFunction()) == 0) continue;  // of another top in the same file
      marked.insert(pragma->getFunction());
      pragmas.push_back(pragma);
    }
    if (pragmas.empty() && !leads_to_tasks(top_function_) && !joins_streams(top_function_)) return false;
    check_functions(module_, process_);
    dataflow_place_ = pragmas.empty() ? result_.top.place : place_of(*pragmas.front());
    region_ = {&top_function_};
    for (std::size_t i = 0; i < region_.size(); ++i)
      for (llvm::Instruction& instruction : llvm::instructions(*region_[i])) {
        llvm::Function* const callee = called_by(instruction);
        if (callee == nullptr || callee->isDeclaration()) continue;
        if (marked.count(callee) != 0 || leads_to_tasks(*callee) || (takes_streams(*callee) && joins_streams(*callee)))
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
    for (const llvm::Function* function : region_) streams_.note_declared(*function);
    return true;
  }

  static void add_once(std::vector<llvm::Function*>& list, llvm::Function* function) {
    if (std::find(list.begin(), list.end(), function) == list.end()) list.push_back(function);
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
    // A table that more than one process has is no variable that they share.
    run_first_calls(module_);
    pass_what_is_read(process_, result_.top);
    if (connect_data_arrays(process_, result_.top, managers_.function, true, source_.notes)) clean_up(process_);
    for (llvm::Function* function : outline_accesses(process_, functions_)) functions_.push_back(function);
    managers_.function.clear();
    find_calls();
    unroll_calls();
    streams_.find(process_, has_tasks_);
    if (calls_.size() == 1 && streams_.all().empty()) return false;
    check_calls();
    share_variables();
    streams_.check_declared();
    std::set<const llvm::Value*> joined = streams_.objects();
    for (const shared_variable& one : shared_) joined.insert(one.slot);
    writers_ = check_objects(process_, calls_, joined);
    return true;
  }

  /// What processes give each other beside streams becomes streams.
  void share_variables() {
    shared_ = find_shared_variables(process_, calls_, keep_results(process_, calls_), streams_.objects());
    const llvm::DominatorTree dominators(process_);
    const llvm::LoopInfo loops(dominators);
    // What is given to an earlier call is for its next run, in a loop around the calls; without one it is lost.
    const auto leads_nowhere = [&](const shared_variable& one) {
      return one.reader < one.writer && !are_repeated(*calls_[one.reader], *calls_[one.writer], loops);
    };
    for (const shared_variable& one : shared_)
      if (one.is_kept && leads_nowhere(one))
        refuse(
            place_of(*calls_[one.writer]),
            fmt::format("DATAFLOW: what the process '{}' gives is kept in a static variable beside the calls: keep it "
                        "in a function that takes streams",
                        short_name(*calls_[one.writer]->getCalledFunction())));
    std::erase_if(shared_, leads_nowhere);
    for (const shared_variable& one : shared_) {
      std::string name = one.slot->getName().split('.').first.str();
      source_place place = place_of(*calls_[one.writer]);
      for (const llvm::DbgVariableRecord* record : llvm::findDVRDeclares(one.slot)) {
        name = record->getVariable()->getName().str();
        place = place_of(*record->getVariable());
      }
      streams_.add(*one.channel, name, one.reader < one.writer, place);
    }
  }

  /// Whether a loop of the top is around both. Around every call is the one without an end.
  static bool are_repeated(const llvm::CallInst& first, const llvm::CallInst& second, const llvm::LoopInfo& loops) {
    const llvm::Loop* loop = loops.getLoopFor(first.getParent());
    while (loop != nullptr && (loop->hasNoExitBlocks() || !loop->contains(&second))) loop = loop->getParentLoop();
    return loop != nullptr;
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
    for (llvm::BasicBlock* block : in_order(process_))
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
      if (calls_named(instruction, "__epiline_stream_"))
        refuse(place_of(instruction),
               "DATAFLOW: a stream is accessed beside the calls: put the access into a function that takes the stream");
  }

  // ---- one module a process -----------------------------------------------------------------------------------------

  /// Whether the function was inlined wherever it is called.
  [[nodiscard]] bool is_left_over(const llvm::Function& function) const {
    return is_inlined_ && &function != &process_ &&
           std::find(functions_.begin(), functions_.end(), &function) == functions_.end();
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

  /// The process that writes a result: the variable behind it is the one that begins unwritten.
  std::size_t writer_of(const llvm::CallInst& result) {
    for (const llvm::CallInst* unwritten : calls_of(module_, "__epiline_unwritten", &process_))
      if (unwritten->getArgOperand(0) == result.getArgOperand(0))
        if (const auto found = writers_.find(unwritten->getArgOperand(1)->stripPointerCasts()); found != writers_.end())
          return found->second;
    return 0;
  }

  void make_parts() {
    streams_.mark(process_);
    std::vector<std::string> stream_names;
    for (const internal_stream& stream : result_.streams) stream_names.push_back(stream.name);
    std::set<std::string> names;
    for (std::size_t i = 0; i < calls_.size(); ++i) {
      llvm::ValueToValueMapTy copies;
      // What was inlined and the other processes stay behind, without bodies: nobody calls them in this part.
      std::set<const llvm::GlobalValue*> needed = {&process_, calls_[i]->getCalledFunction()};
      for (const llvm::Function* start : start_up_functions(module_)) needed.insert(start);
      std::unique_ptr<llvm::Module> module = llvm::CloneModule(module_, copies, [&](const llvm::GlobalValue* value) {
        return !llvm::isa<llvm::Function>(value) || needed.count(value) != 0;
      });
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
          fresh_name(fmt::format("{}_{}", result_.name, identifier(short_name(*calls_[i]->getCalledFunction()))),
                     result_.top, names);
      result_.processes.push_back({name, std::move(module), place_of(*calls_[i]), result_.top, true, stream_names});
    }
  }

  compiled_source& source_;
  llvm::Module& module_;
  llvm::Function& process_;
  llvm::Function& top_function_;
  analysis_managers managers_;
  split_top result_;
  process_streams streams_;
  source_place dataflow_place_;
  bool has_tasks_ = false;                             // they never end, and neither do their streams
  bool is_inlined_ = false;                            // all but the processes
  std::vector<llvm::Function*> region_;                // what is written out in the top
  std::vector<llvm::Function*> functions_;             // that are processes
  std::vector<llvm::CallInst*> calls_;                 // one a process
  std::map<const llvm::Value*, std::size_t> writers_;  // of variables: the process
  std::vector<shared_variable> shared_;
};

}  // namespace

split_top split_into_processes(compiled_source& source, const source_options& options) {
  narrow_guards(*source.module);
  compute_constant_calls(*source.module);
  return splitter(source, options).run();
}

}  // namespace epiline::frontend
