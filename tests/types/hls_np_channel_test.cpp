// Channels from one to several and back, natively.
#include <gtest/gtest.h>
#include <hls_np_channel.h>

namespace {

TEST(hls_np_channel, deals_in_turn) {
  hls::split::round_robin<int, 3> channel;
  for (int i = 0; i < 12; ++i) channel.in.write(i);
  for (int lane = 0; lane < 3; ++lane)
    for (int i = lane; i < 12; i += 3) EXPECT_EQ(channel.out[lane].read(), i);
}

TEST(hls_np_channel, gathers_in_turn_however_the_tokens_come) {
  hls::merge::round_robin<int, 3, 8, 4> channel;
  for (int lane = 2; lane >= 0; --lane)
    for (int i = lane; i < 12; i += 3) channel.in[lane].write(i);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(channel.out.read(), i);
}

TEST(hls_np_channel, waits_for_the_one_whose_turn_it_is) {
  hls::merge::round_robin<int, 2> channel;
  channel.in[1].write(5);
  EXPECT_TRUE(channel.out.empty());
  channel.in[0].write(4);
  EXPECT_EQ(channel.out.read(), 4);
  EXPECT_EQ(channel.out.read(), 5);
}

TEST(hls_np_channel, has_places_of_its_own) {
  hls::split::round_robin<int, 2> first, second;  // of one type
  first.in.write(1);
  EXPECT_EQ(first.out[0].read(), 1);
  second.in.write(2);
  EXPECT_EQ(second.out[0].read(), 2);
}

}  // namespace
