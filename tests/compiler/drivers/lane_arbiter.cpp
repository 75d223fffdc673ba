#include "../drive.hpp"
namespace kernel_lane_arbiter {
#include "../kernels/lane_arbiter.cpp"
}
using namespace kernel_lane_arbiter;

EPILINE_DRIVER(lane_arbiter) {
  std::vector<decltype(&s.input<beat_t>("in_0"))> lanes;
  for (const char* name : {"in_0", "in_1", "in_2", "in_3"}) lanes.push_back(&s.input<beat_t>(name));
  auto& out = s.output<marked_t>("out");
  for (int call = 0; call < 8; ++call) {
    const int first = static_cast<int>(s.number(0, 15)), packets = call == 3 ? 0 : static_cast<int>(s.number(1, 12));
    std::vector<std::vector<unsigned>> wanted, found;
    hls::stream<beat_t> in[LANES];
    for (int packet = 0; packet < packets; ++packet) {
      const auto lane = static_cast<unsigned>(first + packet) % 4;
      const int length = static_cast<int>(s.number(1, 5));
      for (int i = 1; i <= length; ++i) {
        beat_t beat = s.any<beat_t>();
        beat.last = i == length;
        lanes[lane]->push(beat);
        in[lane].write(lanes[lane]->stream.read());  // a top's array of streams is one object
        wanted.push_back({beat.data.to_uint(), lane, beat.last.to_uint()});
      }
    }
    s.call({{"first", ap_uint<4>(first)}, {"packets", ap_uint<6>(packets)}});
    const ap_uint<16> beats = lane_arbiter(in, out.stream, first, packets);
    s.result("ap_return", beats);
    s.expect(beats.to_uint() == wanted.size(), "number of beats");
    for (const marked_t& beat : out.drain())
      found.push_back({beat.data.to_uint(), beat.user.to_uint(), beat.last.to_uint()});
    s.expect(found == wanted, "beats");
  }
}
