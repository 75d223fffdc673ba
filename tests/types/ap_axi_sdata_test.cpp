#include <ap_axi_sdata.h>
#include <ap_fixed.h>
#include <gtest/gtest.h>
#include <hls_stream.h>

#include <cstring>
#include <new>
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
static_assert(std::is_trivially_copyable_v<ap_axiu<24, 1, 1, 1>>);
// Of fixed point, too, it is the bits that count.
static_assert(has<hls::axis<ap_fixed<19, 4>>, 3, 0, 0, 0>);

// What AXIS_ENABLE_... asks for.
template <class T, class = void>
constexpr bool has_data = false;
template <class T>
constexpr bool has_data<T, std::void_t<decltype(T::data)>> = true;
template <class T, class = void>
constexpr bool has_keep = false;
template <class T>
constexpr bool has_keep<T, std::void_t<decltype(T::keep)>> = true;
template <class T, class = void>
constexpr bool has_strb = false;
template <class T>
constexpr bool has_strb<T, std::void_t<decltype(T::strb)>> = true;
template <class T, class = void>
constexpr bool has_last = false;
template <class T>
constexpr bool has_last<T, std::void_t<decltype(T::last)>> = true;

template <class T, bool data, bool keep, bool strb, bool last>
constexpr bool has_only = has_data<T> == data && has_keep<T> == keep && has_strb<T> == strb && has_last<T> == last;

static_assert(has_only<hls::axis_data<int, AXIS_ENABLE_LAST>, true, false, false, true>);
static_assert(has_only<hls::axis_data<int, AXIS_ENABLE_KEEP | AXIS_ENABLE_LAST>, true, true, false, true>);
static_assert(has_only<ap_axiu<24, 1, 0, 0, AXIS_ENABLE_KEEP | AXIS_ENABLE_STRB, true>, true, true, true, false>);
static_assert(has_only<ap_axis<32, 0, 0, 0, AXIS_ENABLE_DATA | AXIS_ENABLE_LAST>, true, false, false, true>);
static_assert(has_only<qdma_axis<64, 0, 0, 0>, true, true, false, true>);
static_assert(has_only<hls::axis_user<13, AXIS_ENABLE_USER | AXIS_ENABLE_LAST>, false, false, false, true>);
static_assert(user_width<hls::axis_user<13>> == 13 && sizeof(hls::axis_user<8, 0>) == 1);

TEST(ap_axi_sdata, is_zero_where_nothing_is_written) {
  alignas(ap_axiu<24, 2, 3, 4>) unsigned char room[sizeof(ap_axiu<24, 2, 3, 4>)];
  std::memset(room, 0xff, sizeof room);
  const auto& beat = *new (room) ap_axiu<24, 2, 3, 4>;
  EXPECT_EQ(beat.data, 0);
  EXPECT_EQ(beat.keep, 0);
  EXPECT_EQ(beat.strb, 0);
  EXPECT_EQ(beat.user, 0);
  EXPECT_EQ(beat.last, 0);
  EXPECT_EQ(beat.id, 0);
  EXPECT_EQ(beat.dest, 0);
}

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
