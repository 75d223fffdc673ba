#include "frontend/lower.hpp"

#include <fmt/format.h>
#include <llvm/Analysis/LoopInfo.h>
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
#include "frontend/checks.hpp"
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

/// Stands for what nobody has written; the parameter's index follows.
constexpr const char* unwritten_prefix = "epiline.unwritten.";

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
    if (std::none_of(result_.ports.begin(), result_.ports.end(),
                     [](const dataflow::port& port) { return !port.input; }))
      refuse(top_.place,
             "the top has no output: give results through an hls::stream or a scalar by reference, or nothing can be "
             "seen of it");
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

  /// The reasons of call_top.hpp.
  [[noreturn]] void refuse_parameter(const llvm::CallInst& call) const {
    static const char* const reasons[] = {
        "is a pointer or array: pass data through hls::stream references",
        "is an array by reference: pass data through hls::stream references, or a struct of few members",
        "is a stream by value or by const reference: pass it as hls::stream<T>&",
        "is an rvalue reference: pass a scalar by value"};
    const auto reason = llvm::cast<llvm::ConstantInt>(call.getArgOperand(1))->getZExtValue();
    refuse(top_.place, fmt::format("parameter '{}' {}", parameter_name(index_of(call)), reasons[reason]));
  }

  void bind_ports(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_unsupported_parameter") refuse_parameter(call);
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
    std::vector<leaf> leaves = leaves_of(type, layout(), place);
    check_width(width_of(leaves), place);
    return leaves;
  }

  static void check_width(unsigned width, const source_place& place) {
    if (width > dataflow::max_width)
      refuse(place, fmt::format("a token of {} bits: {} are the most: send it in parts, one after another", width,
                                dataflow::max_width));
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
      check_width(result_.ports[call_port_].width, top_.place);
      finished_.push_back(&call);
    } else if (name_of(call) == "__epiline_unwritten") {
      leave_unwritten(call);
    } else if (name_of(call) == "__epiline_result") {
      const unsigned port = add_port(parameter_name(index_of(call)), dataflow::port_kind::result, false);
      write(call, port, call.getArgOperand(1), payload_type(call, 2));
    }
  }

  /// What a result holds before the top writes it becomes a value of unknown origin, which find_unwritten() looks for
  /// at the end. An undefined value would be optimised into anything.
  void leave_unwritten(llvm::CallInst& call) {
    llvm::Type* const type = payload_type(call, 2);
    const std::vector<leaf> leaves = payload_leaves(type, top_.place);
    llvm::IRBuilder<> builder(&call);
    llvm::Type* const token = builder.getIntNTy(width_of(leaves));
    llvm::FunctionCallee nobody = result_.function->getParent()->getOrInsertFunction(
        fmt::format("{}{}", unwritten_prefix, index_of(call)), llvm::FunctionType::get(token, false));
    auto* function = llvm::cast<llvm::Function>(nobody.getCallee());
    function->setDoesNotAccessMemory();
    function->setDoesNotThrow();
    function->setWillReturn();
    unpack_token(builder, builder.CreateCall(nobody), call.getArgOperand(1), type, leaves);
    finished_.push_back(&call);
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

/// Refuses results that a call may give out without having written them.
void find_unwritten(const llvm::Function& process, const top_description& top) {
  for (const llvm::Instruction& instruction : llvm::instructions(process)) {
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction);
    if (call == nullptr || call->getCalledFunction() == nullptr || call->use_empty()) continue;
    llvm::StringRef name = call->getCalledFunction()->getName();
    unsigned index = 0;
    if (!name.consume_front(unwritten_prefix) || name.getAsInteger(10, index)) continue;
    refuse(top.place, fmt::format("the top may read '{}', or end, before it has written it: a scalar by reference is a "
                                  "result only: write it on every way through the top, and pass what is read by value",
                                  top.parameters.at(index)));
  }
}

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
  if (top.place.line == 0)
    refuse(
        {options.source, line_of_top(options)},
        fmt::format("top '{}' is declared but not defined in this file: name the file that defines it", options.top));
  if (top.parameters.empty())
    refuse(top.place, "the top has no parameters: ports are made of them: give it hls::stream references");
  check_functions(module, process);
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
  check_operations(process);
  check_endless_loops(managers.function.getResult<llvm::LoopAnalysis>(process));
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
  find_unwritten(process, top);
  return result;
}

}  // namespace epiline::frontend
