#include "ap_int.h"
#include "hls_stream.h"

void without_parameters() {}  // refused: parameter|stream
