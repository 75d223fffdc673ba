#include <ap_axi_sdata.h>

#include "../drive.hpp"
namespace regression_arrays_of_beats {
#include "../regressions/arrays_of_beats.cpp"
}  // namespace regression_arrays_of_beats
using namespace regression_arrays_of_beats;

EPILINE_DRIVER(arrays_of_beats) {
  auto& in_port = s.input<beat_t>("in");
  auto& out_port = s.output<beat_t>("out");
  auto& reversed_port = s.output<beat_t>("reversed");
  for (const int factor : {1, -3, 100}) {
    beat_t in[beats], out[beats], reversed[4];
    for (beat_t& beat : in) in_port.push(beat = s.any<beat_t>());
    while (!in_port.stream.empty()) in_port.stream.read();  // they are in the array
    s.call({{"factor", ap_int<8>(factor)}});
    arrays_of_beats(in, out, reversed, factor);
    for (int i = 0; i < beats; ++i) {
      const beat_t& beat = out[i];
      s.expect(beat.data == ap_int<32>(in[i].data * factor) && beat.last == (i == beats - 1) && beat.id == in[i].id,
               "out");
      out_port.stream.write(beat);
    }
    for (int i = 0; i < 4; ++i) {
      s.expect(reversed[i].dest == in[3 - i].dest && reversed[i].keep == in[3 - i].keep, "reversed");
      reversed_port.stream.write(reversed[i]);
    }
    out_port.drain();
    reversed_port.drain();
  }
}
