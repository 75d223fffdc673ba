#include "frontend/lower.hpp"

#include <fmt/format.h>
#include <llvm/ADT/MapVector.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Transforms/Scalar/InstSimplifyPass.h>
#include <llvm/Transforms/Scalar/SCCP.h>
#include <llvm/Transforms/Scalar/SimplifyCFG.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/LowerSwitch.h>

#include <algorithm>
#include <map>
#include <set>

#include "frontend/aggregates.hpp"
#include "frontend/calls.hpp"
#include "frontend/checks.hpp"
#include "frontend/copies.hpp"
#include "frontend/data_arrays.hpp"
#include "frontend/fill_tables.hpp"
#include "frontend/function_passes.hpp"
#include "frontend/loops.hpp"
#include "frontend/overflow.hpp"
#include "frontend/payload.hpp"
#include "frontend/pointer_choices.hpp"
#include "frontend/power_up.hpp"
#include "frontend/reference_parameters.hpp"
#include "frontend/start_up.hpp"
#include "frontend/vocabulary.hpp"
#include "frontend/waiting.hpp"

namespace epiline::frontend {

namespace {

/// Stands for what nobody has written; the parameter's index follows.
constexpr const char* unwritten_prefix = "epiline.unwritten.";

/// Replaces the stream, argument and result calls by port accesses.
class port_lowering {
 public:
  port_lowering(lowered_process& result, const process_source& source)
      : result_(result), top_(source.top), source_(source) {}

  void run() {
    std::vector<llvm::CallInst*> calls;
    for (llvm::Instruction& instruction : llvm::instructions(*result_.function))
      if (auto* call = llvm::dyn_cast<llvm::CallInst>(&instruction))
        if (call->getCalledFunction() != nullptr && call->getCalledFunction()->getName().starts_with("__epiline_"))
          calls.push_back(call);
    for (llvm::CallInst* call : calls) bind_ports(*call);
    for (llvm::CallInst* call : calls) find_arguments(*call);
    make_call_port();
    for (llvm::CallInst* call : calls) lower_result(*call);
    for (llvm::CallInst* call : calls) lower_access(*call);
    finish_call_token();
    for (llvm::CallInst* call : finished_) call->eraseFromParent();
    if (source_.is_part) return drop_unused_ports();
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

  static unsigned index_of(const llvm::CallInst& call) { return number_in(call, 0); }

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
        ("is a pointer to what is no value: pass data through hls::stream references, or an array of one dimension of "
         "streams, written with its size"),
        ("is an array of pointers, of streams in two dimensions or of no values: pass data through hls::stream "
         "references, an array of one dimension of them, or an array of values"),
        "is a stream by value or by const reference: pass it as hls::stream<T>&",
        "is an rvalue reference: pass a scalar by value"};
    const auto reason = llvm::cast<llvm::ConstantInt>(call.getArgOperand(1))->getZExtValue();
    refuse(top_.place, fmt::format("parameter '{}' {}", parameter_name(index_of(call)), reasons[reason]));
  }

  void bind_ports(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_unsupported_parameter") refuse_parameter(call);
    const bool internal = name_of(call) == internal_stream_name;
    if (name_of(call) != "__epiline_port" && !internal) return;
    const unsigned port = add_port(internal ? source_.streams[index_of(call)] : parameter_name(index_of(call)),
                                   dataflow::port_kind::stream, true);
    const std::uint64_t array = internal ? llvm::cast<llvm::ConstantInt>(call.getArgOperand(2))->getZExtValue() : 0;
    ports_of_objects_[object_behind(call.getArgOperand(1))] = {port, array};
    finished_.push_back(&call);
  }

  /// The object that a pointer to a stream leads to, and which one of its streams: one has the size of a byte.
  [[nodiscard]] std::pair<const llvm::Value*, std::uint64_t> object_behind(const llvm::Value* pointer) const {
    llvm::APInt offset(64, 0);
    const llvm::Value* const object = pointer->stripAndAccumulateConstantOffsets(layout(), offset, true);
    return {object, offset.getZExtValue()};
  }

  /// A process has a port for each stream of the top that it uses.
  void drop_unused_ports() {
    std::vector<dataflow::port> used;
    std::map<unsigned, unsigned> numbers;
    for (unsigned port = 0; port < result_.ports.size(); ++port) {
      if (result_.ports[port].width == 0) continue;
      numbers[port] = static_cast<unsigned>(used.size());
      used.push_back(result_.ports[port]);
    }
    for (llvm::Instruction& instruction : llvm::instructions(*result_.function))
      if (const access kind = access_of(instruction); kind == access::read || kind == access::write)
        llvm::cast<llvm::CallInst>(instruction)
            .setArgOperand(0, llvm::ConstantInt::get(llvm::Type::getInt32Ty(instruction.getContext()),
                                                     numbers.at(object_of(instruction))));
    result_.ports = std::move(used);
    if (std::none_of(result_.ports.begin(), result_.ports.end(),
                     [](const dataflow::port& port) { return port.kind != dataflow::port_kind::call; }))
      refuse(source_.place, "DATAFLOW: this process neither reads nor writes a stream: remove the call");
  }

