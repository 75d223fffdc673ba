// epiline-hls: a C++ top function in, Verilog and reports out.

#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include "driver/command_line.hpp"
#include "driver/compile.hpp"
#include "driver/crash_report.hpp"
#include "emit/signals.hpp"
#include "frontend/frontend.hpp"
#include "frontend/reproducer.hpp"
#include "schedule/schedule.hpp"

int main(int argc, char** argv) {
  using namespace epiline;
  driver::watch_for_crashes(argc, argv);
  try {
    int exit_code = 0;
    std::optional<driver::command_line> given = driver::read_command_line(argc, argv, exit_code);
    if (!given) return exit_code;
    given->source.on_preprocessed = [](const std::string& text) {
      driver::keep_for_crash_report(frontend::standalone_source(text));
    };
    if (given->explain.empty())
      driver::compile(*given);
    else
      std::cout << emit::explain_signal(given->explain[0], given->explain[1]);
    return 0;
  } catch (const emit::unknown_signal& refusal) {
    std::cerr << "error: " << refusal.what() << '\n';
  } catch (const frontend::refused& refusal) {
    std::cerr << refusal.what() << '\n';
  } catch (const schedule::infeasible& refusal) {
    const std::string text = refusal.what();  // "FILE:LINE: TEXT"
    const std::size_t place = text.find(": ");
    std::cerr << text.substr(0, place) << ": error" << text.substr(place) << '\n';
  } catch (const std::invalid_argument& refusal) {
    const std::string text = refusal.what();  // "FILE:LINE: error: TEXT", or a text about an option
    std::cerr << (text.find(": error: ") == std::string::npos ? "error: " : "") << text << '\n';
  } catch (const check::cannot_check& refusal) {
    std::cerr << refusal.what() << '\n';
  } catch (const driver::usage_error& refusal) {
    std::cerr << "error: " << refusal.what() << '\n';
  } catch (const std::exception& failure) {
    driver::report_crash(failure.what());
  }
  return 1;
}
