// Software for scale.cpp compiled with --axi-lite: the header is made by epiline-hls beside the Verilog.
#include "scale_registers.h"

// Both arguments change between one call and the next, while data flows: no call has the new factor and the old count.
void change_both(volatile uint32_t* registers, uint32_t factor, uint32_t count) {
  scale_begin_update(registers);
  scale_set_factor(registers, factor);
  scale_set_count(registers, count);
  scale_end_update(registers);
}

// Waits until a call has started since `before` was read with scale_calls(): what was set then has been taken.
void wait_until_taken(const volatile uint32_t* registers, uint32_t before) {
  while (scale_calls(registers) == before) {
  }
}
