#include <fmt/format.h>

#include <memory>

#include "eval/commands.hpp"
#include "eval/frame_job.hpp"

namespace epiline::eval {
namespace {

struct compare_options : job_options {
  std::vector<std::string> engines{"golden", "native"};
};

/// True when all maps agree.
bool run(const compare_options& options, const engine_registry& registry) {
  if (options.list) {
    fmt::print("{}", list_designs(registry));
    return true;
  }
  if (options.engines.size() < 2) throw usage_error("--engines needs two names or more, for example golden,native");
  const auto& design = require_design(options.design);
  std::vector<const engine_registry::entry*> entries;
  for (const auto& name : options.engines) entries.push_back(&require_engine(registry, design, name));

  const frame_job job = prepare(options);
  nlohmann::ordered_json json = description_json(options, job);
  json["seed"] = options.run.seed;
  json["input_gap_percent"] = options.run.input_gap_percent;
  json["output_stall_percent"] = options.run.output_stall_percent;
  fmt::print("{} {}x{}, {} levels\n", options.design, job.request.left.width, job.request.left.height,
             job.request.levels);

  disparity_map first;
  std::uint64_t differing = 0;
  for (const auto* entry : entries) {
    const match_result result = run_engine(*entry, job, options.run);
    fmt::print("{}: {}\n", entry->name, timing_text(job, result));
    json["engines"][entry->name] = timing_json(job, result);
    if (entry == entries.front()) {
      first = result.map;
      continue;
    }
    const map_difference difference = compare(first, result.map);
    json["engines"][entry->name]["differing"] = difference.differing;
    differing += difference.differing;
    if (difference.differing != 0) {
      fmt::print("{} differs from {} in {} of {} pixels, first at column {}, row {}\n", entry->name,
                 entries.front()->name, difference.differing, difference.pixels, difference.first_x,
                 difference.first_y);
    }
  }
  const map_figures figures = measure(first, job.truth ? &*job.truth : nullptr);
  json["identical"] = differing == 0;
  json["differing"] = differing;
  json.update(figures_json(figures));
  write_outputs(options, job, first, json);
  fmt::print("{}{}: {}, {} pixels compared, {} differing\n", figures_text(figures),
             fmt::join(options.engines, differing == 0 ? " = " : ", "),
             differing == 0 ? "bit-identical" : "NOT identical", first.defined.size(), differing);
  return differing == 0;
}

}  // namespace

void add_compare_command(CLI::App& application, const engine_registry& registry, int& exit_code) {
  auto* command = application.add_subcommand(
      "compare",
      "match one stereo pair with several engines and compare the maps bit for bit; outputs are the first's");
  const auto options = std::make_shared<compare_options>();
  options->add_to(*command);
  command->add_option("--engines", options->engines, "engines to compare (default golden,native)")
      ->option_text("NAME,NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->callback([options, &registry, &exit_code] { exit_code = run(*options, registry) ? 0 : 1; });
}

}  // namespace epiline::eval
