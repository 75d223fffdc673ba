#include "frontend/compile.hpp"

#include <fmt/format.h>
#include <llvm/ADT/DenseSet.h>
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/Support/CommandLine.h>
#include <llvm/Support/Error.h>
#include <llvm/Support/FileSystem.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/Path.h>
#include <llvm/Support/Program.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>

#include "frontend/messages.hpp"
#include "frontend/pragmas.hpp"
#include "frontend/source.hpp"
#include "frontend/stream_arrays.hpp"

namespace epiline::frontend {

namespace {

namespace fs = std::filesystem;

constexpr const char* wrapper_file = "<epiline-hls>";

/// A folder of its own for the intermediate files, removed at the end.
class scratch_folder {
 public:
  scratch_folder() {
    llvm::SmallString<128> path;
    if (llvm::sys::fs::createUniqueDirectory("epiline-hls", path))
      throw refused(
          "error: no temporary folder can be made: check that the folder named by TMPDIR (or /tmp) is writable");
    path_ = std::string(path);
  }
  ~scratch_folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw refused(fmt::format("error: cannot write {}: is the disk full?", path));
}

/// Runs clang; its messages go to `messages`. Returns whether it succeeded.
bool run_clang(const std::vector<std::string>& arguments, const std::string& messages) {
  const auto program = llvm::sys::findProgramByName(EPILINE_CLANG);
  if (!program) throw refused(fmt::format("error: {} is not installed: apt-get install clang-19", EPILINE_CLANG));
  std::vector<llvm::StringRef> words{*program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::optional<llvm::StringRef> redirects[] = {llvm::StringRef(), llvm::StringRef(messages),
                                                      llvm::StringRef(messages)};
  const int code = llvm::sys::ExecuteAndWait(*program, words, std::nullopt, redirects);
  if (code < 0) throw std::runtime_error("clang ended by a signal");
  return code == 0;
}

/// The files named by line markers, in order of appearance, without clang's pseudo files.
std::vector<std::string> files_of(const std::string& preprocessed) {
  std::vector<std::string> files;
  std::set<std::string> seen;
  llvm::StringRef rest = preprocessed;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    if (!line.starts_with("# ")) continue;
    const auto [before, quoted] = line.split('"');
    const std::string file = quoted.split('"').first.str();
    if (!file.empty() && file.front() != '<' && fs::exists(file) && seen.insert(file).second) files.push_back(file);
  }
  return files;
}

std::string wrapper_source(const source_options& options) {
  // The flow's headers first: the source may define macros of any name.
  return fmt::format("#include <epiline/call_top.hpp>\n#include \"{}\"\n",
                     fs::absolute(options.source).lexically_normal().string());
}

std::string process_of(std::size_t number) {
  return number == 0 ? process_name : fmt::format("{}_{}", process_name, number);
}

/// The call of a top, behind the preprocessed source. The sizes of arrays are expressions in the top's namespace.
std::string call_source(std::size_t number, const std::string& top, const std::vector<array_parameter>& arrays) {
  std::string counts;
  for (const array_parameter& array : arrays)
    counts += array.size.empty() ? ", 0" : fmt::format(", {}({})", array.is_stream ? "-int" : "", array.size);
  const llvm::StringRef name = llvm::StringRef(top).ltrim(':');
  const std::string space =
      name.contains("::") ? fmt::format("using namespace ::{}; ", name.rsplit("::").first.str()) : "";
  return fmt::format("# 1 \"{}\"\nextern \"C\" void {}() {{ {}epiline::detail::call_for_ever<&::{}{}>(&::{}); }}\n",
                     wrapper_file, process_of(number), space, top, counts, top);
}

[[noreturn]] void refuse_compilation(const source_options& options, const std::vector<std::string>& tops,
                                     const std::string& messages, const std::string& program,
                                     const pragma_places& pragmas = {}) {
  if (messages.find(std::string(wrapper_file) + ":1:") == std::string::npos &&
      messages.find("the top returns a pointer") == std::string::npos)
    throw refused(explain_messages(messages, pragmas));
  // The call of the top does not compile: what is the top then?
  std::size_t number = tops.size();
  while (--number > 0 && messages.find(process_of(number) + "()") == std::string::npos) {  // clang shows the line
  }
  const std::string& top = tops[number];
  const std::string listing = program + ".txt";
  const std::string base = top.substr(top.rfind(':') + 1);
  (void)run_clang({"-std=c++17", "-D__SYNTHESIS__", "-w", "-fsyntax-only", "-Xclang", "-ast-dump", "-Xclang",
                   "-ast-dump-filter=" + base, program},
                  listing);
  throw refused(explain_top(top, shown_path(options.source), read_file(listing)));
}

refused unreadable(llvm::Error failure) {
  return refused("error: clang's output cannot be read: " + llvm::toString(std::move(failure)));
}

/// clang's is of this very version and right. LLVM would look at all of it, that of every other top included, each time
/// it has read a module.
void trust_debug_information() {
  auto& options = llvm::cl::getRegisteredOptions();
  if (const auto found = options.find("disable-auto-upgrade-debug-info"); found != options.end())
    found->second->addOccurrence(0, found->first(), "true");
}

}  // namespace

unsigned line_of_top(const source_options& options) {
  const std::string base = options.top.substr(options.top.rfind(':') + 1);
  std::ifstream in(options.source);
  std::string text;
  for (unsigned line = 1; std::getline(in, text); ++line) {
    const std::size_t at = text.find(base);
    if (at == std::string::npos) continue;
    if (llvm::StringRef(text).drop_front(at + base.size()).ltrim().starts_with("(")) return line;
  }
  return 1;
}

compiled_source compile(const source_options& options, const std::vector<std::string>& tops,
                        llvm::LLVMContext& context) {
  if (!fs::is_regular_file(options.source)) throw refused(fmt::format("error: {}: no such file", options.source));
  const scratch_folder scratch;
  const std::string wrapper = scratch.file("wrapper.cpp");
  const std::string preprocessed = scratch.file("preprocessed.ii");
  const std::string bitcode = scratch.file("module.bc");
  const std::string messages = scratch.file("messages.txt");
  write_file(wrapper, wrapper_source(options));

  std::vector<std::string> common = {"-std=c++17",
                                     "-D__SYNTHESIS__",
                                     "-fno-exceptions",
                                     "-fno-rtti",
                                     "-Wno-unknown-pragmas",
                                     "-Wno-undefined-var-template",
                                     "-Wno-invalid-constexpr",
                                     "-fno-threadsafe-statics"};
  std::vector<std::string> preprocess = common;
  // The types come before a vendor's of the same names; the kernels after the user's own, which may be a changed copy.
  preprocess.insert(preprocess.end(), {"-E", wrapper, "-o", preprocessed, "-I", EPILINE_TYPES_DIRECTORY, "-I",
                                       EPILINE_FRONTEND_INCLUDES});
  for (const std::string& path : options.includes) preprocess.insert(preprocess.end(), {"-I", path});
  preprocess.insert(preprocess.end(), {"-I", EPILINE_TYPES_DIRECTORY "/.."});
  for (const std::string& definition : options.definitions) preprocess.push_back("-D" + definition);
  if (!run_clang(preprocess, messages)) refuse_compilation(options, tops, read_file(messages), preprocessed);

  std::string source = read_file(preprocessed);
  const std::vector<std::vector<array_parameter>> arrays = find_array_parameters(source, tops);
  for (std::size_t number = 0; number < tops.size(); ++number)
    source += call_source(number, tops[number], arrays[number]);
  if (options.on_preprocessed) options.on_preprocessed(source);
  compiled_source result;
  pragma_rewrite rewritten = rewrite_pragmas(source);
  result.notes = std::move(rewritten.notes);
  result.dependencies = files_of(rewritten.source);
  std::erase(result.dependencies, wrapper);
  write_file(preprocessed, rewritten.source);

  std::vector<std::string> translate = common;
  // -O1 without passes: optimisable IR, untouched; our own pipeline decides what happens to it.
  translate.insert(translate.end(),
                   {"-O1", "-Xclang", "-disable-llvm-passes", "-g", "-fno-discard-value-names", "-Wno-everything",
                    "-fno-vectorize", "-emit-llvm", "-c", preprocessed, "-o", bitcode});
  for (const char* mistake : {"uninitialized", "division-by-zero", "shift-count-overflow", "shift-count-negative",
                              "array-bounds"})  // what has no meaning, so that any hardware would be wrong
    translate.push_back(std::string("-Werror=") + mistake);
  if (!run_clang(translate, messages))
    refuse_compilation(options, tops, read_file(messages), preprocessed, rewritten.places);

  trust_debug_information();
  auto buffer = llvm::MemoryBuffer::getFile(bitcode);
  if (!buffer) throw unreadable(llvm::errorCodeToError(buffer.getError()));
  auto module = llvm::getOwningLazyBitcodeModule(std::move(*buffer), context);
  if (!module) throw unreadable(module.takeError());
  result.module = std::move(*module);
  if (llvm::Error failure = result.module->materializeMetadata()) throw unreadable(std::move(failure));
  return result;
}

void keep_top(llvm::Module& module, std::size_t number) {
  if (module.getFunction(process_of(1)) == nullptr) {  // the only one: the module as clang wrote it, in its order
    if (llvm::Error failure = module.materializeAll()) throw unreadable(std::move(failure));
    return;
  }
  llvm::Function* const process = module.getFunction(process_of(number));
  llvm::DenseSet<const llvm::Constant*> kept;
  std::vector<llvm::Constant*> pending{process};
  for (llvm::GlobalVariable& variable : module.globals())
    if (variable.getName().starts_with("llvm.")) pending.push_back(&variable);  // the start-up functions among them
  while (!pending.empty()) {
    llvm::Constant* const constant = pending.back();
    pending.pop_back();
    if (!kept.insert(constant).second) continue;
    for (llvm::Use& operand : constant->operands())
      if (auto* part = llvm::dyn_cast<llvm::Constant>(operand)) pending.push_back(part);
    auto* const function = llvm::dyn_cast<llvm::Function>(constant);
    if (function == nullptr) continue;
    if (llvm::Error failure = function->materialize()) throw unreadable(std::move(failure));
    for (llvm::Instruction& instruction : llvm::instructions(*function))
      for (llvm::Use& operand : instruction.operands())
        if (auto* used = llvm::dyn_cast<llvm::Constant>(operand)) pending.push_back(used);
  }
  std::vector<llvm::GlobalValue*> others;
  for (llvm::GlobalValue& value : module.global_values())
    if (!kept.contains(&value)) others.push_back(&value);
  for (llvm::GlobalValue* value : others) {
    if (auto* function = llvm::dyn_cast<llvm::Function>(value))
      function->deleteBody();
    else if (auto* variable = llvm::dyn_cast<llvm::GlobalVariable>(value))
      variable->setInitializer(nullptr);
  }
  for (llvm::GlobalValue* value : others)
    if (value->use_empty()) value->eraseFromParent();
  if (llvm::Error failure = module.materializeAll()) throw unreadable(std::move(failure));
  process->setName(process_name);
}

}  // namespace epiline::frontend
