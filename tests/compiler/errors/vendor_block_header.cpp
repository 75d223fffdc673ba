#include "hls_streamofblocks.h"  // refused: streams of blocks

void vendor_block_header(hls::stream<int>& in, hls::stream<int>& out) { out.write(in.read()); }
