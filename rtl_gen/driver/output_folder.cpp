#include "driver/output_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "driver/command_line.hpp"

namespace epiline::driver {

namespace fs = std::filesystem;

namespace {

fs::path temporary(const fs::path& file) { return file.string() + ".part"; }

}  // namespace

output_folder::output_folder(const std::string& path) : path_(path) {
  std::error_code failed;
  made_ = fs::create_directories(path_, failed);
  if (failed || !fs::is_directory(path_))
    throw usage_error(fmt::format("{}: cannot be made: {}: choose another folder with -o", path,
                                  failed ? failed.message() : "it is not a folder"));
}

output_folder::~output_folder() {
  std::error_code ignored;
  for (const fs::path& file : files_) fs::remove(temporary(file), ignored);
  if (made_) fs::remove(path_, ignored);  // which fails when something is in it
}

void output_folder::write_file(const fs::path& file, const std::string& text) {
  files_.push_back(file);
  std::ofstream out(temporary(file), std::ios::binary);
  out << text;
  out.flush();
  if (!out)
    throw usage_error(
        fmt::format("{}: cannot be written: is the folder writable and the disk not full?", file.string()));
}

void output_folder::commit() {
  for (const fs::path& file : files_) fs::rename(temporary(file), file);
  files_.clear();
}

}  // namespace epiline::driver
