#include "report/forked_tasks.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <set>
#include <stdexcept>
#include <thread>

namespace epiline::report {
namespace {

using testing::HasSubstr;
using tasks = std::vector<std::function<std::string()>>;

const auto ignore = [](std::size_t) {};

TEST(run_forked, returns_the_results_in_order_whatever_order_they_end_in) {
  tasks work;
  for (int i = 0; i < 7; ++i) {
    work.emplace_back([i] {
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * (7 - i)));
      return std::to_string(i);
    });
  }
  for (const int jobs : {1, 2, 16}) {
    const auto results = run_forked(work, jobs, ignore);
    ASSERT_EQ(results.size(), work.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
      EXPECT_TRUE(results[i].succeeded);
      EXPECT_EQ(results[i].value, std::to_string(i));
    }
  }
}

TEST(run_forked, brings_back_megabytes_with_zeros_in_them) {
  std::string large(5'000'000, '\0');
  for (std::size_t i = 0; i < large.size(); i += 7) large[i] = static_cast<char>(i);
  const auto results = run_forked(tasks(3, [&large] { return large; }), 2, ignore);
  for (const auto& result : results) EXPECT_TRUE(result.succeeded && result.value == large);
}

TEST(run_forked, keeps_static_state_apart) {
  static int calls = 0;
  const auto results = run_forked(tasks(4, [] { return std::to_string(++calls); }), 2, ignore);
  for (const auto& result : results) EXPECT_EQ(result.value, "1");
  EXPECT_EQ(calls, 0);
}

TEST(run_forked, reports_what_a_task_throws_and_goes_on) {
  const auto results = run_forked(
      {[] { return std::string("fine"); }, []() -> std::string { throw std::runtime_error("the model is stuck"); },
       [] { return std::string(); }},
      2, ignore);
  EXPECT_TRUE(results[0].succeeded);
  EXPECT_FALSE(results[1].succeeded);
  EXPECT_EQ(results[1].value, "the model is stuck");
  EXPECT_TRUE(results[2].succeeded);
  EXPECT_EQ(results[2].value, "");
}

TEST(run_forked, survives_a_task_that_is_killed_or_exits) {
  const auto results = run_forked({[]() -> std::string {
                                     ::raise(SIGKILL);
                                     return "never";
                                   },
                                   []() -> std::string { ::_exit(3); }, [] { return std::string("fine"); }},
                                  1, ignore);
  EXPECT_THAT(results[0].value, HasSubstr("signal 9"));
  EXPECT_THAT(results[1].value, HasSubstr("without an answer"));
  EXPECT_FALSE(results[0].succeeded || results[1].succeeded);
  EXPECT_TRUE(results[2].succeeded);
}

TEST(run_forked, runs_tasks_at_the_same_time_and_no_more_than_asked_for) {
  const auto seconds = [](int jobs) {
    const auto nap = [] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      return std::string();
    };
    const auto start = std::chrono::steady_clock::now();
    (void)run_forked(tasks(4, nap), jobs, ignore);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  EXPECT_GE(seconds(1), 0.8);
  EXPECT_GE(seconds(2), 0.4);
  EXPECT_LT(seconds(4), 0.75);
}

TEST(run_forked, tells_of_every_task_once) {
  std::multiset<std::size_t> done;
  (void)run_forked(tasks(5, [] { return std::string("x"); }), 2, [&](std::size_t i) { done.insert(i); });
  EXPECT_THAT(done, testing::ElementsAre(0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace epiline::report
