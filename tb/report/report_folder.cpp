#include "report/report_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "eval/output_file.hpp"
#include "report/figures_files.hpp"

namespace epiline::report {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> file_names = {"index.html", "figures.json", "figures.csv"};

[[noreturn]] void fail(const fs::path& folder, const std::string& why) {
  throw eval::file_error(fmt::format("cannot write the report to {}: {}", folder.string(), why));
}

[[noreturn]] void fail(const fs::path& folder, int error) {
  fail(folder, std::generic_category().message(error) + "; choose a folder in a directory you may write to");
}

/// The folder itself, links followed, without a slash at its end.
fs::path place_of(const fs::path& folder) {
  fs::path place = fs::weakly_canonical(fs::absolute(folder));
  if (!place.has_filename()) place = place.parent_path();
  return place;
}

void require_replaceable(const fs::path& place, const fs::path& named) {
  if (!fs::exists(place)) return;
  if (!fs::is_directory(place)) fail(named, "it is a file; name a folder");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(place, error)) {
    const auto name = entry.path().filename().string();
    if (!file_names.contains(name)) {
      fail(named,
           fmt::format("it holds '{}', which is not of a report, and would be lost; name a new or an empty folder",
                       name));
    }
  }
  if (error) fail(named, error.value());
  std::ifstream figures(place / "figures.json");
  const std::string text{std::istreambuf_iterator<char>(figures), std::istreambuf_iterator<char>()};
  if (!fs::is_empty(place) && text.find(figures_schema) == std::string::npos) {
    fail(named, "its figures.json is not of a report of epiline evaluate; name a new or an empty folder");
  }
}

/// A new folder beside `place`, gone at the end unless it was put in its place.
class temporary_folder {
 public:
  temporary_folder(const fs::path& place, const fs::path& named) {
    name_ = (place.parent_path() / fmt::format(".{}.XXXXXX", place.filename().string())).string();
    if (::mkdtemp(name_.data()) == nullptr) fail(named, errno);
  }
  temporary_folder(const temporary_folder&) = delete;
  temporary_folder& operator=(const temporary_folder&) = delete;
  ~temporary_folder() {
    std::error_code ignored;
    fs::remove_all(name_, ignored);
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace

void require_report_folder(const fs::path& folder) {
  const fs::path place = place_of(folder);
  require_replaceable(place, folder);
  const temporary_folder attempt(place, folder);
}

void write_report_folder(const fs::path& folder, const std::map<std::string, std::string>& files) {
  const fs::path place = place_of(folder);
  require_replaceable(place, folder);
  const temporary_folder temporary(place, folder);
  for (const auto& [name, contents] : files) eval::write_whole_file(fs::path(temporary.name()) / name, contents);
  // mkdtemp makes a private folder; give it the mode an ordinary new one would have.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::chmod(temporary.name().c_str(), 0777 & ~mask) != 0) fail(folder, errno);
  // An earlier report changes places with the new one, and goes with the temporary folder.
  const unsigned how = fs::exists(place) ? RENAME_EXCHANGE : 0U;
  if (::renameat2(AT_FDCWD, temporary.name().c_str(), AT_FDCWD, place.c_str(), how) != 0) fail(folder, errno);
}

}  // namespace epiline::report
