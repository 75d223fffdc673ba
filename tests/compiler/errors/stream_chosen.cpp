#include "hls_stream.h"

// A stream behind a pointer that only a run tells.
void stream_chosen(hls::stream<int>& in, hls::stream<int>& left, hls::stream<int>& right) {
  hls::stream<int>* to = &left;
  for (int i = 0; i < 9; ++i) {
    const int value = in.read();
    if (value & 1) to = to == &left ? &right : &left;
    to->write(value);  // refused: chosen at run time
  }
}
