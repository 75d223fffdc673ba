#include "eval/frame_job.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <set>

namespace epiline::eval {
namespace {

std::string suggestion(std::string_view name, const std::vector<std::string_view>& known) {
  const auto closest = closest_name(name, known);
  return closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest);
}

}  // namespace

void apply_setting(match_request& request, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw usage_error(fmt::format("--set {}: write NAME=VALUE, for example --set uniqueness=17", setting));
  }
  const std::string_view text = std::string_view(setting).substr(equals + 1);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw usage_error(fmt::format("--set {}: '{}' is not an integer", setting, text));
  }
  request.parameters[setting.substr(0, equals)] = value;
}

namespace {

void check_outputs(const job_options& options) {
  if (!options.output.empty()) require_map_extension(options.output);
  if (!options.picture.empty() && !options.picture.ends_with(".png")) {
    throw file_error(fmt::format("cannot write {}: a picture's name ends in .png", options.picture));
  }
  std::set<std::filesystem::path> seen;
  for (const auto& path : {options.output, options.picture, options.json}) {
    if (path.empty()) continue;
    require_writable(path);
    if (std::filesystem::is_character_file(path)) continue;
    if (!seen.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(path))).second) {
      throw usage_error(fmt::format("{} is named for two outputs; give each a file of its own", path));
    }
  }
}

void require_size(const std::string& path, int width, int height, const rgb_image& image) {
  if (width == image.width && height == image.height) return;
  throw file_error(fmt::format("{} is {}x{}, but the images are {}x{}: they must have one size", path, width, height,
                               image.width, image.height));
}

std::optional<pixel_mask> read_mask_of(const std::string& path, const rgb_image& image) {
  if (path.empty()) return std::nullopt;
  pixel_mask mask = read_mask(path);
  require_size(path, mask.width, mask.height, image);
  return mask;
}

std::optional<ground_truth> read_ground_truth(const job_options& options, const rgb_image& image) {
  if (options.truth.empty()) return std::nullopt;
  ground_truth truth{read_truth(options.truth, options.truth_scale), read_mask_of(options.mask, image),
                     read_mask_of(options.non_occluded_mask, image), read_mask_of(options.discontinuity_mask, image)};
  require_size(options.truth, truth.disparity.width, truth.disparity.height, image);
  return truth;
}

}  // namespace

