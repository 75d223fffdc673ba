#include "check/files.hpp"

#include <fmt/format.h>

#include <fstream>

#include "check/check.hpp"

namespace epiline::check {

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.flush();
  if (!out)
    throw cannot_check(
        fmt::format("error: {}: cannot be written: is the folder writable and the disk not full?", file.string()));
}

}  // namespace epiline::check
