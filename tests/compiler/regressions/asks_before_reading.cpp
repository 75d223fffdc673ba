// As network stacks are written: every function asks for tokens before it reads, and does nothing without them.
// Hardware waits instead.
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

typedef ap_axiu<32, 0, 0, 0> word_t;

struct header_t {
  ap_uint<8> kind;
  ap_uint<8> session;
};

static void parse(hls::stream<word_t>& in, hls::stream<header_t>& headers, hls::stream<word_t>& payload) {
#pragma HLS PIPELINE II = 1
  static bool is_first = true;
  if (in.empty()) return;
  const word_t word = in.read();
  if (is_first) {
    header_t header;
    header.kind = word.data(7, 0);
    header.session = word.data(15, 8);
    headers.write(header);
  }
  payload.write(word);
  is_first = word.last;
}

static void forward(hls::stream<header_t>& headers, hls::stream<word_t>& payload, hls::stream<word_t>& out,
                    hls::stream<ap_uint<16>>& dropped) {
#pragma HLS PIPELINE II = 1
  enum state_t { IDLE, FORWARD, DROP };
  static state_t state = IDLE;
  static ap_uint<16> drops = 0;
  static ap_uint<16> lengths[32] = {0};
  static ap_uint<5> session = 0;
  word_t word;
  switch (state) {
    case IDLE:
      if (!headers.empty() && !payload.empty()) {
        const header_t header = headers.read();
        payload.read(word);
        session = header.session;
        if (header.kind[0]) {
          lengths[session]++;
          word.data(31, 16) = lengths[session];
          out.write(word);
          if (!word.last) state = FORWARD;
        } else {
          drops++;
          dropped.write(drops);
          if (!word.last) state = DROP;
        }
      }
      break;
    case FORWARD:
      if (payload.read_nb(word)) {
        out.write(word);
        if (word.last) state = IDLE;
      }
      break;
    case DROP:
      if (!payload.empty() && !out.full()) {
        payload.read(word);
        if (word.last) state = IDLE;
      }
      break;
  }
}

void asks_before_reading(hls::stream<word_t>& in, hls::stream<word_t>& out, hls::stream<ap_uint<16>>& dropped) {
#pragma HLS INTERFACE ap_ctrl_none port = return
#pragma HLS DATAFLOW
  static hls::stream<header_t> headers("headers");
  static hls::stream<word_t> payload("payload");
#pragma HLS STREAM variable = headers depth = 4
#pragma HLS STREAM variable = payload depth = 8
  parse(in, headers, payload);
  forward(headers, payload, out, dropped);
}
