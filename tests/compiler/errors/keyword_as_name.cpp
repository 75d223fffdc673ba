#include "hls_stream.h"

// A port that would be called `reg`, a keyword of Verilog.
void keyword_as_name(hls::stream<int>& in, hls::stream<int>& out, int reg) {  // refused: reg
  out.write(in.read() + reg);
}
