// Channels that deal tokens to several tasks and gather their results, and an array of tasks. The streams of a channel
// are members of one object, with arrays among them: a choice from an array took all streams of the object.
#include "ap_int.h"
#include "hls_np_channel.h"

typedef ap_uint<24> number_t;

namespace work {

constexpr int workers = 3;

void begin(hls::stream<number_t>& in, hls::stream<number_t>& out) { out.write(in.read() + 1); }

// Takes longer for some jobs than for others, whose results come in order all the same.
void square_root(hls::stream<number_t>& in, hls::stream<number_t>& out) {
  const number_t x = in.read();
  ap_uint<12> root = 0;
  while (ap_uint<12>(root + 1) * ap_uint<12>(root + 1) <= (x & 0x3ff)) ++root;
  out.write(x * x + root);
}

void end(hls::stream<number_t>& in, hls::stream<number_t>& out) { out.write(in.read() ^ 1); }

}  // namespace work

void channels_in_turn(hls::stream<number_t>& in, hls::stream<number_t>& out) {
  hls_thread_local hls::split::round_robin<number_t, work::workers> jobs;
  hls_thread_local hls::merge::round_robin<number_t, work::workers, 4> results;
  hls_thread_local hls::task beginning(work::begin, in, jobs.in);
  hls_thread_local hls::task working[work::workers];
  for (int i = 0; i < work::workers; ++i) {
#pragma HLS UNROLL
    working[i](work::square_root, jobs.out[i], results.in[i]);
  }
  hls_thread_local hls::task ending(work::end, results.out, out);
}
