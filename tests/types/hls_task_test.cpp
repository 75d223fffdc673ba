#include <gtest/gtest.h>
#include <hls_task.h>

#include <stdexcept>
#include <string>

namespace {

void split(hls::stream<int>& in, hls::stream<int>& odd, hls::stream<int>& even) {
  const int value = in.read();
  (value % 2 != 0 ? odd : even).write(value);
}
template <int step>
void add(hls::stream<int>& in, hls::stream<int>& out) {
  out.write(in.read() + step);
}
void pairs(hls::stream<int>& in, hls::stream<int>& out) {
  const int first = in.read();
  out.write(first + in.read());
}
void count(hls::stream<int>& out) {
  static int number = 0;
  out.write(number++);
}
void when_there(hls::stream<int>& in, hls::stream<int>& out) {
  if (!in.empty()) out.write(-in.read());
}
void twice_while_there_is_room(hls::stream<int>& in, hls::stream<int>& out) {
  while (true) {
    if (in.empty() || out.full()) continue;
    out.write(in.read() * 2);
  }
}
void deal(hls::stream<int>& in, hls::stream<int> (&to)[2]) {
  to[0].write(in.read());
  to[1].write(in.read());
}
void fail_at_seven(hls::stream<int>& in, hls::stream<int>& out) {
  const int value = in.read();
  if (value == 7) throw std::runtime_error("seven");
  out.write(value);
}

struct streams {
  hls::stream<int> in{"in"}, between{"between"}, out{"out"};
};

TEST(hls_task, runs_when_somebody_reads_what_it_writes) {
  streams s;
  const hls::task second(add<10>, s.between, s.out);
  const hls::task first(add<1>, s.in, s.between);
  for (int i = 0; i < 1000; ++i) s.in.write(i);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(s.out.read(), i + 11);
}

TEST(hls_task, runs_when_somebody_asks_for_tokens) {
  streams s;
  const hls::task only(add<1>, s.in, s.out);
  EXPECT_TRUE(s.out.empty());
  s.in.write(4);
  int value = 0;
  EXPECT_FALSE(s.out.empty());
  EXPECT_TRUE(s.out.read_nb(value));
  EXPECT_EQ(value, 5);
  EXPECT_FALSE(s.out.read_nb(value));
}

TEST(hls_task, keeps_its_place_while_it_waits) {
  streams s;
  const hls::task only(pairs, s.in, s.out);
  s.in.write(3);
  EXPECT_TRUE(s.out.empty());
  s.in.write(4);
  EXPECT_EQ(s.out.read(), 7);
}

TEST(hls_task, chooses_among_streams) {
  streams s;
  hls::stream<int> odd("odd"), even("even"), parts[2];
  const hls::task choice(split, s.in, odd, even);
  for (int i = 0; i < 10; ++i) s.in.write(i);
  for (int i = 0; i < 10; i += 2) EXPECT_EQ(even.read(), i);
  for (int i = 1; i < 10; i += 2) EXPECT_EQ(odd.read(), i);
  const hls::task dealer(deal, s.between, parts);
  s.between.write(1);
  s.between.write(2);
  EXPECT_EQ(parts[1].read(), 2);
  EXPECT_EQ(parts[0].read(), 1);
}

TEST(hls_task, may_read_nothing) {
  streams s;
  const hls::task numbers(count, s.between);
  const hls::task others(add<100>, s.between, s.out);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(s.out.read(), 100 + i);
  while (s.between.size() > 0) s.between.read();
  while (s.out.size() > 0) s.out.read();
}

TEST(hls_task, may_ask_before_it_reads) {
  streams s;
  const hls::task first(when_there, s.in, s.between);
  const hls::task second(when_there, s.between, s.out);
  EXPECT_TRUE(s.out.empty());
  s.in.write(8);
  EXPECT_EQ(s.out.read(), 8);
}

TEST(hls_task, that_finds_a_stream_full_lets_the_others_run) {
  streams s;
  hls::stream<int, 2> narrow("narrow");
  const hls::task first(twice_while_there_is_room, s.in, narrow);
  const hls::task second(add<1>, narrow, s.out);
  for (int i = 0; i < 20; ++i) s.in.write(i);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(s.out.read(), 2 * i + 1);
  EXPECT_LE(narrow.peak(), 2u);
}

TEST(hls_task, that_lacks_a_token_leaves_the_reader_with_the_error) {
  streams s;
  const hls::task only(add<1>, s.in, s.out);
  try {
    s.out.read();
    FAIL() << "nobody writes it";
  } catch (const hls::stream_error& error) {
    EXPECT_NE(std::string(error.what()).find("read of 'out' can never be served"), std::string::npos) << error.what();
  }
}

TEST(hls_task, throws_where_it_was_made_to_run) {
  streams s;
  const hls::task only(fail_at_seven, s.in, s.out);
  for (const int value : {6, 7, 8}) s.in.write(value);
  EXPECT_EQ(s.out.read(), 6);
  EXPECT_THROW(s.out.read(), std::runtime_error);
  EXPECT_EQ(s.out.read(), 8);  // the next call
}

TEST(hls_task, ends_with_its_object) {
  streams s;
  {
    const hls::task only(add<1>, s.in, s.out);
    s.in.write(1);
    EXPECT_EQ(s.out.read(), 2);
  }
  s.in.write(1);
  EXPECT_TRUE(s.out.empty());
  EXPECT_EQ(s.in.read(), 1);
}

TEST(hls_task, may_get_its_function_later_and_keeps_it) {
  streams s;
  hls::task several[2];
  s.in.write(1);
  EXPECT_TRUE(s.out.empty());
  for (int call = 0; call < 2; ++call) {  // as a top does whenever it is called
    several[0](add<1>, s.in, s.between);
    several[1](add<10>, s.between, s.out);
  }
  s.in.write(2);
  EXPECT_EQ(s.out.read(), 12);
  EXPECT_EQ(s.out.read(), 13);
  EXPECT_TRUE(s.out.empty());
}

TEST(hls_task, of_all_runs_until_none_can_go_on) {
  streams s;
  const hls::task second(add<10>, s.between, s.out);
  const hls::task first(add<1>, s.in, s.between);
  for (int i = 0; i < 5; ++i) s.in.write(i);
  hls::run_tasks();
  EXPECT_EQ(s.out.size(), 5u);
  while (s.out.size() > 0) s.out.read();
}

}  // namespace
