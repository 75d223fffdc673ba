// Stream tokens. Compiled to LLVM IR by check_llvm_contract.cmake, which says what must be found in it.
#include <ap_axi_sdata.h>
#include <ap_int.h>
#include <hls_stream.h>

struct rgb {
  ap_uint<5> red, green[2];
  ap_int<9> blue;
  bool valid;
};

using beat = ap_axiu<12, 1, 2, 3>;
using bare = ap_axis<20>;
using any = hls::axis<rgb, 2>;

void tokens(hls::stream<beat>& a, hls::stream<bare, 4>& b, hls::stream<any>& c, hls::stream<ap_int<1>>& d,
            hls::stream<ap_uint<200>>& e) {
  bare to_b{};
  any to_c{};
  beat from_a;
  if (a.read_nb(from_a)) to_b.data = from_a.data;
  b.write_nb(to_b);
  c << to_c;
  d << ap_int<1>(from_a.last);
  e << ap_uint<200>(from_a.data);
}
