// The `epiline` command: matches stereo pairs with any engine, compares engines, and measures.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "board/commands.hpp"
#include "board/engines.hpp"
#ifdef EPILINE_HAS_COSIM
#include "cosim/engines.hpp"
#endif
#include "csim/engines.hpp"
#include "eval/commands.hpp"
#include "golden/engines.hpp"

namespace {

/// Reports a failure the way every failure of the command is reported: one line on standard error.
int fail(std::string_view message, int exit_code) {
  fmt::print(stderr, "epiline: error: {}\n", message);
  return exit_code;
}

/// CLI11 calls a wrong subcommand a missing one; name it.
void require_known_subcommand(const CLI::App& application, std::string_view name) {
  std::vector<std::string> names;
  for (const auto* command : application.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, name) != names.end()) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  const auto closest = epiline::eval::closest_name(name, known);
  throw CLI::ExtrasError(
      fmt::format("unknown command '{}'{}; commands: {}", name,
                  closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest), fmt::join(known, ", ")),
      CLI::ExitCodes::ExtrasError);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int wrong_usage = 2;
  try {
    epiline::eval::engine_registry registry;
    epiline::golden::register_engines(registry);
    epiline::csim::register_engines(registry);
#ifdef EPILINE_HAS_COSIM
    epiline::cosim::register_engines(registry);
#endif
    epiline::board::register_engines(registry);

    CLI::App application{"Epiline: stereo matching with one C++ source, natively and as hardware", "epiline"};
    application.set_version_flag("--version", EPILINE_VERSION);
    application.require_subcommand(1);
    int exit_code = 0;
    epiline::eval::add_match_command(application, registry);
    epiline::eval::add_compare_command(application, registry, exit_code);
    epiline::eval::add_evaluate_command(application, registry, exit_code);
    epiline::eval::add_scene_command(application);
    epiline::board::add_board_command(application, registry, exit_code);
    try {
      if (argc > 1 && argv[1][0] != '-') require_known_subcommand(application, argv[1]);
      application.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return application.exit(error);  // --help, --version
      return fail(fmt::format("{} (see epiline --help)", error.what()), wrong_usage);
    }
    return exit_code;
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}
