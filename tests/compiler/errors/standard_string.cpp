#include <string>

#include "hls_stream.h"

void standard_string(hls::stream<int>& in, hls::stream<int>& out) {
  std::string text = "abc";              // refused: no definition
  text += static_cast<char>(in.read());  // refused: no definition
  out.write(static_cast<int>(text.size()));
}
