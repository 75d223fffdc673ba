#pragma once
// A folder of the report's files that appears whole or not at all.

#include <filesystem>
#include <map>
#include <string>

namespace epiline::report {

/// Throws eval::file_error unless write_report_folder(folder, ...) can be expected to work: the folder above must be
/// writable, and what is there already must be an empty folder or an earlier report, which has no other files. Leaves
/// no trace.
void require_report_folder(const std::filesystem::path& folder);

/// Writes the files (name to contents) to a new folder beside `folder` and puts that in its place, replacing an earlier
/// report in one step. Throws eval::file_error; then `folder` is what it was.
void write_report_folder(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);

}  // namespace epiline::report
