#pragma once
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::window {

/// Delays a value by `Length` iterations through a RAM. A long delay of wide values costs a block RAM instead of
/// Length * width flip-flops; and since the RAM's promise covers the whole length, what is written late in the pipeline
/// may be read early: a delay line also absorbs the pipeline's depth between a value's maker and its user.
///
/// State: the RAM (meaningless until `Length` steps were made) and the pointer, which starts at 0.
template <class Value, int Length>
class delay_line {
 public:
  /// Takes the newest value, returns the one of `Length` steps ago.
  Value step(const Value& newest) {
#pragma HLS INLINE
    const Value then = oldest();
    push(newest);
    return then;
  }

  /// A step in two halves, of which the first may come some iterations earlier.
  const Value& oldest() const { return values_[pointer_]; }
  void push(const Value& newest) {
#pragma HLS INLINE
#pragma HLS DEPENDENCE variable = values_ type = inter distance = Length true
    values_[pointer_] = newest;
    pointer_ = pointer_ == Length - 1 ? pointer_t(0) : pointer_t(pointer_ + 1);
  }

 private:
  using pointer_t = ap_uint<bits_for(Length - 1)>;
  Value values_[Length];
  pointer_t pointer_;
};

}  // namespace epiline::window
