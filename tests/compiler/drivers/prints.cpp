#include <ap_utils.h>
#include <hls_print.h>

#include "../drive.hpp"
namespace regression_prints {
#include "../regressions/prints.cpp"
}

EPILINE_DRIVER(prints) {
  auto& in = s.input<ap_int<12>>("in");
  auto& out = s.output<ap_int<13>>("out");
  std::vector<int> wanted;
  for (int i = 0; i < 50; ++i) {
    const auto value = i == 7 ? ap_int<12>(-2048) : s.any<ap_int<12>>();
    in.push(value);
    wanted.push_back(-value.to_int());
    regression_prints::prints(in.stream, out.stream);
  }
  s.expect_equal(out.drain(), wanted, "out");
}
