#include "hls_stream.h"

struct pair {
  long long first;
  long long second;
  long long third;
  long long more[10];
};

static void first(hls::stream<int>& in, hls::stream<int>& out, pair& values) {
  values.first = in.read();
  out.write(values.first + 1);
}
static void second(hls::stream<int>& in, hls::stream<int>& out, const pair& values) {
  out.write(in.read() * values.first);
}

void dataflow_large_struct(hls::stream<int>& in, hls::stream<int>& out) {
#pragma HLS DATAFLOW
  hls::stream<int> between;
  pair values;
  first(in, between, values);
  second(between, out, values);  // refused: 'values' is written by the process 'first' and used by the process 'second'
}
