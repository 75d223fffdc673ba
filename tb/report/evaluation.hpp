#pragma once
// Runs every method on every pair of a list and measures the maps.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/metrics.hpp"
#include "eval/pair_list.hpp"
#include "report/methods.hpp"

namespace epiline::report {

/// What one method gave on one pair.
struct method_result {
  std::string failure;  // empty: the rest holds
  eval::real_map map;   // NaN = undefined
  eval::map_figures figures;
  double seconds = 0;
  std::optional<std::uint64_t> cycles;
};

struct pair_result {
  eval::pair_entry entry;
  std::string failure;   // why the pair could not be read; empty: the rest holds
  bool missing = false;  // it is in no folder
  bool synthetic = false;
  std::optional<eval::stereo_pair> pair;
  std::vector<method_result> methods;  // in the order of evaluation::methods
};

struct evaluation {
  std::string engine;
  std::vector<method> methods;
  std::vector<pair_result> pairs;

  [[nodiscard]] bool complete() const;
};

/// Called as work proceeds: how many of how many maps are done, and which one was done last.
using progress_function = std::function<void(std::size_t done, std::size_t all, const std::string& last)>;

/// Reads the pairs from `folders`, and runs `jobs` maps at a time, each in a process of its own. What goes wrong with a
/// pair or a map is written down there and keeps nothing else from being evaluated.
[[nodiscard]] evaluation evaluate(std::string engine, std::vector<method> methods,
                                  const std::vector<eval::pair_entry>& entries,
                                  const std::vector<std::filesystem::path>& folders, int jobs,
                                  const progress_function& progress);

}  // namespace epiline::report
