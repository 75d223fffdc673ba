#include "hls_task.h"

static void one(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 1); }
static void two(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read() + 2); }

void task_of_a_choice(hls::stream<int>& in, hls::stream<int>& out, bool which) {
  hls_thread_local hls::task adding(which ? one : two, in, out);  // refused: known only at run time: name the function
}
