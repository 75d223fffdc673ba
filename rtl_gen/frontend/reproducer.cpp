#include "frontend/reproducer.hpp"

#include <llvm/ADT/StringRef.h>

#include "frontend/source.hpp"

namespace epiline::frontend {

std::string standalone_source(const std::string& preprocessed) {
  std::string result = "#include \"ap_int.h\"\n#include \"hls_stream.h\"\n";
  bool inside_users = true;
  llvm::StringRef rest = preprocessed;
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    rest = after;
    if (!line.starts_with("# ")) {
      if (inside_users) result += line.str() + "\n";
      continue;
    }
    // `# 12 "file.cpp" 1`: file.cpp is entered; 2: it goes on.
    const auto [before, quoted] = line.split('"');
    const auto [path, flags] = quoted.split('"');
    const bool is_users = is_users_file(path.str()) || path.empty();
    if (inside_users && !is_users && path.starts_with("/") && flags.trim().starts_with("1") &&
        !path.ends_with("epiline/call_top.hpp"))
      result += "#include \"" + path.str() + "\"\n";
    inside_users = is_users;
  }
  return result;
}

}  // namespace epiline::frontend
