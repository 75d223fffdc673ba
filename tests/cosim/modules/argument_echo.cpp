// For every input token, a token of all arguments side by side and of the input: shows which arguments a call has.
#include <ap_int.h>
#include <hls_stream.h>

struct echo {
  ap_uint<1> one;
  ap_int<5> five;
  ap_uint<31> thirty_one;
  int whole;
  ap_uint<33> thirty_three;
  ap_int<64> two_words;
  ap_int<65> sixty_five;
  ap_uint<8> token;
};

void argument_echo(hls::stream<ap_uint<8>>& tokens, hls::stream<echo>& echoes, ap_uint<1> one, ap_int<5> five,
                   ap_uint<31> thirty_one, int whole, ap_uint<33> thirty_three, ap_int<64> two_words,
                   ap_int<65> sixty_five) {
  echoes.write({one, five, thirty_one, whole, thirty_three, two_words, sixty_five, tokens.read()});
}
