#include "frontend/lower.hpp"

#include <fmt/format.h>
#include <llvm/ADT/SCCIterator.h>
#include <llvm/Analysis/CallGraph.h>
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Transforms/IPO/AlwaysInliner.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/ADCE.h>
#include <llvm/Transforms/Scalar/DCE.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>
#include <llvm/Transforms/Scalar/InstSimplifyPass.h>
#include <llvm/Transforms/Scalar/SCCP.h>
#include <llvm/Transforms/Scalar/SROA.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>
#include <llvm/Transforms/Utils/LowerSwitch.h>

#include <algorithm>
#include <map>
#include <set>

#include "frontend/aggregates.hpp"
#include "frontend/copies.hpp"
#include "frontend/loops.hpp"
#include "frontend/payload.hpp"
#include "frontend/pointer_choices.hpp"
#include "frontend/start_up.hpp"
#include "frontend/vocabulary.hpp"

namespace epiline::frontend {

namespace {

struct analysis_managers {
  llvm::LoopAnalysisManager loop;
  llvm::FunctionAnalysisManager function;
  llvm::CGSCCAnalysisManager cgscc;
  llvm::ModuleAnalysisManager module;

  analysis_managers() {
    llvm::PassBuilder builder;
    builder.registerModuleAnalyses(module);
    builder.registerCGSCCAnalyses(cgscc);
    builder.registerFunctionAnalyses(function);
    builder.registerLoopAnalyses(loop);
    builder.crossRegisterProxies(loop, function, cgscc, module);
  }
};

struct top_description {
  source_place place;
  std::map<unsigned, std::string> parameters;  // by index from 0
};

/// The top's place and parameter names, out of its debug information.
top_description describe_top(const llvm::Module& module, const std::string& top) {
  const std::size_t scope = top.rfind("::");
  const std::string base = scope == std::string::npos ? top : top.substr(scope + 2);
  top_description result;
  for (const llvm::Function& function : module) {
    const llvm::DISubprogram* program = function.getSubprogram();
    if (function.isDeclaration() || program == nullptr || program->getName() != base) continue;
    result.place = place_of(function);
    for (const llvm::Instruction& instruction : llvm::instructions(function))
      for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
        if (const unsigned argument = record.getVariable()->getArg();
            argument != 0 && record.getVariable()->getScope()->getSubprogram() == program)
          result.parameters.try_emplace(argument - 1, record.getVariable()->getName().str());
  }
  return result;
}

void check_recursion(llvm::Module& module) {
  llvm::CallGraph calls(module);
  for (auto component = llvm::scc_begin(&calls); !component.isAtEnd(); ++component) {
    if (!component.hasCycle()) continue;
    for (const llvm::CallGraphNode* node : *component)
      if (const llvm::Function* function = node->getFunction(); function != nullptr && !function->isDeclaration())
        refuse(place_of(*function),
               fmt::format(
                   "recursion in '{}': hardware has no call stack: write a loop, or recursion over template parameters",
                   readable_name(*function)));
  }
}

/// Calls that are left when everything defined here is inlined.
void check_calls(llvm::Function& process) {
  for (llvm::Instruction& instruction : llvm::instructions(process)) {
    if (llvm::isa<llvm::InvokeInst>(instruction)) refuse(place_of(instruction), "exceptions are not supported");
    auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
    if (call == nullptr || llvm::isa<llvm::IntrinsicInst>(call)) continue;
    if (call->isInlineAsm()) refuse(place_of(*call), "inline assembly is not supported");
    const llvm::Function* callee = call->getCalledFunction();
    if (callee == nullptr)
      refuse(place_of(*call),
             "a call through a pointer (function pointer or virtual function) that is not known at compile time: call "
             "the function directly, or use a template parameter");
    const llvm::StringRef name = callee->getName();
    if (name.starts_with("__epiline_")) continue;
    if (name == "malloc" || name == "free" || name == "calloc" || name == "realloc" || name.starts_with("_Znw") ||
        name.starts_with("_Zna") || name.starts_with("_Zdl") || name.starts_with("_Zda"))
      refuse(place_of(*call),
             fmt::format("heap memory ('{}'): hardware has none: use arrays of constant size", readable_name(*callee)));
    if (call->doesNotReturn()) continue;  // abort, a failed assertion: such a path is never taken
    refuse(place_of(*call), fmt::format("call of '{}', which has no definition in this source: define it, or keep it "
                                        "out of the synthesis build with #ifndef __SYNTHESIS__",
                                        readable_name(*callee)));
  }
}

/// Inlines every call in the roots, and in nothing else that matters.
void inline_everything(llvm::Module& module, const std::vector<llvm::Function*>& roots, analysis_managers& managers) {
  for (llvm::Function& function : module) {
    if (function.isDeclaration()) continue;
    function.removeFnAttr(llvm::Attribute::NoInline);
    function.removeFnAttr(llvm::Attribute::OptimizeNone);
    if (std::find(roots.begin(), roots.end(), &function) != roots.end()) continue;
    function.addFnAttr(llvm::Attribute::AlwaysInline);
    if (function.hasComdat()) function.setComdat(nullptr);
    function.setLinkage(llvm::GlobalValue::InternalLinkage);
  }
  llvm::ModulePassManager passes;
  passes.addPass(llvm::AlwaysInlinerPass(false));
  passes.run(module, managers.module);
}

/// Refuses variables whose value only running code could tell, where the process uses them.
void check_initial_values(const std::set<const llvm::GlobalVariable*>& unknown, const llvm::Function& process) {
  for (const llvm::Instruction& instruction : llvm::instructions(process))
    for (const llvm::Use& operand : instruction.operands()) {
      const auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(operand->stripInBoundsConstantOffsets());
      if (variable == nullptr || unknown.count(variable) == 0) continue;
      refuse(
          place_of(instruction),
          fmt::format("'{}' gets its value when a program starts, from code that cannot be run here: make it constexpr",
                      llvm::demangle(variable->getName().str())));
    }
}

/// Replaces the stream, argument and result calls by port accesses.
class port_lowering {
 public:
  port_lowering(lowered_process& result, const top_description& top) : result_(result), top_(top) {}

