#include "ap_int.h"
#include "hls_stream.h"

void overloaded(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }    // refused: overloaded
void overloaded(hls::stream<char>& in, hls::stream<char>& out) { out.write(in.read()); }  // refused: overloaded
