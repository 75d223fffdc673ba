#include <cstdio>

#include "hls_stream.h"

void read_file(hls::stream<int>& in, hls::stream<int>& out) {
  std::FILE* file = std::fopen("weights.txt", "r");  // refused: fopen
  int w = 0;
  std::fscanf(file, "%d", &w);  // refused: fscanf|fopen
  out.write(in.read() * w);
}
