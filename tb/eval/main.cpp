// The `epiline` command: matches stereo pairs with any engine, compares engines, and measures.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

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

    CLI::App application{"Epiline: stereo matching with one C++ source, natively and as hardware", "epiline"};
    application.set_version_flag("--version", EPILINE_VERSION);
    application.require_subcommand(1);
    int exit_code = 0;
    epiline::eval::add_match_command(application, registry);
    epiline::eval::add_compare_command(application, registry, exit_code);
    try {
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
