// Compares graph and RTL with the recorded native run:
//
//   compiler_check_levels TOKENS RTL [MODELS.so] NAME[@INTERVAL]...
//
// for every NAME, made for INTERVAL clocks an iteration (1 if not given): TOKENS/NAME.tokens against
// RTL/NAME/NAME.graph and, with MODELS.so (written by run_batch.py), the Verilator model of RTL/NAME/NAME.v. Prints
// "NAME: iterations: N" of the graph, and one line a failure, "NAME: graph: ..." or "NAME: RTL: ..."; exit code 1 if
// there was one.

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "dataflow/network_text.hpp"
#include "levels.hpp"

namespace {

using epiline::cosim::rtl_model;
using make_model = rtl_model* (*)(const char* name, std::uint64_t seed);

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

int main(int argc, char** argv) {
  namespace test = epiline::compiler_test;
  if (argc < 4) {
    fmt::print(stderr, "usage: {} TOKENS RTL [MODELS.so] NAME[@INTERVAL]...\n", argv[0]);
    return 2;
  }
  const std::filesystem::path tokens = argv[1];
  const std::filesystem::path rtl = argv[2];
  make_model make = nullptr;
  int first = 3;
  if (std::string_view(argv[3]).ends_with(".so")) {
    void* library = dlopen(std::filesystem::absolute(argv[3]).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) make = reinterpret_cast<make_model>(dlsym(library, "epiline_make_model"));
    if (make == nullptr) {
      fmt::print(stderr, "{}: {}\n", argv[3], dlerror());
      return 2;
    }
    ++first;
  }
  const char* seed_text = std::getenv("EPILINE_SEED");
  const std::uint64_t seed = seed_text == nullptr ? 1 : std::strtoull(seed_text, nullptr, 10);
  bool good = true;
  for (int i = first; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::size_t at = argument.find('@');
    const std::string name(argument.substr(0, at));
    const std::uint64_t interval = at == argument.npos ? 1 : std::strtoull(argv[i] + at + 1, nullptr, 10);
    try {
      const std::vector<test::recorded_port> recorded = test::read_token_file(tokens / (name + ".tokens"));
      const test::graph_verdict graph =
          test::check_graph(epiline::dataflow::parse_network(read_file(rtl / name / (name + ".graph"))), recorded);
      fmt::print("{}: iterations: {}\n", name, graph.iterations);
      if (!graph.difference.empty()) {
        fmt::print("{}: graph: {}\n", name, graph.difference);
        good = false;
      }
      if (make == nullptr) continue;
      const auto make_fresh = [&] {
        std::unique_ptr<rtl_model> model(make(name.c_str(), seed));
        if (!model) throw std::runtime_error("no model of that name");
        return model;
      };
      const std::string difference =
          test::check_rtl(make_fresh, recorded, seed, graph.waits ? 0 : graph.iterations * interval);
      if (!difference.empty()) {
        fmt::print("{}: RTL: {}\n", name, difference);
        good = false;
      }
    } catch (const std::exception& error) {
      fmt::print("{}: {}\n", name, error.what());
      good = false;
    }
    std::fflush(stdout);
  }
  return good ? 0 : 1;
}
