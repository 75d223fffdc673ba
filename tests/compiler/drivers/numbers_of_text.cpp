#include "../drive.hpp"
namespace regression_numbers_of_text {
#include "../regressions/numbers_of_text.cpp"
}

EPILINE_DRIVER(numbers_of_text) {
  auto& in = s.input<ap_uint<128>>("in");
  auto& out = s.output<ap_uint<128>>("out");
  for (int i = 0; i < 50; ++i) {
    in.push((ap_uint<64>(s.number(0, 1 << 30)) * 0x123456789abull, ap_uint<64>(s.number(0, 1 << 30)) << 30));
    regression_numbers_of_text::numbers_of_text(in.stream, out.stream);
  }
  s.expect(out.drain().size() == 50, "number of words");
}
