#include <ap_int.h>
#include <gtest/gtest.h>
#include <hls_stream.h>

#include <string>
#include <type_traits>

namespace {

// The registry of leftovers is the program's: every test starts and ends with a clean one.
class hls_stream : public testing::Test {
 protected:
  void SetUp() override { hls::forget_leftover_streams(); }
  void TearDown() override { hls::forget_leftover_streams(); }
};

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const hls::stream_error& e) {
    return e.what();
  }
  return "no error";
}

TEST_F(hls_stream, keeps_the_order_of_tokens) {
  hls::stream<int> s("numbers");
  // Interleaved, so that the ring wraps and grows at every phase.
  int written = 0, read = 0;
  for (int round = 1; round < 60; ++round) {
    for (int i = 0; i < round; ++i) s.write(written++);
    for (int i = 0; i < round - 1; ++i) ASSERT_EQ(s.read(), read++);
  }
  EXPECT_EQ(s.size(), static_cast<std::size_t>(written - read));
  while (!s.empty()) ASSERT_EQ(s.read(), read++);
  EXPECT_EQ(read, written);
}

TEST_F(hls_stream, has_the_vendors_spellings) {
  hls::stream<ap_uint<8>, 4> s("bytes");
  ap_uint<8> v;
  s << 1;
  s.write(2);
  s << ap_uint<12>(0x103);
  s >> v;
  EXPECT_EQ(v, 1);
  s.read(v);
  EXPECT_EQ(v, 2);
  EXPECT_EQ(s.read(), 3);
  EXPECT_FALSE(s.read_nb(v));
  EXPECT_EQ(v, 2);
  EXPECT_TRUE(s.write_nb(7));
  EXPECT_TRUE(s.read_nb(v));
  EXPECT_EQ(v, 7);
  EXPECT_TRUE(s.empty());
}

TEST_F(hls_stream, a_testbench_may_answer_a_question_with_a_token) {
  static hls::stream<int>* asked = nullptr;
  hls::stream<int> s("asked"), other("other");
  asked = &s;
  hls::on_empty_question = [](const hls::detail::stream_base& empty) {
    if (&empty == asked) asked->write(5);
  };
  int value = 0;
  EXPECT_TRUE(other.empty());
  EXPECT_FALSE(s.empty());
  EXPECT_EQ(s.read(), 5);
  EXPECT_TRUE(s.read_nb(value));
  EXPECT_EQ(value, 5);
  hls::on_empty_question = nullptr;
  EXPECT_TRUE(s.empty());
}

long long drain(hls::stream<int>& s) {
  long long sum = 0;
  while (!s.empty()) sum += s.read();
  return sum;
}

TEST_F(hls_stream, passes_a_bounded_stream_as_any_stream) {
  hls::stream<int, 3> s("sum");
  s << 1;
  s << 2;
  EXPECT_EQ(drain(s), 3);
}

TEST_F(hls_stream, counts) {
  hls::stream<int, 3> bounded("bounded");
  EXPECT_EQ(bounded.capacity(), 3u);
  EXPECT_TRUE(bounded.empty());
  EXPECT_FALSE(bounded.full());
  bounded << 1;
  bounded << 2;
  bounded << 3;
  EXPECT_TRUE(bounded.full());
  EXPECT_FALSE(bounded.write_nb(4));
  EXPECT_EQ(bounded.size(), 3u);
  EXPECT_EQ(drain(bounded), 6);
  EXPECT_EQ(bounded.tokens_written(), 3u);
  EXPECT_EQ(bounded.tokens_read(), 3u);
  EXPECT_EQ(bounded.peak(), 3u);
  hls::stream<int> unbounded;
  EXPECT_GT(unbounded.capacity(), std::size_t{1} << 40);
  for (int i = 0; i < 100000; ++i) unbounded << i;
  EXPECT_FALSE(unbounded.full());
  EXPECT_EQ(unbounded.size(), 100000u);
  drain(unbounded);
}

