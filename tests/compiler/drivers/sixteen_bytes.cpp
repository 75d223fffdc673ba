#include "../drive.hpp"
namespace regression_sixteen_bytes {
#include "../regressions/sixteen_bytes.cpp"
}
using namespace regression_sixteen_bytes;
EPILINE_LEAVES(wide_t, v.data[0], v.data[1], v.data[2], v.data[3], v.data[4], v.data[5], v.data[6], v.data[7]);
EPILINE_LEAVES(narrow_t, v.data[0], v.data[1], v.data[2], v.data[3], v.data[4], v.data[5], v.data[6], v.data[7]);

EPILINE_DRIVER(sixteen_bytes) {
  auto& in = s.input<wide_t>("in");
  auto& out = s.output<narrow_t>("out");
  std::vector<int> wanted, found;
  for (int n = 0; n < 60; ++n) {
    wide_t x = s.any<wide_t>();
    for (auto& element : x.data) {
      if (s.chance(50)) element = s.number(-3, 140);
      wanted.push_back(std::clamp(int(element), 0, 127));
    }
    in.push(x);
    sixteen_bytes(in.stream, out.stream);
  }
  for (const narrow_t& y : out.drain()) {
    for (const auto& element : y.data) found.push_back(int(element));
  }
  s.expect_equal(found, wanted, "out");
}
