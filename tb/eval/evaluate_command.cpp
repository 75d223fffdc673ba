#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "eval/commands.hpp"
#include "eval/frame_job.hpp"
#include "report/evaluation.hpp"
#include "report/figures_files.hpp"
#include "report/page.hpp"
#include "report/report_folder.hpp"

namespace epiline::eval {
namespace {

struct evaluate_options {
  std::vector<std::string> designs{"all"};
  std::string pairs = "data/pairs.json";
  std::string data;
  std::string output;
  std::string engine = "native";
  std::string timing;
  std::vector<std::string> only;
  bool skip_missing = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

/// The methods of the designs asked for, and OpenCV's. With `all`, designs that lack the engine are left out.
std::vector<report::method> methods_of(const evaluate_options& options, const engine_registry& registry) {
  std::vector<report::method> methods;
  const auto add = [&](std::vector<report::method> more) {
    methods.insert(methods.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  if (options.designs == std::vector<std::string>{"all"}) {
    std::vector<std::string_view> without;
    std::vector<std::string_view> names;
    for (const auto& design : all_designs()) {
      if (design.same_maps_as.empty()) names.push_back(design.name);
    }
    std::ranges::sort(names);  // which is the order of the methods' numbers
    for (const auto name : names) {
      if (const auto* engine = registry.find(name, options.engine)) {
        add(report::methods_of(require_design(name), *engine));
      } else {
        without.push_back(name);
      }
    }
    // No design has it: say so as for one of them, with the known names.
    if (methods.empty()) (void)require_engine(registry, all_designs().front(), options.engine);
    if (!without.empty()) {
      fmt::print("left out, having no engine {}: {}\n", options.engine, fmt::join(without, ", "));
    }
  } else {
    for (const auto& name : options.designs) {
      const auto& design = require_design(name);
      const auto& engine = require_engine(registry, design, options.engine);
      if (std::ranges::find(methods, &design, &report::method::design) != methods.end()) {
        throw usage_error(fmt::format("--design names {} twice", name));
      }
      add(report::methods_of(design, engine));
    }
  }
  add(report::opencv_methods());
  return methods;
}

/// The pairs of the list and the synthetic one, or those of them that --only names.
std::vector<report::pair_result> chosen_pairs(const evaluate_options& options) {
  auto entries = read_pair_list(options.pairs);
  bool with_corridor = std::ranges::find(entries, report::corridor_name, &pair_entry::scene) == entries.end();
  if (!options.only.empty()) {
    std::vector<std::string_view> known;
    for (const auto& entry : entries) known.push_back(entry.scene);
    if (with_corridor) known.push_back(report::corridor_name);
    for (const auto& name : options.only) {
      if (std::ranges::find(known, name) != known.end()) continue;
      const auto closest = closest_name(name, known);
      throw usage_error(fmt::format("there is no pair '{}'{}; pairs: {}", name,
                                    closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest),
                                    fmt::join(known, ", ")));
    }
    const auto unwanted = [&](std::string_view name) {
      return std::ranges::find(options.only, name) == options.only.end();
    };
    std::erase_if(entries, [&](const pair_entry& entry) { return unwanted(entry.scene); });
    with_corridor = with_corridor && !unwanted(report::corridor_name);
  }
  auto pairs = report::read_pairs(entries, pair_folders(options.pairs, options.data));
  if (options.skip_missing) std::erase_if(pairs, [](const report::pair_result& pair) { return pair.missing; });
  if (with_corridor) pairs.push_back(report::synthetic_corridor());
  return pairs;
}

/// What to type to get the same report.
std::string command_of(const evaluate_options& options) {
  std::string command = fmt::format("epiline evaluate --design {} --pairs {} -o {} --engine {}",
                                    fmt::join(options.designs, ","), options.pairs, options.output, options.engine);
  if (!options.data.empty()) command += " --data " + options.data;
  if (!options.timing.empty()) command += " --timing " + options.timing;
  for (const auto& name : options.only) command += " --only " + name;
  return command;
}

void show_progress(std::size_t done, std::size_t all, const std::string& last) {
  if (::isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\r\033[K{} of {} maps ({})", done, all, last);
  if (done == all) fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

void print_results(const report::evaluation& found) {
  for (const auto& pair : found.pairs) {
    if (!pair.pair) {
      fmt::print("{}: not evaluated: {}\n", pair.entry.scene, pair.failure);
      continue;
    }
    fmt::print("{} {}x{}, {} levels\n", pair.entry.scene, pair.pair->left.width, pair.pair->left.height,
               pair.entry.levels);
    for (std::size_t m = 0; m < found.methods.size(); ++m) {
      const auto& result = pair.methods[m];
      const auto& name = found.methods[m].id;
      if (!result.failure.empty()) {
        fmt::print("  {:<24} failed: {}\n", name, result.failure);
      } else if (result.figures.all) {
        fmt::print("  {:<24} accuracy {:5.1f} %, coverage {:5.1f} %\n", name, result.figures.all->accuracy(),
                   result.figures.coverage());
      } else {
        fmt::print("  {:<24} coverage {:5.1f} %\n", name, result.figures.coverage());
      }
    }
  }
}

/// True when every pair could be evaluated.
bool run(const evaluate_options& options, const engine_registry& registry) {
  const auto start = std::chrono::steady_clock::now();
  auto methods = methods_of(options, registry);
  const auto timing = options.timing.empty() ? report::timings{} : report::read_timings(options.timing);
  report::require_report_folder(options.output);
  const auto found =
      report::evaluate(options.engine, std::move(methods), chosen_pairs(options), options.jobs, show_progress);
  print_results(found);
  const report::report_contents contents{found, timing, EPILINE_VERSION, command_of(options)};
  report::write_report_folder(
      options.output,
      {{"index.html", report::page_of(contents)},
       {"figures.json",
        report::evaluation_json(contents).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"},
       {"figures.csv", report::evaluation_csv(found)}});
  const bool complete = found.complete();
  fmt::print("{} in {:.1f} s{}\n", (std::filesystem::path(options.output) / "index.html").string(),
             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
             complete ? "" : "; not everything could be evaluated (see above)");
  return complete;
}

}  // namespace

void add_evaluate_command(CLI::App& application, const engine_registry& registry, int& exit_code) {
  auto* command = application.add_subcommand(
      "evaluate", "compare designs and OpenCV's matchers on pairs with known truth: an HTML page, JSON and CSV");
  const auto options = std::make_shared<evaluate_options>();
  command->add_option("--design", options->designs, "designs to evaluate, or all (default)")
      ->option_text("NAME,NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--pairs", options->pairs, "list of pairs (default data/pairs.json; see docs/data.md)")
      ->option_text("FILE.json");
  command
      ->add_option("--data", options->data,
                   "folder with a folder a pair (default: beside the list, EPILINE_DATA, ../shared/data, "
                   "data/downloads; the first that has the pair)")
      ->option_text("FOLDER");
  command->add_option("-o,--output", options->output, "folder of the report; an earlier report in it is replaced")
      ->option_text("FOLDER")
      ->required();
  command->add_option("--engine", options->engine, "what computes the maps (default native)")->option_text("NAME");
  command
      ->add_option("--timing", options->timing,
                   "measured clocks a frame and clock frequency, as scripts/frame_rates.py writes them")
      ->option_text("FILE.json");
  command
      ->add_option("--only", options->only,
                   "only this pair, of the list or corridor, which is synthetic; may be repeated")
      ->option_text("PAIR")
      ->allow_extra_args(false);
  command->add_flag("--skip-missing", options->skip_missing,
                    "leave out pairs that are in no folder instead of reporting them");
  command->add_option("-j,--jobs", options->jobs, "maps computed at a time (default: as many as processors)")
      ->option_text("N")
      ->check(CLI::Range(1, 256));
  command->callback([options, &registry, &exit_code] { exit_code = run(*options, registry) ? 0 : 1; });
}

}  // namespace epiline::eval
