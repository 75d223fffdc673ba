#include "../drive.hpp"
namespace regression_kept_until_last {
#include "../regressions/kept_until_last.cpp"
}

EPILINE_DRIVER(kept_until_last) {
  auto& in = s.input<ap_axiu<8, 1, 1, 1>>("in");
  auto& out = s.output<ap_uint<8>>("out");
  for (int packet = 0; packet < 6; ++packet) {
    for (int i = 0; i <= packet; ++i) {
      auto beat = s.any<ap_axiu<8, 1, 1, 1>>();
      beat.last = i == packet;
      in.push(beat);
    }
    regression_kept_until_last::kept_until_last(in.stream, out.stream);
  }
}
