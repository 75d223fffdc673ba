// `condition ? a : b` on objects chooses between addresses, and a pointer that walks through an array is no such
// choice: the first was refused, the second made the compiler loop for ever.
#include "ap_int.h"
#include "hls_stream.h"

struct sample_t {
  ap_uint<8> tag;
  ap_int<32> value;
  ap_uint<4> parts[3];
};

void choice_of_objects(hls::stream<sample_t>& in, hls::stream<sample_t>& out) {
  static sample_t best = {0, -1000, {0, 0, 0}};
  const sample_t now = in.read();
  const sample_t& larger = now.value > best.value ? now : best;
  sample_t result = larger;
  for (ap_uint<4>& part : result.parts) part += 1;
  best = larger;
  out.write(result);
}
