// Runs drivers and writes their token files: drive DIRECTORY [NAME ...]; without names, all of them.
#include <set>

#include "drive.hpp"

int main(int argc, char** argv) {
  using namespace epiline::compiler_test;
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s DIRECTORY [NAME ...]\n", argv[0]);
    return 2;
  }
  const std::set<std::string> wanted(argv + 2, argv + argc);
  bool good = true;
  std::size_t done = 0;
  auto all = drivers();
  std::sort(all.begin(), all.end());
  for (const auto& [name, drive] : all) {
    if (!wanted.empty() && wanted.count(name) == 0) continue;
    session s(name, std::hash<std::string>{}(name));
    drive(s);
    good = s.finish(argv[1]) && good;
    ++done;
  }
  if (!wanted.empty() && done != wanted.size()) {
    std::fprintf(stderr, "%s: %zu of the %zu programs named have a driver\n", argv[0], done, wanted.size());
    good = false;
  }
  return good ? 0 : 1;
}
