#include "ap_int.h"
#include "hls_stream.h"

void same_signal(hls::stream<int>& in, hls::stream<int>& out, int m_axis_out_tdata) {  // refused: m_axis_out_tdata
  out.write(in.read() + m_axis_out_tdata);
}
