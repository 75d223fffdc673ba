// A table read in a recurrence must answer in the same clock: as a block RAM it made the kernel impossible at any
// period.
#include "ap_int.h"
#include "hls_stream.h"

struct crc_table_t {
  unsigned words[256];
  crc_table_t() {
    for (unsigned i = 0; i < 256; ++i) {
      unsigned c = i;
      for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      words[i] = c;
    }
  }
};
static const crc_table_t crc_table;

void table_in_recurrence(hls::stream<ap_uint<8>>& in, hls::stream<ap_uint<32>>& out) {
  static ap_uint<32> crc = 0xffffffff;
  const ap_uint<8> x = in.read();
  crc = crc_table.words[(crc ^ x) & 0xff] ^ (crc >> 8);
  out.write(crc);
}
