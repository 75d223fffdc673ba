#include "hls_np_channel.h"

static void pass_on(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }

void channel_by_load(hls::stream<int>& in, hls::stream<int>& left, hls::stream<int>& right) {
  hls_thread_local hls::split::load_balance<int, 2> jobs;  // refused: use hls::split::round_robin
  hls_thread_local hls::task beginning(pass_on, in, jobs.in);
  hls_thread_local hls::task first(pass_on, jobs.out[0], left);
  hls_thread_local hls::task second(pass_on, jobs.out[1], right);
}
