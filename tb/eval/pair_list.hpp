#pragma once
// Lists of stereo pairs with ground truth (data/pairs.json, docs/data.md), and loading a pair that such a list names.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/metrics.hpp"

namespace epiline::eval {

/// One entry of a list.
struct pair_entry {
  std::string scene;   // also the name of its folder
  std::string family;  // where it comes from, in words
  int levels = 0;      // 1 .. largest_levels
  /// Grey level / scale = disparity; none: the truth is a PFM file in pixels.
  std::optional<double> truth_scale;
  std::vector<std::string> files;           // names
  std::vector<std::string> optional_files;  // of these, the ones that may be missing
};
inline constexpr int largest_levels = 128;

/// Throws file_error when the file cannot be read, is not JSON, lacks a field, has an unknown one, a value of a wrong
/// type or out of range (naming the place in the file, as `[3].levels`), or names a scene twice.
[[nodiscard]] std::vector<pair_entry> read_pair_list(const std::filesystem::path& list);

/// The folders where pairs of a list are looked for, first to last: `data` alone if it is not empty; else the list's
/// own folder, the folder that the environment names in EPILINE_DATA, `../shared/data` beside the list's project, and
/// `downloads` beside the list.
[[nodiscard]] std::vector<std::filesystem::path> pair_folders(const std::filesystem::path& list,
                                                              const std::filesystem::path& data);

struct stereo_pair {
  pair_entry entry;
  rgb_image left;
  rgb_image right;
  /// With masks of non-occluded pixels and of those near discontinuities, from files or derived (see truth_masks.hpp).
  std::optional<ground_truth> truth;
  std::string non_occluded_source;        // in words; empty when there is no such mask
  std::string near_discontinuity_source;  // in words
  std::vector<std::string> notes;         // what a reader of figures should know
};

/// A pair of a list that is not in any folder.
class missing_pair : public file_error {
 public:
  using file_error::file_error;
};

/// Reads the pair from the first of the folders that has one of its name. A file is found by its name in the list or,
/// in another format, by its stem. Throws missing_pair, and file_error when a file is missing, damaged or of another
/// size than the images, when a mask selects nothing, or when the truth does not fit the images at the stated scale.
[[nodiscard]] stereo_pair load_pair(const pair_entry& entry, const std::vector<std::filesystem::path>& folders);

}  // namespace epiline::eval
