#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "eval/commands.hpp"
#include "eval/frame_job.hpp"
#include "eval/image_files.hpp"
#include "eval/output_file.hpp"
#include "scenes/render.hpp"

namespace epiline::eval {
namespace {

namespace fs = std::filesystem;

struct scene_options {
  std::string name;
  std::string output;
  scenes::scene_parameters with;
  bool list = false;
};

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return;
  throw file_error(fmt::format("cannot write into {}: {}; choose a folder with -o", folder.string(),
                               error ? error.message() : "it is not a folder"));
}

void run(const scene_options& options) {
  if (options.list) {
    for (const auto& scene : scenes::all_scenes()) fmt::print("{:<12} {}\n", scene.name, scene.meaning);
    return;
  }
  if (options.name.empty()) throw usage_error("name a scene (see epiline scene --list)");
  if (options.output.empty()) throw usage_error("name a folder for the pair: -o FOLDER");
  const auto pair = scenes::render(options.name, options.with);
  const fs::path folder = options.output;
  make_folder(folder);
  // Named as the pairs of Middlebury are in this project (docs/data.md).
  const std::pair<const char*, std::string> files[] = {
      {"left.png", png_of(pair.left.image)},
      {"right.png", png_of(pair.right.image)},
      {"disp_left.pfm", pfm_of(pair.left.disparity)},
      {"disp_right.pfm", pfm_of(pair.right.disparity)},
      {"mask_nonocc_left.png", png_of(pair.left.visible)},
      {"mask_nonocc_right.png", png_of(pair.right.visible)},
  };
  for (const auto& [name, bytes] : files) require_writable(folder / name);
  for (const auto& [name, bytes] : files) write_whole_file(folder / name, bytes);
  fmt::print(
      "{} {}x{}, {} levels, in {}: images left.png, right.png; true disparities disp_left.pfm, disp_right.pfm; "
      "pixels that both see mask_nonocc_left.png, mask_nonocc_right.png\n",
      options.name, options.with.width, options.with.height, options.with.levels, folder.string());
}

}  // namespace

void add_scene_command(CLI::App& application) {
  auto* command = application.add_subcommand("scene", "render a synthetic stereo pair with exact truth");
  const auto options = std::make_shared<scene_options>();
  auto& with = options->with;
  command->add_option("name", options->name, "scene (see --list)")->option_text("NAME");
  command->add_option("-o,--output", options->output, "folder of the pair, made if there is none")
      ->option_text("FOLDER");
  command->add_option("--width", with.width, "columns, 1 to 4096 (default 640)")->option_text("N");
  command->add_option("--height", with.height, "rows, 1 to 4096 (default 480)")->option_text("N");
  command->add_option("--levels", with.levels, "disparities are 0 to N - 1; 2 to 256 (default 80)")->option_text("N");
  command->add_option("--seed", with.seed, "of textures, arrangement and noise (default 1)")
      ->option_text("N")
      ->check(CLI::NonNegativeNumber);  // -1 would become a large number
  command->add_option("--noise", with.noise, "deviation in grey levels, 0 to 64 (default 0)")->option_text("SIGMA");
  command->add_option("--gain", with.gain, "of the right image, 0.1 to 10 (default 1)")->option_text("FACTOR");
  command->add_option("--offset", with.offset, "grey levels added to the right image, -255 to 255 (default 0)")
      ->option_text("N");
  command
      ->add_option("--misalignment", with.misalignment,
                   "rows by which the right image lies too low, -16 to 16, may be a fraction (default 0)")
      ->option_text("ROWS");
  command->add_flag("--list", options->list, "list the scenes and stop");
  command->callback([options] { run(*options); });
}

}  // namespace epiline::eval
