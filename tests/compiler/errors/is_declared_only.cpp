#include "ap_int.h"
#include "hls_stream.h"

void is_declared_only(hls::stream<int>& in, hls::stream<int>& out);  // refused: defin
