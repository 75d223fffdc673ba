// epiline-hls: a C++ top function in, Verilog and reports out.

#include <iostream>
#include <optional>
#include <string>

#include "driver/command_line.hpp"
#include "driver/compile.hpp"
#include "driver/crash_report.hpp"
#include "driver/messages.hpp"
#include "emit/signals.hpp"
#include "frontend/reproducer.hpp"

int main(int argc, char** argv) {
  using namespace epiline;
  driver::watch_for_crashes(argc, argv);
  return driver::with_messages([&] {
    int exit_code = 0;
    std::optional<driver::command_line> given = driver::read_command_line(argc, argv, exit_code);
    if (!given) return exit_code;
    given->source.on_preprocessed = [](const std::string& text) {
      driver::keep_for_crash_report(frontend::standalone_source(text));
    };
    if (given->explain.empty()) return driver::compile(*given);
    std::cout << emit::explain_signal(given->explain[0], given->explain[1]);
    return 0;
  });
}
