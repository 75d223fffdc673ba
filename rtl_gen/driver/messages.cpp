#include "driver/messages.hpp"

#include <iostream>
#include <stdexcept>
#include <string>

#include "check/check.hpp"
#include "driver/command_line.hpp"
#include "driver/crash_report.hpp"
#include "emit/signals.hpp"
#include "frontend/source.hpp"
#include "schedule/schedule.hpp"

namespace epiline::driver {

int with_messages(const std::function<int()>& work) {
  try {
    return work();
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
  } catch (const usage_error& refusal) {
    std::cerr << "error: " << refusal.what() << '\n';
  } catch (const std::exception& failure) {
    report_crash(failure.what());
  }
  return 1;
}

}  // namespace epiline::driver
