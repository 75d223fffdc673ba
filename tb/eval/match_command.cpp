#include <fmt/format.h>

#include <memory>

#include "eval/commands.hpp"
#include "eval/frame_job.hpp"

namespace epiline::eval {
namespace {

struct match_options : job_options {
  std::string engine = "native";
};

void run(const match_options& options, const engine_registry& registry) {
  if (options.list) {
    fmt::print("{}", list_designs(registry));
    return;
  }
  const auto& entry = require_engine(registry, require_design(options.design), options.engine);
  const frame_job job = prepare(options);
  const match_result result = run_engine(entry, job, options.run);
  const map_figures figures = measure(result.map, job.truth ? &*job.truth : nullptr);

  nlohmann::ordered_json json = description_json(options, job);
  json["engine"] = options.engine;
  json["seed"] = options.run.seed;
  json["input_gap_percent"] = options.run.input_gap_percent;
  json["output_stall_percent"] = options.run.output_stall_percent;
  json.update(timing_json(job, result));
  json.update(figures_json(figures));
  write_outputs(options, job, result.map, json);
  fmt::print("{} {} {}x{}, {} levels: {}\n{}", options.design, options.engine, job.request.left.width,
             job.request.left.height, job.request.levels, timing_text(job, result), figures_text(figures));
}

}  // namespace

void add_match_command(CLI::App& application, const engine_registry& registry) {
  auto* command = application.add_subcommand("match", "match one stereo pair with one engine");
  const auto options = std::make_shared<match_options>();
  options->add_to(*command);
  command->add_option("--engine", options->engine, "engine to run (default native; see --list)")->option_text("NAME");
  command->callback([options, &registry] { run(*options, registry); });
}

}  // namespace epiline::eval
