#pragma once
// What the commands that run engines on one stereo pair share: their options, and turning those options into a checked
// request before anything long begins.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/engine.hpp"
#include "eval/figures_json.hpp"
#include "eval/metrics.hpp"

namespace epiline::eval {

/// A mistake in what the user asked for; what() says what, where, and what to do.
class usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct job_options {
  std::string design = "color_fuzzy";
  std::string left;
  std::string right;
  std::optional<int> levels;
  std::vector<std::string> settings;  // NAME=VALUE
  std::string output;
  std::string json;
  std::string picture;
  std::string truth;
  std::optional<double> truth_scale;
  std::string mask;
  std::string non_occluded_mask;
  std::string discontinuity_mask;
  run_options run;
  bool list = false;

  /// Adds the options to a subcommand; `this` must outlive it.
  void add_to(CLI::App& command);
};

struct frame_job {
  const design_description* design = nullptr;
  match_request request;
  std::optional<ground_truth> truth;
};

/// The engine of that name, or usage_error naming the known ones.
[[nodiscard]] const engine_registry::entry& require_engine(const engine_registry& registry,
                                                           const design_description& design, std::string_view name);

/// The design of that name, or usage_error naming the known ones.
[[nodiscard]] const design_description& require_design(std::string_view name);

/// One --set NAME=VALUE into the request's parameters, not yet checked against the design. Throws usage_error.
void apply_setting(match_request& request, const std::string& setting);

/// Checks everything that can be checked (names, ranges, output paths, then the images, truth and masks) and reads the
/// inputs. Throws usage_error, file_error or engine_error.
[[nodiscard]] frame_job prepare(const job_options& options);

/// Writes the map, picture and JSON that the options ask for.
void write_outputs(const job_options& options, const frame_job& job, const disparity_map& map,
                   const nlohmann::ordered_json& figures);

/// Design, images, levels and parameters, as every JSON file of figures begins.
[[nodiscard]] nlohmann::ordered_json description_json(const job_options& options, const frame_job& job);

/// Seconds, and cycles where the engine counts them.
[[nodiscard]] nlohmann::ordered_json timing_json(const frame_job& job, const match_result& result);

/// One or more lines for people.
[[nodiscard]] std::string figures_text(const map_figures& figures);
[[nodiscard]] std::string timing_text(const frame_job& job, const match_result& result);

/// Runs an engine with progress on standard error if that is a terminal.
[[nodiscard]] match_result run_engine(const engine_registry::entry& entry, const frame_job& job, run_options options);

/// The table of designs, their parameters and engines, for --list.
[[nodiscard]] std::string list_designs(const engine_registry& registry);

}  // namespace epiline::eval
