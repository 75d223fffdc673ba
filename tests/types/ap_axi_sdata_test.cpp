#include <ap_axi_sdata.h>
#include <gtest/gtest.h>
#include <hls_stream.h>

#include <type_traits>

namespace {

struct rgb {
  ap_uint<8> red, green, blue;
};

// A field exists exactly if its width is not zero.
template <class T, class = void>
constexpr int user_width = 0;
template <class T>
constexpr int user_width<T, std::void_t<decltype(T::user)>> = decltype(T::user)::width;
template <class T, class = void>
constexpr int id_width = 0;
template <class T>
constexpr int id_width<T, std::void_t<decltype(T::id)>> = decltype(T::id)::width;
template <class T, class = void>
constexpr int dest_width = 0;
template <class T>
constexpr int dest_width<T, std::void_t<decltype(T::dest)>> = decltype(T::dest)::width;

template <class T, int keep, int user, int id, int dest>
constexpr bool has =
    decltype(T::keep)::width == keep && decltype(T::strb)::width == keep && decltype(T::last)::width == 1 &&
    user_width<T> == user && id_width<T> == id && dest_width<T> == dest;

static_assert(has<ap_axiu<24, 1, 2, 3>, 3, 1, 2, 3>);
static_assert(has<ap_axiu<24, 1, 1, 1>, 3, 1, 1, 1>);
static_assert(has<ap_axiu<12>, 2, 0, 0, 0>);
static_assert(has<ap_axis<32, 0, 5, 0>, 4, 0, 5, 0>);
static_assert(has<hls::axis<rgb, 2>, 3, 2, 0, 0>);
static_assert(has<hls::axis<int, 0, 0, 4>, 4, 0, 0, 4>);
static_assert(std::is_same_v<decltype(ap_axiu<24>::data), ap_uint<24>>);
static_assert(std::is_same_v<decltype(ap_axis<24>::data), ap_int<24>>);
static_assert(std::is_same_v<decltype(hls::axis<rgb>::data), rgb>);
// Absent fields cost nothing.
static_assert(sizeof(ap_axiu<8>) == 4 && sizeof(ap_axiu<8, 1>) == 5 && sizeof(ap_axiu<8, 1, 1, 1>) == 7);
static_assert(std::is_trivially_copyable_v<ap_axiu<24, 1, 1, 1>> &&
              std::is_trivially_default_constructible_v<ap_axiu<24, 1, 1, 1>>);

TEST(ap_axi_sdata, holds_a_video_beat) {
  hls::stream<ap_axiu<24, 1, 1, 1>> video("video");
  ap_axiu<24, 1, 1, 1> beat;
  beat.data = 0x123456;
  beat.keep = -1;
  beat.strb = 5;
  beat.user = 1;
  beat.last = false;
  beat.id = 0;
  beat.dest = 1;
  video << beat;
  const auto received = video.read();
  EXPECT_EQ(received.data(15, 8), 0x34);
  EXPECT_EQ(received.keep, 7);
  EXPECT_EQ(received.strb, 5);
  EXPECT_TRUE(received.user);
  EXPECT_FALSE(received.last);
  EXPECT_EQ(received.id, 0);
  EXPECT_EQ(received.dest, 1);
}

TEST(ap_axi_sdata, has_accessors) {
  ap_axis<20, 2, 3, 4> beat{};
  beat.set_data(-5);
  beat.keep_all();
  beat.strb_all();
  beat.set_user(2);
  beat.set_last(1);
  beat.set_id(5);
  beat.set_dest(9);
  EXPECT_EQ(beat.get_data(), -5);
  EXPECT_EQ(beat.get_keep(), 7);
  EXPECT_EQ(beat.get_strb(), 7);
  EXPECT_EQ(beat.get_user(), 2);
  EXPECT_EQ(beat.get_last(), 1);
  EXPECT_EQ(beat.get_id(), 5);
  EXPECT_EQ(beat.get_dest(), 9);
  beat.set_keep(3);
  beat.set_strb(1);
  EXPECT_EQ(beat.keep, 3);
  EXPECT_EQ(beat.strb, 1);
}

TEST(ap_axi_sdata, carries_any_type) {
  hls::axis<rgb, 1> beat{};
  beat.data = {1, 2, 3};
  beat.data.green = 200;
  EXPECT_EQ(beat.data.green, 200);
  EXPECT_EQ(beat.data.blue, 3);
}

}  // namespace