  [[nodiscard]] std::vector<leaf> payload_leaves(llvm::Type* type, const source_place& place) const {
    refuse_members_like_padding(type, *result_.function->getParent(), place);
    std::vector<leaf> leaves = leaves_of(type, *result_.function->getParent(), place);
    check_width(width_of(leaves), place);
    return leaves;
  }

  static void check_width(unsigned width, const source_place& place) {
    if (width > dataflow::max_width)
      refuse(place, fmt::format("a token of {} bits: {} are the most: send it in parts, one after another", width,
                                dataflow::max_width));
  }

  void find_arguments(llvm::CallInst& call) {
    if (name_of(call) != "__epiline_argument") return;
    if (first_argument_ == nullptr) first_argument_ = &call;
    llvm::Type* const type = payload_type(call, 2);
    const std::string name = parameter_name(index_of(call));
    std::vector<leaf> leaves = payload_leaves(type, top_.place);
    const unsigned width = width_of(leaves);
    const bool is_signed = leaves.size() == 1 && leaves[0].is_signed;
    arguments_.push_back({&call, type, std::move(leaves), {name, name, width, 0, is_signed}});
    finished_.push_back(&call);
  }

  static void append_field(dataflow::port& port, dataflow::field& field) {
    field.offset = port.width;
    port.fields.push_back(field);
    port.width += field.width;
  }

  /// All scalars by value arrive as one token. A process takes those of them that it uses or, to know that there is a
  /// call, the narrowest.
  void make_call_port() {
    if (arguments_.empty()) return;
    call_port_ = add_port("call", dataflow::port_kind::call, true);
    result_.whole_call = result_.ports[call_port_];
    for (argument& one : arguments_) append_field(result_.whole_call, one.field);
    check_width(result_.whole_call.width, top_.place);
    if (source_.is_part) {
      const auto narrowest = std::min_element(arguments_.begin(), arguments_.end(), [](const auto& a, const auto& b) {
        return a.field.width < b.field.width;
      });
      const argument start = *narrowest;
      std::erase_if(arguments_, [](const argument& one) { return !is_read(*one.call->getArgOperand(1), *one.call); });
      if (arguments_.empty()) arguments_.push_back(start);
    }
    for (argument& one : arguments_) append_field(result_.ports[call_port_], one.field);
  }

  /// Whether anything but `filler` looks at a variable.
  static bool is_read(const llvm::Value& pointer, const llvm::CallInst& filler) {
    return std::any_of(pointer.user_begin(), pointer.user_end(), [&](const llvm::User* user) {
      if (llvm::isa<llvm::GetElementPtrInst>(user)) return is_read(*user, filler);
      const auto* intrinsic = llvm::dyn_cast<llvm::IntrinsicInst>(user);
      return user != &filler && (intrinsic == nullptr || !intrinsic->isLifetimeStartOrEnd());
    });
  }

  void lower_result(llvm::CallInst& call) {
    if (name_of(call) == "__epiline_unwritten") leave_unwritten(call);
    if (name_of(call) != "__epiline_result") return;
    const unsigned port = add_port(parameter_name(index_of(call)), dataflow::port_kind::result, false);
    write(call, port, call.getArgOperand(1), payload_type(call, 2));
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
          builder.CreateTrunc(builder.CreateLShr(token, one.field.offset), builder.getIntNTy(width_of(one.leaves)));
      unpack_token(builder, bits, one.call->getArgOperand(1), one.type, one.leaves);
    }
  }

