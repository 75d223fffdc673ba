// Processes that are not calls: loops and statements in the function with DATAFLOW, a helper with streams of its own
// that has no DATAFLOW, a loop of calls before a call, and a stream that joins functions where nothing says DATAFLOW.
#include <hls_stream.h>

constexpr int longest = 64;

static void scale(hls::stream<int>& in, hls::stream<int>& out, int count, int gain) {
#pragma HLS INLINE off
  for (int i = 0; i < count; ++i) out.write(in.read() * gain);
}

static void offset(hls::stream<int>& in, hls::stream<int>& out, int count) {
  for (int i = 0; i < count; ++i) out.write(in.read() + i);
}

// In front of a loop that a function stands in, and behind it.
template <int Gain>
static void scale_twice(hls::stream<int>& in, hls::stream<int>& out, int rows, int columns) {
#pragma HLS INLINE
  hls::stream<int> once("once"), twice("twice");
  scale(in, once, rows * columns, Gain);
  for (int row = 0; row < rows; ++row) scale(once, twice, columns, Gain + 1);
  offset(twice, out, rows * columns);
}

void written_out(hls::stream<int>& in, hls::stream<int>& out, hls::stream<int>& weights, hls::stream<int>& sums,
                 int rows, int columns) {
#pragma HLS DATAFLOW
  hls::stream<int> vertical("vertical"), scaled("scaled");
  static int above[longest];
  int calls[2] = {1, 2};
Down:
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
#pragma HLS PIPELINE
      const int pixel = in.read();
      vertical.write(row == 0 ? pixel : pixel + above[column]);
      above[column] = pixel;
    }
  scale_twice<3>(vertical, scaled, rows, columns);
  int sum = 0;
Sum:
  for (int i = 0; i < rows * columns; ++i) {
    const int value = scaled.read();
    sum += value;
    out.write(value + calls[i & 1]);
  }
  // Statements, with what they keep from call to call.
  static int number = 0;
  int weight = weights.read();
  if (weight > 0) {
    for (int i = 0; i < 3; ++i) sum += weight;
    sums.write(sum);
  } else {
    sums.write(-1);
    ++number;
  }
  sums.write(number);
}