  void run() {
    std::vector<llvm::CallInst*> calls;
    for (llvm::Instruction& instruction : llvm::instructions(*result_.function))
      if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction))
        if (call->getCalledFunction() != nullptr && call->getCalledFunction()->getName().starts_with("__epiline_"))
          calls.push_back(call);
    for (llvm::CallInst* call : calls) bind_ports(*call);
    for (llvm::CallInst* call : calls) lower_arguments(*call);
    for (llvm::CallInst* call : calls) lower_access(*call);
    finish_call_token();
    for (llvm::CallInst* call : finished_) call->eraseFromParent();
    for (const dataflow::port& port : result_.ports)
      if (port.width == 0)
        refuse(top_.place, fmt::format("the stream '{}' is never read or written: remove the parameter", port.name));
  }

 private:
  [[nodiscard]] const llvm::DataLayout& layout() const { return result_.function->getParent()->getDataLayout(); }

  static llvm::StringRef name_of(const llvm::CallInst& call) { return call.getCalledFunction()->getName(); }

  static unsigned index_of(const llvm::CallInst& call) {
    return static_cast<unsigned>(llvm::cast<llvm::ConstantInt>(call.getArgOperand(0))->getZExtValue());
  }

  std::string parameter_name(unsigned index) const {
    const auto found = top_.parameters.find(index);
    if (found == top_.parameters.end() || found->second.empty())
      refuse(top_.place,
             fmt::format("parameter {} of the top has no name: ports are named after parameters", index + 1));
    return found->second;
  }

  unsigned add_port(const std::string& name, dataflow::port_kind kind, bool input) {
    dataflow::port port;
    port.name = name;
    port.kind = kind;
    port.input = input;
    result_.ports.push_back(std::move(port));
    return static_cast<unsigned>(result_.ports.size() - 1);
  }

  void bind_ports(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_unsupported_parameter")
      refuse(top_.place, fmt::format("parameter '{}' is a pointer or array: pass data through hls::stream references",
                                     parameter_name(index_of(call))));
    if (name_of(call) != "__epiline_port") return;
    const unsigned port = add_port(parameter_name(index_of(call)), dataflow::port_kind::stream, true);
    ports_of_objects_[call.getArgOperand(1)] = port;
    finished_.push_back(&call);
  }

  static llvm::Type* payload_type(const llvm::CallInst& call, unsigned operand) {
    return llvm::cast<llvm::GlobalVariable>(call.getArgOperand(operand)->stripPointerCasts())->getValueType();
  }

  [[nodiscard]] std::vector<leaf> payload_leaves(llvm::Type* type, const source_place& place) const {
    refuse_members_like_padding(type, *result_.function->getParent(), place);
    return leaves_of(type, layout(), place);
  }

