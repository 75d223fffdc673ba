#include "ap_int.h"
#include "hls_stream.h"

// Macros of short names, as they are usual for sizes: the message must speak of the parameter, not of the flow's
// headers.
#define N 64
#define T int
#define P 3

void macro_of_one_letter(hls::stream<T>& in, const T* (&table)[N],  // refused: 'table' is an array
                         hls::stream<T>& out) {
  out.write(in.read() + *table[P]);
}
