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

/// A pair that tb/scenes renders with its exact truth, in place of one whose truth is not public: the paper's Corridor.
[[nodiscard]] pair_result synthetic_corridor();
inline constexpr std::string_view corridor_name = "corridor";

/// Called as work proceeds: how many of how many maps are done, and which one was done last.
using progress_function = std::function<void(std::size_t done, std::size_t all, const std::string& last)>;

/// Reads the pairs of a list. What goes wrong with one is written down in it.
[[nodiscard]] std::vector<pair_result> read_pairs(const std::vector<eval::pair_entry>& entries,
                                                  const std::vector<std::filesystem::path>& folders);

/// Runs every method on every pair that could be read, `jobs` maps at a time, each in a process of its own. What goes
/// wrong with a map is written down in its place and keeps nothing else from being evaluated.
[[nodiscard]] evaluation evaluate(std::string engine, std::vector<method> methods, std::vector<pair_result> pairs,
                                  int jobs, const progress_function& progress);

}  // namespace epiline::report
