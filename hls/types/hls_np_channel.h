#pragma once
// Channels from one process to several, and from several to one, in turn:
//
//   void top(hls::stream<int>& in, hls::stream<int>& out) {
//     hls_thread_local hls::split::round_robin<int, 4> jobs;
//     hls_thread_local hls::merge::round_robin<int, 4> results;
//     hls_thread_local hls::task reading(read_all, in, jobs.in);
//     hls_thread_local hls::task workers[4];
//     for (int i = 0; i < 4; ++i) {
//   #pragma HLS UNROLL
//       workers[i](work, jobs.out[i], results.in[i]);
//     }
//     hls_thread_local hls::task writing(write_all, results.out, out);
//   }
//
// A channel is a task of its own between FIFOs: a token takes a clock through it, and waits where it is its turn even
// if another way is free.

#include <hls_stream.h>
#include <hls_task.h>

namespace hls {
namespace detail {

template <class T, int N, int Depth, int PortDepth>
void deal_in_turn(stream<T, Depth>& in, stream<T, PortDepth> (&out)[N]) {
  for (int i = 0; i < N; ++i) {
    out[i].write(in.read());
  }
}

template <class T, int N, int Depth, int PortDepth>
void gather_in_turn(stream<T, PortDepth> (&in)[N], stream<T, Depth>& out) {
  for (int i = 0; i < N; ++i) {
    out.write(in[i].read());
  }
}

template <class>
inline constexpr bool is_known = false;

}  // namespace detail

namespace split {

/// Token i of `in` comes out of out[i % N]. Depth and PortDepth: words that the FIFOs at `in` and at each of `out`
/// hold.
template <class T, int N, int Depth = 2, int PortDepth = 2>
class round_robin {
 public:
  stream<T, Depth> in;
  stream<T, PortDepth> out[N];

  round_robin() : dealing_(detail::deal_in_turn<T, N, Depth, PortDepth>, in, out) {}

 private:
  task dealing_;
};

template <class T, int N, int Depth = 2, int PortDepth = 2>
class load_balance {
  static_assert(detail::is_known<T>,
                "hls::split::load_balance: who gets a token would depend on time, so that hardware "
                "and its model could not be compared: use hls::split::round_robin");
};

}  // namespace split

namespace merge {

/// `out` gives a token of in[0], one of in[1], and so on round and round. Depth and PortDepth: words that the FIFOs at
/// `out` and at each of `in` hold.
template <class T, int N, int Depth = 2, int PortDepth = 2>
class round_robin {
 public:
  stream<T, PortDepth> in[N];
  stream<T, Depth> out;

  round_robin() : gathering_(detail::gather_in_turn<T, N, Depth, PortDepth>, in, out) {}

 private:
  task gathering_;
};

template <class T, int N, int Depth = 2, int PortDepth = 2>
class load_balance {
  static_assert(detail::is_known<T>,
                "hls::merge::load_balance: the order of tokens would depend on time, so that "
                "hardware and its model could not be compared: use hls::merge::round_robin");
};

}  // namespace merge
}  // namespace hls