  /// All scalars by value arrive as one token, taken where the first of them is.
  void lower_arguments(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_argument") {
      if (first_argument_ == nullptr) {
        first_argument_ = &call;
        call_port_ = add_port("call", dataflow::port_kind::call, true);
      }
      llvm::Type* const type = payload_type(call, 2);
      const std::string name = parameter_name(index_of(call));
      const std::vector<leaf> leaves = payload_leaves(type, top_.place);
      arguments_.push_back({&call, type, leaves, result_.ports[call_port_].width});
      const bool is_signed = leaves.size() == 1 && leaves[0].is_signed;
      result_.ports[call_port_].fields.push_back(
          {name, name, width_of(leaves), result_.ports[call_port_].width, is_signed});
      result_.ports[call_port_].width += width_of(leaves);
      finished_.push_back(&call);
    } else if (name_of(call) == "__epiline_result") {
      const unsigned port = add_port(parameter_name(index_of(call)), dataflow::port_kind::result, false);
      write(call, port, call.getArgOperand(1), payload_type(call, 2));
    }
  }

  void finish_call_token() {
    if (first_argument_ == nullptr) return;
    llvm::IRBuilder<> builder(first_argument_);
    llvm::Value* const token =
        make_access(builder, access::read, call_port_, result_.ports[call_port_].width, {}, "call");
    for (const argument& one : arguments_) {
      builder.SetInsertPoint(one.call);
      llvm::Value* const bits =
          builder.CreateTrunc(builder.CreateLShr(token, one.offset), builder.getIntNTy(width_of(one.leaves)));
      unpack_token(builder, bits, one.call->getArgOperand(1), one.type, one.leaves);
    }
  }

  unsigned port_of(const llvm::CallInst& call) const {
    const auto found = ports_of_objects_.find(call.getArgOperand(0)->stripPointerCasts());
    if (found == ports_of_objects_.end()) {
      if (llvm::isa<llvm::PHINode>(call.getArgOperand(0)) || llvm::isa<llvm::SelectInst>(call.getArgOperand(0)))
        refuse(place_of(call), "a stream is chosen at run time: access each stream in a branch of its own");
      refuse(place_of(call),
             "an internal hls::stream: only the top's stream parameters become hardware: use variables between kernels "
             "of one loop");
    }
    return found->second;
  }

  void set_payload(const llvm::CallInst& call, unsigned port, bool input, const std::vector<leaf>& leaves) {
    dataflow::port& of = result_.ports[port];
    if (of.width == 0) {
      of.input = input;
      of.fields = fields_of(leaves);
      of.width = width_of(leaves);
    } else if (of.input != input) {
      refuse(place_of(call),
             fmt::format("the stream '{}' is both read and written: a stream has one direction", of.name));
    }
  }

  void write(llvm::CallInst& call, unsigned port, llvm::Value* value, llvm::Type* type) {
    const std::vector<leaf> leaves = payload_leaves(type, place_of(call));
    set_payload(call, port, false, leaves);
    llvm::IRBuilder<> builder(&call);
    make_access(builder, access::write, port, width_of(leaves), {pack_token(builder, value, type, leaves)});
    finished_.push_back(&call);
  }

  void lower_access(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_stream_write") {
      write(call, port_of(call), call.getArgOperand(1), payload_type(call, 2));
    } else if (name_of(call) == "__epiline_stream_read") {
      const unsigned port = port_of(call);
      llvm::Type* const type = payload_type(call, 2);
      const std::vector<leaf> leaves = payload_leaves(type, place_of(call));
      set_payload(call, port, true, leaves);
      llvm::IRBuilder<> builder(&call);
      llvm::Value* const token =
          make_access(builder, access::read, port, width_of(leaves), {}, result_.ports[port].name);
      unpack_token(builder, token, call.getArgOperand(1), type, leaves);
      finished_.push_back(&call);
    } else if (name_of(call) == "__epiline_stream_empty" || name_of(call) == "__epiline_stream_full") {
      refuse(place_of(call),
             "empty(), full() and non-blocking access of a stream make results depend on timing: use blocking reads "
             "and writes");
    }
  }

  struct argument {
    llvm::CallInst* call;
    llvm::Type* type;
    std::vector<leaf> leaves;
    unsigned offset;
  };

  lowered_process& result_;
  const top_description& top_;
  std::map<const llvm::Value*, unsigned> ports_of_objects_;
  std::vector<llvm::CallInst*> finished_;
  std::vector<argument> arguments_;
  llvm::CallInst* first_argument_ = nullptr;
  unsigned call_port_ = 0;
};

