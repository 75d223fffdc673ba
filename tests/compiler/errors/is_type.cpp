#include "ap_int.h"
#include "hls_stream.h"

struct is_type {  // refused: function
  int x;
};
