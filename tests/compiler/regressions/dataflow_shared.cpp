// What processes give each other beside streams: scalars by reference and by return value, small structures, arrays.
#include "ap_int.h"
#include "hls_stream.h"

struct frame_size {
  ap_uint<5> rows;
  ap_uint<5> columns;
};

static void header(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<8>>& body, int& count, frame_size& size) {
  count = in.read();  // goes on its way before the body does
  size.rows = in.read();
  size.columns = count + 1;
  for (int i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    body.write(in.read());
  }
}

static int add(hls::stream<ap_uint<8>>& body, hls::stream<ap_uint<8>>& same, const int& count, int table[20]) {
  int sum = 0;
  for (int i = 0; i < 20; ++i) {
#pragma HLS PIPELINE
    table[i] = i * i;
  }
  for (int i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    const ap_uint<8> value = body.read();
    sum += value;
    table[value % 20] = sum;
    same.write(value);
  }
  return sum;
}

static void give(hls::stream<ap_uint<8>>& body, hls::stream<ap_int<32>>& out, int count, int sum, frame_size size,
                 const int table[20]) {
  out.write(sum + size.rows * size.columns);
  for (int i = 0; i < count; ++i) {
#pragma HLS PIPELINE
    out.write(body.read() + sum);
  }
  for (int i = 0; i < 20; ++i) {
#pragma HLS PIPELINE
    out.write(table[19 - i]);
  }
}

void dataflow_shared(hls::stream<ap_uint<8>>& in, hls::stream<ap_int<32>>& out, ap_uint<2> frames) {
#pragma HLS DATAFLOW
  for (int frame = 0; frame < frames; ++frame) {
    hls::stream<ap_uint<8>> body;
    hls::stream<ap_uint<8>, 64> same;
    int count = 0;
    int table[20];
    frame_size size;
    header(in, body, count, size);
    const int sum = add(body, same, count, table);
    give(same, out, count * 2 - count, sum, size, table);
  }
}
