#include <cstdarg>

#include "hls_stream.h"

static int sum_of(int count, ...) {  // refused: variable number of arguments
  va_list rest;
  va_start(rest, count);  // refused: variable number of arguments
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += va_arg(rest, int);
  va_end(rest);
  return sum;
}

void variable_arguments(hls::stream<int>& in, hls::stream<int>& out) {
  const int x = in.read();
  out.write(sum_of(3, x, x + 1, x + 2));  // refused: variable number of arguments
}
