// Splits length-prefixed records: header (count, kind), then `count` words; even records go to one output, odd ones to
// the other, with a run-time number of records. Loop bounds come from the stream.
#include <stdint.h>

#include "ap_int.h"
#include "hls_stream.h"

void deinterleave(hls::stream<uint32_t>& in, hls::stream<uint32_t>& even, hls::stream<uint32_t>& odd, uint8_t records) {
  for (uint8_t r = 0; r < records; ++r) {
    const uint32_t header = in.read();
    const uint32_t count = header & 0xff;
    const bool is_odd = (header >> 8) & 1;
    for (uint32_t i = 0; i < count; ++i) {
#pragma HLS PIPELINE II = 1
#pragma HLS LOOP_TRIPCOUNT min = 0 max = 255 avg = 16
      const uint32_t word = in.read();
      if (is_odd)
        odd.write(word ^ (i << 24));
      else
        even.write(word + i);
    }
  }
}
