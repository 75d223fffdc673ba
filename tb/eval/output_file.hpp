#pragma once
// Files that are written whole or not at all.

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace epiline::eval {

/// A file cannot be read or written, or its contents cannot be used; what() names the file, the reason and what to do.
class file_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws file_error unless write_whole_file(path, ...) can be expected to work. Leaves no trace. Called before a long
/// computation whose result goes to `path`.
void require_writable(const std::filesystem::path& path);

/// Writes `contents` to a temporary file beside `path` and renames it, so that `path` holds either what it held before
/// or all of `contents`. Links are followed; what is not a regular file (a pipe, /dev/stdout) is written directly.
/// Throws file_error.
void write_whole_file(const std::filesystem::path& path, std::string_view contents);

}  // namespace epiline::eval
