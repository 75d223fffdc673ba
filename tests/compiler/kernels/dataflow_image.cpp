// Images as other people's libraries pass them: a struct with the size and the stream of pixels.
#include "ap_int.h"
#include "hls_stream.h"

struct image_t {
  int rows, columns;
  hls::stream<ap_uint<8>> data;
  hls::stream<ap_uint<1>, 4> marks[2];
};

template <int SHIFT>
static void load(hls::stream<ap_uint<8>>& in, image_t& image) {
  for (int i = 0; i < image.rows; i++) {
    for (int j = 0; j < image.columns; j++) {
#pragma HLS PIPELINE
      image.data.write(in.read() >> SHIFT);
    }
    image.marks[0].write(i & 1);
    image.marks[1].write(i == 0);
  }
}

static void store(image_t& image, hls::stream<ap_uint<10>>& out) {
  for (int i = 0; i < image.rows; i++) {
    ap_uint<8> first = 0;
    for (int j = 0; j < image.columns; j++) {
#pragma HLS PIPELINE
      ap_uint<8> p = image.data.read();
      if (j == 0) first = p;
      out.write(p);
    }
    ap_uint<1> odd = image.marks[0].read();
    out.write((image.marks[1].read(), odd, first));
  }
}

void dataflow_image(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<10>>& out, ap_uint<4> rows, ap_uint<5> columns) {
#pragma HLS DATAFLOW
  image_t image;
#pragma HLS STREAM variable = image.data depth = 5
  image.rows = rows;
  image.columns = columns + 1;
  load<1>(in, image);
  store(image, out);
}