void job_options::add_to(CLI::App& command) {
  command.add_option("left", left, "left image, 8 bits a colour")->option_text("LEFT");
  command.add_option("right", right, "right image of the same size")->option_text("RIGHT");
  command.add_option("--design", design, "design to run (default color_fuzzy; see --list)")->option_text("NAME");
  command.add_option("--levels", levels, "disparity levels (default 80, or the design's maximum)")->option_text("N");
  command.add_option("--set", settings, "run-time parameter NAME=VALUE; may be repeated (see --list)")
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("-o,--output", output,
                  "disparity map: .pfm (undefined = inf), .png (16 bit, disparity * 256, 0 = undefined) or .pgm "
                  "(8 bit, 255 = undefined)")
      ->option_text("FILE");
  command.add_option("--picture", picture, "colour picture for people, undefined pixels black")
      ->option_text("FILE.png");
  command.add_option("--json", json, "figures: time, cycles, coverage, accuracy, ...")->option_text("FILE");
  command.add_option("--truth", truth, "true disparities of the left image (PFM, PGM, PNG): adds accuracy")
      ->option_text("FILE");
  command
      .add_option("--truth-scale", truth_scale,
                  "disparity = value / scale (default 1 for PFM and 8-bit, 256 for 16-bit pictures)")
      ->option_text("N");
  command.add_option("--mask", mask, "only pixels that are 255 here count for accuracy")->option_text("FILE");
  command.add_option("--mask-nonocc", non_occluded_mask, "255 = not occluded: adds accuracy over those pixels")
      ->option_text("FILE");
  command
      .add_option("--mask-disc", discontinuity_mask,
                  "255 = near a depth discontinuity: adds accuracy over those pixels")
      ->option_text("FILE");
  command.add_option("--seed", run.seed, "seed of random input gaps and output stalls (default 1)")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);  // -1 would become a large number
  command
      .add_option("--input-gaps", run.input_gap_percent,
                  "rtl, netlist: chance in per cent, 0 to 95, that an input pauses in a clock (default 0)")
      ->option_text("PERCENT")
      ->check(CLI::Range(0, 95));
  command
      .add_option("--output-stalls", run.output_stall_percent,
                  "rtl, netlist: chance in per cent, 0 to 95, that the output waits in a clock (default 0)")
      ->option_text("PERCENT")
      ->check(CLI::Range(0, 95));
  command.add_option("--port", run.port, "board: its serial port, for example /dev/ttyUSB0")->option_text("PORT");
  command.add_option("--baud", run.baud, "board: rate of the serial port (default 3000000)")->option_text("N");
  command
      .add_option("--patience", run.patience_milliseconds,
                  "board: milliseconds that it may say nothing before that is an error (default 5000)")
      ->option_text("N")
      ->check(CLI::Range(100, 600'000));
  command.add_flag("--list", list, "list designs, their parameters and engines, and stop");
}

const design_description& require_design(std::string_view name) {
  if (const auto* design = find_design(name)) return *design;
  std::vector<std::string_view> known;
  for (const auto& design : all_designs()) known.push_back(design.name);
  throw usage_error(
      fmt::format("unknown design '{}'{}; designs: {}", name, suggestion(name, known), fmt::join(known, ", ")));
}

const engine_registry::entry& require_engine(const engine_registry& registry, const design_description& design,
                                             std::string_view name) {
  if (const auto* entry = registry.find(design.name, name)) return *entry;
  std::vector<std::string_view> known;
  for (const auto* entry : registry.engines_of(design.name)) known.push_back(entry->name);
  throw usage_error(fmt::format("design {} has no engine '{}'{}; engines: {}", design.name, name,
                                suggestion(name, known), fmt::join(known, ", ")));
}

frame_job prepare(const job_options& options) {
  frame_job job;
  job.design = &require_design(options.design);
  job.request.levels = options.levels.value_or(job.design->default_levels);
  job.request.parameters = default_parameters(*job.design);
  for (const auto& setting : options.settings) apply_setting(job.request, setting);
  check_settings(*job.design, job.request);
  if (options.left.empty() || options.right.empty()) {
    throw usage_error("name two images: LEFT and RIGHT (see --help)");
  }
  const bool has_mask =
      !options.mask.empty() || !options.non_occluded_mask.empty() || !options.discontinuity_mask.empty();
  if (options.truth.empty() && (has_mask || options.truth_scale)) {
    throw usage_error("--mask, --mask-nonocc, --mask-disc and --truth-scale say how to use --truth, which is missing");
  }
  check_outputs(options);
  job.request.left = read_stereo_image(options.left);
  job.request.right = read_stereo_image(options.right);
  check_request(*job.design, job.request);
  job.truth = read_ground_truth(options, job.request.left);
  return job;
}

void write_outputs(const job_options& options, const frame_job& job, const disparity_map& map,
                   const nlohmann::ordered_json& figures) {
  if (!options.output.empty()) write_whole_file(options.output, encode_map(map, options.output));
  if (!options.picture.empty()) write_whole_file(options.picture, picture_of(map, job.request.levels));
  if (!options.json.empty()) {
    // Paths need not be UTF-8, JSON strings must be.
    write_whole_file(options.json, figures.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
}

nlohmann::ordered_json description_json(const job_options& options, const frame_job& job) {
  nlohmann::ordered_json json;
  json["epiline"] = EPILINE_VERSION;
  json["design"] = job.design->name;
  json["left"] = options.left;
  json["right"] = options.right;
  json["width"] = job.request.left.width;
  json["height"] = job.request.left.height;
  json["levels"] = job.request.levels;
  json["parameters"] = job.request.parameters;
  return json;
}

nlohmann::ordered_json timing_json(const frame_job& job, const match_result& result) {
  nlohmann::ordered_json json;
  json["seconds"] = result.seconds;
  if (result.build_seconds) json["build_seconds"] = *result.build_seconds;
  if (result.cycles) {
    json["cycles"] = *result.cycles;
    json["cycles_per_pixel"] = static_cast<double>(*result.cycles) / job.request.left.width / job.request.left.height;
    if (result.seconds > 0) json["cycles_per_second"] = static_cast<double>(*result.cycles) / result.seconds;
  }
  return json;
}

std::string figures_text(const map_figures& figures) {
  std::string text =
      fmt::format("coverage {:.2f} % ({} of {} pixels)\n", figures.coverage(), figures.defined, figures.pixels);
  const auto add = [&](std::string_view set, const accuracy_counts& counts) {
    text += fmt::format(
        "{}: accuracy {:.2f} % ({} of {} defined), coverage {:.2f} %; bad-0.5/1/2 {:.2f}/{:.2f}/{:.2f} %, average "
        "error "
        "{:.3f}, bad-1 with undefined {:.2f} %\n",
        set, counts.accuracy(), counts.correct, counts.defined, counts.coverage(), counts.bad_half_share(),
        counts.bad_one_share(), counts.bad_two_share(), counts.average_error(), counts.bad_one_undefined_share());
  };
  if (figures.all) add("known truth", *figures.all);
  if (figures.non_occluded) add("non-occluded", *figures.non_occluded);
  if (figures.near_discontinuity) add("near discontinuities", *figures.near_discontinuity);
  return text;
}

std::string timing_text(const frame_job& job, const match_result& result) {
  std::string text = fmt::format("{:.3f} s", result.seconds);
  if (result.cycles) {
    const double cycles = static_cast<double>(*result.cycles);
    text += fmt::format(", {} clocks ({:.4f} a pixel", *result.cycles,
                        cycles / job.request.left.width / job.request.left.height);
    if (result.seconds > 0) text += fmt::format(", {:.2f} million a second", cycles / result.seconds / 1e6);
    text += ")";
  }
  if (result.build_seconds) text += fmt::format(", model built in {:.1f} s", *result.build_seconds);
  if (!result.note.empty()) text += fmt::format(" ({})", result.note);
  return text;
}

match_result run_engine(const engine_registry::entry& entry, const frame_job& job, run_options options) {
  const bool on_terminal = ::isatty(STDERR_FILENO) != 0;
  int shown = -1;
  if (on_terminal) {
    options.progress = [&](double done) {
      const int percent = static_cast<int>(100 * done);
      if (percent == shown) return;
      shown = percent;
      fmt::print(stderr, "\r{}: {} %", entry.name, percent);
      std::fflush(stderr);
    };
  }
  const auto clear_line = [&] {
    if (shown >= 0) fmt::print(stderr, "\r\033[K");
  };
  try {
    match_result result = entry.make(*job.design)->match(job.request, options);
    clear_line();
    return result;
  } catch (...) {
    clear_line();
    throw;
  }
}

std::string list_designs(const engine_registry& registry) {
  std::string text;
  for (const auto& design : all_designs()) {
    text += fmt::format("{}: {}\n  images up to {}x{}, levels 1 to {} (default {}), {} pixel(s) a beat\n", design.name,
                        design.meaning, design.max_width, design.max_height, design.max_levels, design.default_levels,
                        design.pixels_per_beat);
    text += "  parameters (--set NAME=VALUE):\n";
    for (const auto& parameter : design.parameters) {
      text += fmt::format("    {:<14} {:>2} to {:<4} default {:<4} {}\n", parameter.name, parameter.minimum,
                          parameter.maximum, parameter.default_value, parameter.meaning);
    }
    text += "  engines (--engine NAME):\n";
    for (const auto* entry : registry.engines_of(design.name)) {
      text += fmt::format("    {:<14} {}\n", entry->name, entry->meaning);
    }
  }
  return text;
}

}  // namespace epiline::eval
