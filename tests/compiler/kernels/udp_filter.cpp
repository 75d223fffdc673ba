// Ethernet frames on a 64-bit bus: passes the payload of UDP datagrams over IPv4 to one port, realigned to the bus, and
// drops everything else. The header's checksum is verified; counters of what was dropped are scalars by reference.
#include "ap_axi_sdata.h"
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_axiu<64, 0, 0, 0> word_t;

// Byte i of a bus word; the first byte on the wire is in the lowest bits.
static ap_uint<16> big_endian_pair(const ap_uint<64>& w, int first) {
#pragma HLS INLINE
  return (w.range(8 * first + 7, 8 * first), w.range(8 * first + 15, 8 * first + 8));
}

static ap_uint<17> fold(ap_uint<20> sum) { return sum.range(15, 0) + sum.range(19, 16); }

enum parse_state { HEADER, PAYLOAD, FLUSH, DROP };

void udp_filter(hls::stream<word_t>& rx, hls::stream<word_t>& payload, ap_uint<16> port, ap_uint<16> frames,
                ap_uint<16>& accepted, ap_uint<16>& bad_checksum) {
#pragma HLS INTERFACE axis port = rx
#pragma HLS INTERFACE axis port = payload
#pragma HLS INTERFACE s_axilite port = port
#pragma HLS INTERFACE s_axilite port = frames
#pragma HLS INTERFACE s_axilite port = accepted
#pragma HLS INTERFACE s_axilite port = bad_checksum
#pragma HLS INTERFACE s_axilite port = return
  ap_uint<16> good = 0, bad = 0;
  for (ap_uint<16> n = 0; n < frames; n++) {
    parse_state state = HEADER;
    ap_uint<3> index = 0;
    ap_uint<20> sum = 0;
    bool is_udp = true;
    ap_uint<64> rest = 0;  // six bytes that wait for two more
    ap_uint<16> left = 0;  // payload bytes still to come out
    bool done = false;
  words:
    do {
#pragma HLS PIPELINE II = 1
      word_t w;
      w.data = 0;
      w.last = 1;
      if (state != FLUSH) w = rx.read();
      word_t o;
      o.keep = -1;
      o.strb = -1;
      o.last = 0;
      done = w.last;
      switch (state) {
        case HEADER: {
          const ap_uint<16> p0 = big_endian_pair(w.data, 0), p1 = big_endian_pair(w.data, 2);
          const ap_uint<16> p2 = big_endian_pair(w.data, 4), p3 = big_endian_pair(w.data, 6);
          switch (index) {
            case 1:  // ether type, version and length of the header
              is_udp &= p2 == 0x0800 && p3.range(15, 8) == 0x45;
              sum += p3;
              break;
            case 2:
              is_udp &= p3.range(7, 0) == 17;
              sum += p0 + p1 + p2 + p3;
              break;
            case 3:
              sum += p0 + p1 + p2 + p3;
              break;
            case 4: {
              sum += p0;
              is_udp &= p2 == port;
              left = p3 - 8;
              break;
            }
            default:
              break;
          }
          if (index == 5) {
            const bool valid = fold(fold(sum)) == 0xffff;
            if (is_udp && !valid) bad++;
            rest = w.data >> 16;
            if (is_udp && valid && left != 0) {
              good++;
              state = left <= 6 && w.last ? FLUSH : PAYLOAD;
              if (state == FLUSH) done = false;
            } else {
              state = DROP;
            }
          }
          index++;
          break;
        }
        case PAYLOAD:
        case FLUSH:
          o.data = (w.data.range(15, 0), rest.range(47, 0));
          rest = w.data >> 16;
          if (left <= 8) {
            o.keep = (1 << left) - 1;
            o.last = 1;
            if (state == FLUSH) done = true;
            state = DROP;
          } else {
            left -= 8;
            if (w.last) {  // what is left stands in `rest`
              state = FLUSH;
              done = false;
            }
          }
          for (int i = 0; i < 8; i++) {
            if (!o.keep[i]) o.data.range(8 * i + 7, 8 * i) = 0;
          }
          o.strb = o.keep;
          payload.write(o);
          break;
        case DROP:
          break;
      }
    } while (!done);
  }
  accepted = good;
  bad_checksum = bad;
}
