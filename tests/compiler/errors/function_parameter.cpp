#include "ap_int.h"
#include "hls_stream.h"

void function_parameter(hls::stream<int>& in, hls::stream<int>& out, int (*f)(int)) {  // refused: 'f'.*pointer
  out.write(f(in.read()));
}
