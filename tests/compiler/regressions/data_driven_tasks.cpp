// Tasks: functions that run for ever beside one another, with arrays of streams, a stream that leads backwards, a loop
// and a question before a read.
#include <ap_int.h>
#include <hls_stream.h>
#include <hls_task.h>

typedef ap_uint<16> number_t;

namespace work {

static void deal(hls::stream<number_t>& in, hls::stream<number_t> (&to)[2]) {
  static bool which = false;
  to[which].write(in.read());
  which = !which;
}

template <int factor>
static void sum_of_three(hls::stream<number_t>& in, hls::stream<number_t>& out) {
  static ap_uint<8> calls = 0;
  number_t sum = 0;
  for (int i = 0; i < 3; ++i) {
#pragma HLS PIPELINE II = 1
    sum += in.read() * factor;
  }
  ++calls;
  out.write(sum + calls);
}

static void gather(hls::stream<number_t> (&from)[2], hls::stream<number_t>& out) {
  out.write(from[0].read());
  out.write(from[1].read());
}

static void mix(hls::stream<number_t>& in, hls::stream<number_t>& back, hls::stream<number_t>& forth,
                hls::stream<number_t>& out) {
  const number_t value = in.read() + back.read();
  forth.write(value);
  out.write(value);
}

static void halve(hls::stream<number_t>& forth, hls::stream<number_t>& back) {
  static bool is_first = true;
  if (is_first)
    back.write(5);
  else
    back.write(forth.read() >> 1);
  is_first = false;
}

static void invert(hls::stream<number_t>& in, hls::stream<number_t>& out) {
#pragma HLS PIPELINE II = 1
  if (!in.empty()) out.write(~in.read());
}

}  // namespace work

void data_driven_tasks(hls::stream<number_t>& in, hls::stream<number_t>& out) {
  hls_thread_local hls::stream<number_t> parts[2], sums[2];
  hls_thread_local hls::stream<number_t> all("all"), mixed("mixed");
  hls_thread_local hls::stream<number_t, 4> back, forth;
  hls_thread_local hls::task dealing(work::deal, in, parts);
  hls_thread_local hls::task tripling(work::sum_of_three<3>, parts[0], sums[0]);
  hls_thread_local hls::task quintupling(work::sum_of_three<5>, parts[1], sums[1]);
  hls_thread_local hls::task gathering(work::gather, sums, all);
  hls_thread_local hls::task mixing(work::mix, all, back, forth, mixed);
  hls_thread_local hls::task halving(work::halve, forth, back);
  hls_thread_local hls::task inverting(work::invert, mixed, out);
}
