#pragma once
// The folder that epiline-hls writes to: nothing half written is ever found there.

#include <filesystem>
#include <string>
#include <vector>

namespace epiline::driver {

/// Files appear under their names only when all of them are written.
class output_folder {
 public:
  /// Makes the folder, if need be. Throws usage_error when that fails.
  explicit output_folder(const std::string& path);
  /// Removes what was not committed, and the folder if it was made here and nothing is in it.
  ~output_folder();
  output_folder(const output_folder&) = delete;
  output_folder& operator=(const output_folder&) = delete;

  /// Throw usage_error when the file cannot be written.
  void write(const std::string& name, const std::string& text) { write_file(path_ / name, text); }
  void write_file(const std::filesystem::path& file, const std::string& text);  // anywhere

  /// Gives the files written since the last time their names.
  void commit();

 private:
  std::filesystem::path path_;
  bool made_ = false;
  std::vector<std::filesystem::path> files_;
};

}  // namespace epiline::driver
