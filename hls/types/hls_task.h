#pragma once
// hls::task: a function that runs again and again, beside all others, whenever its streams let it.
//
//   void top(hls::stream<int>& in, hls::stream<int>& out) {
//     hls_thread_local hls::stream<int, 4> between;
//     hls_thread_local hls::task first(halve, in, between);
//     hls_thread_local hls::task second(add_one, between, out);
//   }
//
// Functions of tasks take streams by reference (or arrays of streams) and nothing else. Natively the first call of the
// top starts the tasks, in the thread of the caller: they run when somebody reads a stream that is empty, or asks
// whether it is, until none of them can go on. The streams with which the top was called first are theirs for good.

#include <hls_stream.h>

#ifdef __SYNTHESIS__
#include "detail/task_synthesis.h"
#else
#include "detail/task_native.h"
#endif
