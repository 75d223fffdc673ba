#pragma once
// hls::stream: the FIFO between processes, with the vendors' names and meaning.
//
//   hls::stream<T> s("name");        natively unbounded; tokens are counted
//   hls::stream<T, DEPTH> s("name"); holds at most DEPTH tokens
//
// Functions take `hls::stream<T>&` and accept both. A stream has one reader and one writer and cannot be copied. A
// native run is one thread: when a read finds no token, or a write no room, nobody is left who could ever provide it,
// so these throw hls::stream_error, which names the stream, its fill and both counts. Tokens that nobody read are
// reported: by a stream's destructor on stderr, and by hls::leftover_streams(). Native streams belong to one thread.

#ifdef __SYNTHESIS__
#include "detail/stream_synthesis.h"
#else
#include "detail/stream_native.h"
#endif
