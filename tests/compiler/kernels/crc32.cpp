// CRC-32 (IEEE 802.3) of a byte stream; every packet, ended by `last`, gives one checksum.
// one iteration a token of data
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

typedef ap_axiu<8, 1, 1, 1> byte_t;

void crc32(hls::stream<byte_t>& data, hls::stream<ap_uint<32>>& checksum) {
#pragma HLS INTERFACE axis port = data
#pragma HLS INTERFACE axis port = checksum
#pragma HLS INTERFACE ap_ctrl_none port = return
  ap_uint<32> crc = 0xFFFFFFFF;
  bool last;
  do {
#pragma HLS PIPELINE II = 1
    byte_t beat = data.read();
    crc ^= beat.data;
    for (int bit = 0; bit < 8; bit++) {
#pragma HLS UNROLL
      crc = (crc >> 1) ^ (crc[0] ? ap_uint<32>(0xEDB88320) : ap_uint<32>(0));
    }
    last = beat.last;
  } while (!last);
  checksum.write(~crc);
}
