#include "hls_task.h"

static void add(hls::stream<int>& in, hls::stream<int>& out, int number) { out.write(in.read() + number); }

void task_with_a_number(hls::stream<int>& in, hls::stream<int>& out) {
  int number = 3;
  hls_thread_local hls::task adding(add, in, out, number);  // refused: takes more than streams
}
