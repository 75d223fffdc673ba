#pragma once

#include <filesystem>
#include <string>

namespace epiline::check {

/// Writes a whole file. Throws cannot_check.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace epiline::check
