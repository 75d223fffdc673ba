#include "eval/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace epiline::eval {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw file_error(fmt::format("cannot write {}: {}; choose a file in a directory you may write to", path.string(),
                               std::generic_category().message(error)));
}

bool is_special(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Where the bytes end up once symbolic links are followed.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

void write_all(int descriptor, std::string_view contents, const fs::path& path) {
  while (!contents.empty()) {
    const ssize_t written = ::write(descriptor, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, errno);
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// An open temporary file that disappears unless it is renamed.
class temporary_file {
 public:
  explicit temporary_file(const fs::path& target) : target_(target) {
    if (fs::is_directory(target)) fail(target, EISDIR);
    name_ = (target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string();
    descriptor_ = ::mkstemp(name_.data());
    if (descriptor_ < 0) fail(target, errno);
  }
  temporary_file(const temporary_file&) = delete;
  temporary_file& operator=(const temporary_file&) = delete;
  ~temporary_file() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  void write_and_rename(std::string_view contents) {
    write_all(descriptor_, contents, target_);
    // mkstemp makes a private file; give it the mode an ordinary new file would have, or the one it replaces.
    struct stat existing{};
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const mode_t mode = ::stat(target_.c_str(), &existing) == 0 ? existing.st_mode & 0777 : 0666 & ~mask;
    if (::fchmod(descriptor_, mode) != 0) fail(target_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(target_, errno);
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    name_.clear();
  }

 private:
  fs::path target_;
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

void require_writable(const fs::path& path) {
  if (is_special(path)) {
    if (::access(path.c_str(), W_OK) != 0) fail(path, errno);
    return;
  }
  const temporary_file attempt(target_of(path));
}

void write_whole_file(const fs::path& path, std::string_view contents) {
  if (is_special(path)) {
    const int descriptor = ::open(path.c_str(), O_WRONLY);
    if (descriptor < 0) fail(path, errno);
    try {
      write_all(descriptor, contents, path);
    } catch (...) {
      ::close(descriptor);
      throw;
    }
    ::close(descriptor);
    return;
  }
  temporary_file(target_of(path)).write_and_rename(contents);
}

}  // namespace epiline::eval