/// Paths into undefined behaviour, failed assertions among them, are never taken.
void cut_after_noreturn(llvm::Function& process) {
  std::vector<llvm::CallInst*> ends;
  for (llvm::Instruction& instruction : llvm::instructions(process))
    if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
        call != nullptr && call->doesNotReturn() && !llvm::isa<llvm::IntrinsicInst>(call))
      ends.push_back(call);
  for (llvm::CallInst* call : ends) call->eraseFromParent();
}

llvm::SimplifyCFGOptions plain_control_flow() {
  // No lookup tables, no merging of accesses across branches: both would make addresses into values.
  return llvm::SimplifyCFGOptions()
      .convertSwitchRangeToICmp(false)
      .convertSwitchToLookupTable(false)
      .needCanonicalLoops(true)
      .hoistCommonInsts(false)
      .sinkCommonInsts(false);
}

void run_passes(llvm::Function& function, analysis_managers& managers, llvm::FunctionPassManager passes) {
  const llvm::PreservedAnalyses preserved = passes.run(function, managers.function);
  managers.function.invalidate(function, preserved);
}

llvm::FunctionPassManager early_cleanup() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::SROAPass(llvm::SROAOptions::ModifyCFG));
  passes.addPass(llvm::InstSimplifyPass());
  passes.addPass(llvm::SCCPPass());
  passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
  passes.addPass(llvm::DCEPass());
  return passes;
}

llvm::FunctionPassManager late_cleanup() {
  llvm::FunctionPassManager passes;
  passes.addPass(llvm::EarlyCSEPass(false));
  passes.addPass(llvm::SCCPPass());
  passes.addPass(llvm::InstCombinePass());
  passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
  passes.addPass(llvm::EarlyCSEPass(false));
  passes.addPass(llvm::ADCEPass());
  return passes;
}

/// Makes straight code of a function that is to be run here.
void prepare_start_up(llvm::Function& function, analysis_managers& managers) {
  if (function.isDeclaration()) return;
  run_passes(function, managers, early_cleanup());
  rotate_loops(function, managers.function);
  managers.function.invalidate(function, llvm::PreservedAnalyses::none());
  unroll_loops(function, managers.function, true);
  managers.function.invalidate(function, llvm::PreservedAnalyses::none());
  run_passes(function, managers, early_cleanup());
}

}  // namespace

lowered_process lower(compiled_source& source, const source_options& options) {
  llvm::Module& module = *source.module;
  module.setIsNewDbgInfoFormat(true);
  lowered_process result;
  result.function = module.getFunction(process_name);
  llvm::Function& process = *result.function;
  analysis_managers managers;

  const top_description top = describe_top(module, options.top);
  result.top_place = top.place;
  check_recursion(module);
  std::vector<llvm::Function*> roots = start_up_functions(module);
  const std::vector<llvm::Function*> start_up = roots;
  roots.push_back(&process);
  inline_everything(module, roots, managers);
  for (llvm::Function* start : start_up) prepare_start_up(*start, managers);
  const std::set<const llvm::GlobalVariable*> unknown = run_start_up_code(module, start_up);
  check_initial_values(unknown, process);
  for (llvm::Function& function : module)
    if (&function != &process && !function.isDeclaration()) function.deleteBody();
  managers.function.clear();

  split_whole_structs(process);
  expand_copies(process, unknown_types::kept);
  resolve_pointer_choices(process);
  run_passes(process, managers, early_cleanup());
  check_calls(process);
  cut_after_noreturn(process);
  port_lowering(result, top).run();
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, early_cleanup());

  rotate_loops(process, managers.function);  // makes trip counts exact
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  result.initiation_interval = unroll_loops(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  expand_copies(process, unknown_types::refused);
  {
    llvm::FunctionPassManager passes;
    passes.addPass(llvm::InstSimplifyPass());
    passes.addPass(llvm::SCCPPass());
    passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
    run_passes(process, managers, std::move(passes));
  }
  resolve_pointer_choices(process);
  split_aggregates(result);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, late_cleanup());
  rotate_loops(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, late_cleanup());
  look_ahead(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  narrow_counters(process, managers.function);
  return result;
}

}  // namespace epiline::frontend
