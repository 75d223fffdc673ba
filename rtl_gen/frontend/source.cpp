#include "frontend/source.hpp"

#include <fmt/format.h>
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/DebugInfoMetadata.h>

#include <filesystem>

namespace epiline::frontend {

namespace {

namespace fs = std::filesystem;

/// Debug information names files relative to the compilation folder when they lie below it.
fs::path full_path(const llvm::DIFile& file) {
  const fs::path name = file.getFilename().str();
  return (name.is_absolute() ? name : fs::path(file.getDirectory().str()) / name).lexically_normal();
}

/// Code that is nobody's line: the type headers, the call of the top, the system's headers.
bool is_type_header(const llvm::DIFile& file) {
  if (file.getFilename().starts_with("<")) return true;
  const std::string path = full_path(file).string();
  if (llvm::StringRef(path).starts_with("/usr/")) return true;
  return llvm::StringRef(path).starts_with(EPILINE_TYPES_DIRECTORY) || llvm::StringRef(path).starts_with(EPILINE_FRONTEND_INCLUDES);
}

/// As a person would name it from here.
std::string shown_path(const llvm::DIFile& file) {
  const fs::path path = full_path(file);
  const std::string near = path.lexically_proximate(fs::current_path()).string();
  return near.size() < path.string().size() ? near : path.string();
}

}  // namespace

source_place place_of(const llvm::DebugLoc& location) {
  const llvm::DILocation* at = location.get();
  while (at != nullptr && is_type_header(*at->getFile()) && at->getInlinedAt() != nullptr) at = at->getInlinedAt();
  // Compiler-made instructions have line 0: their caller's line says more.
  while (at != nullptr && at->getLine() == 0 && at->getInlinedAt() != nullptr) at = at->getInlinedAt();
  if (at == nullptr || is_type_header(*at->getFile())) return {};
  return {shown_path(*at->getFile()), at->getLine()};
}

source_place place_of(const llvm::Instruction& instruction) {
  for (const llvm::Instruction* at = &instruction; at != nullptr; at = at->getPrevNode())
    if (const source_place place = place_of(at->getDebugLoc()); place.line != 0) return place;
  for (const llvm::Instruction* at = &instruction; at != nullptr; at = at->getNextNode())
    if (const source_place place = place_of(at->getDebugLoc()); place.line != 0) return place;
  return place_of(*instruction.getFunction());
}

source_place place_of(const llvm::Function& function) {
  if (const llvm::DISubprogram* program = function.getSubprogram())
    return {shown_path(*program->getFile()), program->getLine()};
  return {};
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
  return llvm::demangle(function.getName().str());
}

}  // namespace epiline::frontend
