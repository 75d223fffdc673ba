#pragma once
// hls::stream: the FIFO between processes, with the vendors' names and meaning.
//
//   hls::stream<T> s("name");        tokens are counted
//   hls::stream<T, DEPTH> s("name"); the FIFO made of it has DEPTH places
//
// Functions take `hls::stream<T>&` and accept both. A stream has one reader and one writer and cannot be copied. A
// native run is one thread, where a function returns before the next one reads what it wrote: so natively a stream
// holds as many tokens as are written, as with the vendors' headers; DEPTH is what full() and write_nb() go by, and
// peak() says what was needed. A read that finds no token can never be served: it throws hls::stream_error, which names
// the stream, its fill and both counts. Tokens that nobody read are reported: by a stream's destructor on stderr, and
// by hls::leftover_streams(). Native streams belong to one thread.

#ifdef __SYNTHESIS__
#include "detail/stream_synthesis.h"
#else
#include "detail/stream_native.h"
#endif
