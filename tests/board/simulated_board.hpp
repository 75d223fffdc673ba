#pragma once
// A board in simulation for one test: starts epiline_board_simulator, waits for its port, ends it, and reads what
// happened.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "eval/scratch_folder.hpp"

namespace epiline::test {

class simulated_board {
 public:
  explicit simulated_board(std::vector<std::string> arguments, const char* program = EPILINE_BOARD_SIMULATOR) {
    arguments.insert(arguments.begin(), {program, "--link", port(), "--statistics", folder_ / "statistics.json"});
    process_ = fork();
    if (process_ == 0) {
      std::vector<char*> texts;
      for (auto& text : arguments) texts.push_back(text.data());
      texts.push_back(nullptr);
      if (std::freopen("/dev/null", "w", stdout) != nullptr) execv(program, texts.data());
      _exit(127);
    }
    for (int i = 0; i < 600 && !std::filesystem::exists(port()); ++i) {
      if (waitpid(process_, nullptr, WNOHANG) != 0) {
        process_ = -1;
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    if (!std::filesystem::exists(port())) throw std::runtime_error("the simulated board does not start");
  }
  simulated_board(const simulated_board&) = delete;
  simulated_board& operator=(const simulated_board&) = delete;
  ~simulated_board() { end(); }

  [[nodiscard]] std::string port() const { return folder_ / "port"; }

  /// Ends it and returns its statistics.
  nlohmann::json end() {
    if (process_ > 0) {
      kill(process_, SIGTERM);
      waitpid(process_, nullptr, 0);
      process_ = -1;
    }
    std::ifstream file(folder_ / "statistics.json");
    return file ? nlohmann::json::parse(file) : nlohmann::json();
  }

 private:
  scratch_folder folder_;
  pid_t process_ = -1;
};

}  // namespace epiline::test
