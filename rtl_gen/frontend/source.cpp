#include "frontend/source.hpp"

#include <fmt/format.h>
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Instructions.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <unordered_map>

namespace epiline::frontend {

namespace {

namespace fs = std::filesystem;

/// What is to be known of a file, once a file: every instruction asks for it.
struct file_facts {
  bool anonymous;     // code that is nobody's line: the type headers, the call of the top, the system's headers
  std::string shown;  // as a person would name it from here
};

file_facts find_facts(const llvm::DIFile& file) {
  // Debug information names files relative to the compilation folder when they lie below it.
  const fs::path name = file.getFilename().str();
  const fs::path full = (name.is_absolute() ? name : fs::path(file.getDirectory().str()) / name).lexically_normal();
  return {file.getFilename().starts_with("<") || !is_users_file(full.string()), shown_path(full.string())};
}

const file_facts& facts_of(const llvm::DIFile& file) {
  struct known_file {
    std::string name;  // what lies at that address now may be another file of another module
    const file_facts* facts;
  };
  thread_local std::map<std::string, file_facts> known;
  thread_local std::unordered_map<const llvm::DIFile*, known_file> seen;
  const auto before = seen.find(&file);
  if (before != seen.end() && before->second.name == file.getFilename()) return *before->second.facts;
  const std::string key = (file.getDirectory() + "|" + file.getFilename()).str();
  auto found = known.find(key);
  if (found == known.end()) found = known.emplace(key, find_facts(file)).first;
  seen[&file] = {file.getFilename().str(), &found->second};
  return found->second;
}

bool is_anonymous(const llvm::DIFile& file) { return facts_of(file).anonymous; }
const std::string& shown_path(const llvm::DIFile& file) { return facts_of(file).shown; }

}  // namespace

bool is_users_file(const std::string& path) {
  const llvm::StringRef text = path;
  return !text.starts_with("<") && !text.starts_with("/usr/") && !text.starts_with(EPILINE_TYPES_DIRECTORY) &&
         !text.starts_with(EPILINE_FRONTEND_INCLUDES);
}

std::string shown_path(const std::string& path) {
  const fs::path full = fs::absolute(path).lexically_normal();
  const std::string near = full.lexically_proximate(fs::current_path()).string();
  return near.size() < full.native().size() ? near : full.string();
}

source_place place_of(const llvm::DebugLoc& location) {
  const llvm::DILocation* at = location.get();
  while (at != nullptr && is_anonymous(*at->getFile()) && at->getInlinedAt() != nullptr) at = at->getInlinedAt();
  // Compiler-made instructions have line 0: their caller's line says more.
  while (at != nullptr && at->getLine() == 0 && at->getInlinedAt() != nullptr) at = at->getInlinedAt();
  if (at == nullptr || is_anonymous(*at->getFile())) return {};
  return {shown_path(*at->getFile()), at->getLine()};
}

source_place place_of(const llvm::Instruction& instruction) {
  for (const llvm::Instruction* at = &instruction; at != nullptr; at = at->getPrevNode())
    if (const source_place place = place_of(at->getDebugLoc()); place.line != 0) return place;
  for (const llvm::Instruction* at = &instruction; at != nullptr; at = at->getNextNode())
    if (const source_place place = place_of(at->getDebugLoc()); place.line != 0) return place;
  return place_of(*instruction.getFunction());
}

source_place instruction_places::of(const llvm::Instruction& instruction) {
  if (nearest_.count(&instruction) == 0) {
    const llvm::BasicBlock& block = *instruction.getParent();
    const auto has_place = [](const llvm::Instruction& at) { return place_of(at.getDebugLoc()).line != 0; };
    const auto first = std::find_if(block.begin(), block.end(), has_place);
    const llvm::Instruction* nearest = first == block.end() ? nullptr : &*first;
    for (const llvm::Instruction& at : block) {
      if (has_place(at)) nearest = &at;
      nearest_[&at] = nearest;
    }
  }
  const llvm::Instruction* const nearest = nearest_.at(&instruction);
  return nearest != nullptr ? place_of(nearest->getDebugLoc()) : place_of(*instruction.getFunction());
}

source_place place_of(const llvm::Function& function) {
  if (const llvm::DISubprogram* program = function.getSubprogram())
    return {shown_path(*program->getFile()), program->getLine()};
  return {};
}

source_place place_of(const llvm::Loop& loop) {
  const source_place place = place_of(loop.getStartLoc());
  return place.line != 0 ? place : place_of(*loop.getHeader()->getFirstNonPHI());
}

bool is_users(const llvm::Function& function) {
  const llvm::DISubprogram* program = function.getSubprogram();
  return program != nullptr && !is_anonymous(*program->getFile());
}

source_place place_of(const llvm::DIVariable& variable) {
  if (variable.getFile() == nullptr) return {};
  return {shown_path(*variable.getFile()), variable.getLine()};
}

void refuse(const source_place& place, const std::string& what) {
  if (place.line == 0) throw refused(fmt::format("error: {}", what));
  throw refused(fmt::format("{}:{}: error: {}", place.file, place.line, what));
}

std::string readable_name(const llvm::Function& function) {
  const std::string name = llvm::demangle(function.getName().str());
  if (!llvm::StringRef(name).starts_with("_Z")) return name;
  // What the demangler cannot read: a lambda's, above all.
  const llvm::DISubprogram* program = function.getSubprogram();
  return program == nullptr || program->getName().starts_with("operator()") ? "a lambda" : program->getName().str();
}

std::string readable_name(const llvm::Instruction& value) {
  llvm::SmallVector<llvm::DbgVariableIntrinsic*> intrinsics;
  llvm::SmallVector<llvm::DbgVariableRecord*> records;
  llvm::findDbgUsers(intrinsics, const_cast<llvm::Instruction*>(&value), &records);
  if (llvm::isa<llvm::PHINode>(value) && value.hasName()) {
    llvm::StringRef name = value.getName().split('.').first;
    if (!name.empty() && name != "cond") return name.rtrim('_').str();
  }
  for (const llvm::DbgVariableRecord* record : records) {
    const llvm::StringRef name = record->getVariable()->getName().rtrim('_');
    if (!name.empty() && name != "this") return name.str();
  }
  return {};
}

}  // namespace epiline::frontend
