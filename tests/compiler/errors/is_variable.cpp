#include "ap_int.h"
#include "hls_stream.h"

static int is_variable = 3;  // refused: function