  unsigned port_of(const llvm::CallInst& call) const {
    const auto object = object_behind(call.getArgOperand(0));
    const auto found = ports_of_objects_.find(object);
    if (found == ports_of_objects_.end()) {
      if (llvm::isa<llvm::PHINode, llvm::SelectInst, llvm::GetElementPtrInst>(object.first))
        refuse(place_of(call), "a stream is chosen at run time: access each stream in a branch of its own");
      refuse(place_of(call),
             source_.is_part
                 ? "an hls::stream inside of a process: declare it in the function with DATAFLOW"
                 : "an internal hls::stream joins functions with #pragma HLS DATAFLOW in the top only: without it, use "
                   "variables between kernels of one loop");
    }
    return found->second.port;
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

  /// How far behind its pointer the array begins that an element is chosen of: what stands before the first variable.
  [[nodiscard]] std::uint64_t offset_of_array(const llvm::GEPOperator& element) const {
    std::vector<llvm::Value*> indices(element.idx_begin(), element.idx_end());
    indices.erase(std::find_if_not(indices.begin(), indices.end(), llvm::IsaPred<llvm::ConstantInt>), indices.end());
    return static_cast<std::uint64_t>(layout().getIndexedOffsetInType(element.getSourceElementType(), indices));
  }

  /// `lanes[i].write(v)`: an access of each stream of the array, on the condition that it is the one. Where a loop over
  /// them is unrolled later, one is left. Returns whether the access is replaced.
  bool expand_choice(llvm::CallInst& call) {
    const auto* element = llvm::dyn_cast<llvm::GEPOperator>(call.getArgOperand(0));
    if (element == nullptr || object_behind(element).first != element) return false;
    const auto [object, unused] = object_behind(element->getPointerOperand());
    llvm::MapVector<llvm::Value*, llvm::APInt> variable;
    llvm::APInt constant(64, unused);
    if (!element->collectOffset(layout(), 64, variable, constant)) return false;
    const auto first = ports_of_objects_.find({object, unused + offset_of_array(*element)});
    const std::uint64_t array = first == ports_of_objects_.end() ? 0 : first->second.array;
    std::vector<std::uint64_t> elements;
    for (const auto& [stream, place] : ports_of_objects_)
      if (stream.first == object && place.array == array) elements.push_back(stream.second);
    if (elements.empty()) return false;
    llvm::IRBuilder<> builder(&call);
    llvm::Value* number = builder.getInt(constant);
    for (const auto& [value, scale] : variable)
      number = builder.CreateAdd(
          number, builder.CreateMul(builder.CreateSExtOrTrunc(value, builder.getInt64Ty()), builder.getInt(scale)));
    for (const std::uint64_t which : elements) {
      builder.SetInsertPoint(&call);
      llvm::Value* const chosen = builder.CreateICmpEQ(number, builder.getInt64(which));
      auto* one = llvm::cast<llvm::CallInst>(call.clone());
      one->insertBefore(llvm::SplitBlockAndInsertIfThen(chosen, call.getIterator(), false));
      builder.SetInsertPoint(one);
      one->setArgOperand(
          0, builder.CreateConstInBoundsGEP1_64(builder.getInt8Ty(), const_cast<llvm::Value*>(object), which));
      lower_access(*one);
    }
    finished_.push_back(&call);
    return true;
  }

  void lower_access(llvm::CallInst& call) {
    if (name_of(call).starts_with("__epiline_stream_") && expand_choice(call)) return;
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
    }
  }

  struct stream_port {
    unsigned port = 0;
    std::uint64_t array = 0;  // where in the object the array begins that the stream is in; 0 in the top's own
  };
  struct argument {
    llvm::CallInst* call;
    llvm::Type* type;
    std::vector<leaf> leaves;
    dataflow::field field;
  };

  lowered_process& result_;
  const top_description& top_;
  const process_source& source_;
  std::map<std::pair<const llvm::Value*, std::uint64_t>, stream_port> ports_of_objects_;  // by object and its element
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
        call != nullptr && call->doesNotReturn() && !llvm::isa<llvm::IntrinsicInst>(call) && !is_no_number(*call))
      ends.push_back(call);
  for (llvm::CallInst* call : ends) call->eraseFromParent();
}

}  // namespace

lowered_process lower(process_source& source) {
  llvm::Module& module = *source.module;
  module.setIsNewDbgInfoFormat(true);
  lowered_process result;
  result.function = module.getFunction(process_name);
  llvm::Function& process = *result.function;
  analysis_managers managers;

  result.top_place = source.top.place;
  check_functions(module, process);
  const std::set<const llvm::GlobalVariable*> unknown = run_start_up_code(module);
  inline_everything(module, {&process}, managers);
  check_initial_values(unknown, process);
  for (llvm::Function& function : module)
    if (&function != &process && !function.isDeclaration()) function.deleteBody();
  managers.function.clear();

  wait_instead_of_asking(process, managers, source.is_part);
  note_loops_of_pragmas(process);
  split_whole_structs(process);
  write_out_overflow(process);  // the source's own
  expand_copies(process, unknown_types::kept);
  resolve_pointer_choices(process);
  run_passes(process, managers, early_cleanup());
  fill_tables(process, managers);
  check_operations(process);
  check_endless_loops(managers.function.getResult<llvm::LoopAnalysis>(process));
  cut_after_noreturn(process);
  if (!source.is_part) {
    pass_what_is_read(process, source.top);
    if (connect_data_arrays(process, source.top, managers.function, false, result.notes))
      run_passes(process, managers, early_cleanup());
  }
  port_lowering(result, source).run();
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, early_cleanup());

  rotate_loops(process, managers.function);  // makes trip counts exact
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  result.initiation_interval = unroll_loops(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  compute_mathematics(process, managers);
  expand_copies(process, unknown_types::refused);
  {
    llvm::FunctionPassManager passes;
    passes.addPass(llvm::InstSimplifyPass());
    passes.addPass(llvm::SCCPPass());
    passes.addPass(llvm::SimplifyCFGPass(plain_control_flow()));
    run_passes(process, managers, std::move(passes));
  }
  refuse_no_numbers(process);
  resolve_pointer_choices(process);
  split_aggregates(result);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, late_cleanup());
  rotate_loops(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  run_passes(process, managers, late_cleanup());
  write_out_overflow(process);  // the last passes that make any are over
  look_ahead(process, managers.function);
  managers.function.invalidate(process, llvm::PreservedAnalyses::none());
  fold_power_up(process);
  narrow_counters(process, managers.function);
  find_unwritten(process, source.top);
  return result;
}

}  // namespace epiline::frontend
