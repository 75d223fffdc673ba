// Sorts groups of eight values: every new value is inserted into a register chain, then the chain is read out.
#include "ap_int.h"
#include "hls_stream.h"

typedef ap_int<16> entry_t;
#define GROUP 8

template <int SIZE>
class sorter {
 public:
  void clear() {
    for (int i = 0; i < SIZE; i++) {
#pragma HLS UNROLL
      keys[i] = 32767;
    }
  }
  void insert(entry_t key) {
    for (int i = SIZE - 1; i >= 0; i--) {
#pragma HLS UNROLL
      const bool here = key < keys[i];
      const bool below = i > 0 && key < keys[i > 0 ? i - 1 : 0];
      keys[i] = below ? keys[i > 0 ? i - 1 : 0] : (here ? key : keys[i]);
    }
  }
  entry_t take() {
    const entry_t smallest = keys[0];
    for (int i = 0; i < SIZE - 1; i++) {
#pragma HLS UNROLL
      keys[i] = keys[i + 1];
    }
    keys[SIZE - 1] = 32767;
    return smallest;
  }

 private:
  entry_t keys[SIZE];
};

void insertion_sort(hls::stream<entry_t>& unsorted, hls::stream<entry_t>& sorted) {
  sorter<GROUP> chain;
  chain.clear();
fill:
  for (int i = 0; i < GROUP; i++) {
#pragma HLS PIPELINE II = 1
    chain.insert(unsorted.read());
  }
drain:
  for (int i = 0; i < GROUP; i++) {
#pragma HLS PIPELINE II = 1
    sorted.write(chain.take());
  }
}
