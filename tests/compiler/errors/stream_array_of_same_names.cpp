#include "hls_stream.h"

typedef hls::stream<int> s;
void stream_array_of_same_names(s in[2], s& in_1, s& out) {  // refused: two ports are named 'in_1'
  out.write(in[0].read() + in[1].read() + in_1.read());
}
