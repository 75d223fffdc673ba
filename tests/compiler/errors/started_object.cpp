#include "hls_stream.h"

int elsewhere();

// Needs code that runs when a program starts; hardware has no such moment.
static int offset = elsewhere();  // refused: offset|elsewhere

void started_object(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() + offset);  // refused: offset
  offset += 1;                    // refused: offset
}