TEST_F(hls_stream, refuses_a_read_that_can_never_be_served) {
  hls::stream<int> s("left pixels");
  EXPECT_EQ(message_of([&] { s.read(); }),
            "hls::stream: read of 'left pixels' can never be served: it holds 0 tokens (unbounded, written 0, read 0)");
  s << 1;
  s << 2;
  drain(s);
  int v = 0;
  const std::string again =
      "hls::stream: read of 'left pixels' can never be served: it holds 0 tokens (unbounded, written 2, read 2)";
  EXPECT_EQ(message_of([&] { s.read(v); }), again);
  EXPECT_EQ(message_of([&] { s >> v; }), again);
  hls::stream<int, 5> bounded("window");
  EXPECT_EQ(message_of([&] { bounded.read(); }),
            "hls::stream: read of 'window' can never be served: it holds 0 tokens (depth 5, written 0, read 0)");
}

TEST_F(hls_stream, holds_more_than_its_depth_since_its_reader_runs_after_its_writer) {
  hls::stream<int, 2> s("cost");
  for (int i = 1; i <= 40; ++i) s << i;
  EXPECT_TRUE(s.full());
  EXPECT_EQ(s.size(), 40u);
  EXPECT_EQ(s.peak(), 40u);
  EXPECT_EQ(drain(s), 40 * 41 / 2);
}

TEST_F(hls_stream, reports_living_streams_with_tokens) {
  hls::stream<int> a("a"), b("b"), c("c");
  a << 1;
  c << 1;
  c << 2;
  const auto leftovers = hls::leftover_streams();
  ASSERT_EQ(leftovers.size(), 2u);
  EXPECT_EQ(leftovers[0].name, "a");
  EXPECT_EQ(leftovers[0].tokens, 1u);
  EXPECT_EQ(leftovers[1].name, "c");
  EXPECT_EQ(leftovers[1].tokens, 2u);
  EXPECT_EQ(message_of([] { hls::require_streams_drained(); }),
            "hls::stream: tokens left unread at the end in 'a' (1), 'c' (2)");
  drain(a);
  drain(c);
  EXPECT_TRUE(hls::leftover_streams().empty());
  EXPECT_NO_THROW(hls::require_streams_drained());
}

TEST_F(hls_stream, remembers_the_leftovers_of_the_dead) {
  testing::internal::CaptureStderr();
  {
    hls::stream<int, 8> s("inner");
    s << 5;
    s << 6;
    s.read();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "hls::stream: 'inner' is destroyed with 1 unread tokens (written 2, read 1)\n");
  EXPECT_EQ(message_of([] { hls::require_streams_drained(); }),
            "hls::stream: tokens left unread at the end in 'inner' (1)");
  hls::forget_leftover_streams();
  EXPECT_TRUE(hls::leftover_streams().empty());
}

TEST_F(hls_stream, says_nothing_of_a_drained_stream) {
  testing::internal::CaptureStderr();
  {
    hls::stream<int> s("drained");
    s << 5;
    s.read();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_TRUE(hls::leftover_streams().empty());
}

TEST_F(hls_stream, names_every_stream) {
  hls::stream<int> named("given"), by_string(std::string("text")), anonymous, other;
  EXPECT_EQ(named.name(), "given");
  EXPECT_EQ(by_string.name(), "text");
  EXPECT_NE(anonymous.name(), "");
  EXPECT_NE(anonymous.name(), other.name());
  anonymous.set_name("later");
  EXPECT_EQ(message_of([&] { anonymous.read(); }).find("hls::stream: read of 'later'"), 0u);
}

static_assert(!std::is_copy_constructible_v<hls::stream<int>> && !std::is_copy_assignable_v<hls::stream<int>>);
static_assert(!std::is_move_constructible_v<hls::stream<int, 2>> && !std::is_move_assignable_v<hls::stream<int, 2>>);

TEST_F(hls_stream, carries_bool_and_structures) {
  struct token {
    ap_uint<5> value;
    bool last;
  };
  hls::stream<bool> flags("flags");
  hls::stream<token> tokens("tokens");
  flags << true;
  flags << false;
  EXPECT_TRUE(flags.read());
  EXPECT_FALSE(flags.read());
  tokens << token{3, true};
  const token t = tokens.read();
  EXPECT_EQ(t.value, 3);
  EXPECT_TRUE(t.last);
}

}  // namespace
