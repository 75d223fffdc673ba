// The stream driver against a correct module and against modules with one fault each: a checker that never complains is
// no checker.

#include "cosim/stream_driver.hpp"

#include <gmock/gmock.h>

#include <random>

#include "faulty_adder_model.hpp"

namespace epiline::cosim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t no_fault = 0;

struct scenario {
  drive_request request;
  token_list sums{101};
};

/// `calls` calls of `count` tokens each with a fault.
scenario make_scenario(std::uint64_t fault, std::size_t calls, std::size_t count) {
  scenario made;
  std::mt19937 generator(7);
  const auto random = [&generator] { return static_cast<std::uint32_t>(generator()); };
  token_list call(20);
  token_list left(9);
  token_list right(100);
  for (std::size_t number = 0; number < calls; ++number) {
    call.push_integer(count | fault << 16);
    for (std::size_t token = 0; token < count; ++token) {
      const std::uint64_t addend = random() & 0xff;
      const bool last = token + 1 == count;
      left.push_integer(addend | std::uint64_t{last} << 8);
      std::array<std::uint32_t, 4> wide{random() & 0x7fffffffu, random(), random(), random() & 0x7};
      right.push_back(wide);
      // The lowest word has room for the carry, so that no other word takes part in the sum.
      wide[0] += static_cast<std::uint32_t>(addend);
      wide[3] |= std::uint32_t{last} << 4;
      made.sums.push_back(wide);
    }
  }
  made.request.inputs = {{"call", call}, {"left", left}, {"right", right}};
  made.request.expected = {{"out", calls * count}};
  return made;
}

drive_options stalled(std::uint64_t seed, int left, int right, int out, unsigned burst = 1) {
  drive_options options;
  options.seed = seed;
  options.stalls = {{"left", {left, burst}}, {"right", {right, burst}}, {"out", {out, burst}}};
  options.patience = 2000;
  options.quiet_clocks = 50;
  return options;
}

/// Runs 30 tokens with the fault and returns the error's reason; its text goes to `message`.
drive_error::reason reason_of(std::uint64_t fault, const drive_options& options, std::string& message) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  try {
    static_cast<void>(drive(*model, make_scenario(fault, 1, 30).request, options));
  } catch (const drive_error& error) {
    message = error.what();
    return error.why();
  }
  ADD_FAILURE() << "fault " << fault << " was not noticed";
  return drive_error::reason::bad_request;
}

TEST(rtl_model, lists_the_ports_of_the_report) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  EXPECT_EQ(model->name(), "faulty");
  ASSERT_EQ(model->ports().size(), 4u);
  EXPECT_EQ(model->ports()[0].kind, port_kind::call);
  EXPECT_EQ(model->ports()[3].kind, port_kind::stream);
  EXPECT_FALSE(model->ports()[3].input);
  EXPECT_EQ(model->ports()[3].width, 101u);
  ASSERT_NE(model->ports()[3].find("tlast"), nullptr);
  EXPECT_EQ(model->ports()[3].find("tlast")->offset, 100u);
  EXPECT_EQ(model->ports()[3].find("tkeep"), nullptr);
}

TEST(stream_driver, passes_every_token_in_order_under_every_mix_of_stalls) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  const scenario wanted = make_scenario(no_fault, 3, 40);
  std::uint64_t seed = 1;
  for (const int left : {0, 25, 50, 90}) {
    for (const int right : {0, 25, 50, 90}) {
      for (const int out : {0, 25, 50, 90}) {
        drive_options options = stalled(seed, left, right, out, seed % 2 == 0 ? 1 : 9);
        options.probe_outputs = true;
        options.ready_after_valid = seed % 3 == 0;
        ++seed;
        const drive_result result = drive(*model, wanted.request, options);
        ASSERT_EQ(result.outputs.at("out").tokens, wanted.sums) << "seed " << seed;
      }
    }
  }
}

TEST(stream_driver, counts_the_clocks_of_a_run_without_stalls) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  const drive_result result = drive(*model, make_scenario(no_fault, 1, 100).request, {});
  const port_record& out = result.outputs.at("out");
  // The call in clock 0, the inputs from clock 1 on, the sums one clock later, one a clock.
  EXPECT_EQ(result.inputs.at("call").clocks, std::vector<std::uint64_t>{0});
  EXPECT_EQ(result.inputs.at("left").clocks.front(), 1u);
  EXPECT_EQ(out.clocks.front(), 2u);
  EXPECT_EQ(out.clocks.back(), 101u);
  EXPECT_EQ(result.busy_clocks(), 102u);
}

TEST(stream_driver, pauses_about_as_often_as_asked) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  for (const unsigned burst : {1u, 8u}) {
    const drive_result result = drive(*model, make_scenario(no_fault, 1, 4000).request, stalled(3, 0, 75, 0, burst));
    EXPECT_NEAR(static_cast<double>(result.busy_clocks()), 16000, 1600) << "burst " << burst;
  }
}

TEST(stream_driver, same_seed_same_clocks_and_another_seed_others) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  const drive_request request = make_scenario(no_fault, 1, 100).request;
  const auto clocks_of = [&](std::uint64_t seed) {
    return drive(*model, request, stalled(seed, 50, 50, 50)).outputs.at("out").clocks;
  };
  EXPECT_EQ(clocks_of(5), clocks_of(5));
  EXPECT_NE(clocks_of(5), clocks_of(6));
}

TEST(stream_driver, offers_a_token_only_when_the_request_lets_it) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  scenario wanted = make_scenario(no_fault, 1, 30);
  wanted.request.may_offer = [](const std::string& port, std::size_t index, const drive_result& so_far) {
    return port != "left" || so_far.outputs.at("out").tokens.size() >= index;
  };
  const drive_result result = drive(*model, wanted.request, stalled(4, 0, 50, 25));
  EXPECT_EQ(result.outputs.at("out").tokens, wanted.sums);
  for (std::size_t index = 1; index < 30; ++index) {
    EXPECT_GT(result.inputs.at("left").clocks[index], result.outputs.at("out").clocks[index - 1]) << "token " << index;
  }
}

TEST(stream_driver, a_token_that_is_never_let_go_is_a_deadlock) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  drive_request request = make_scenario(no_fault, 1, 30).request;
  request.may_offer = [](const std::string& port, std::size_t index, const drive_result&) {
    return port != "left" || index < 7;
  };
  try {
    static_cast<void>(drive(*model, request, stalled(1, 0, 0, 0)));
    ADD_FAILURE() << "nothing was noticed";
  } catch (const drive_error& error) {
    EXPECT_EQ(error.why(), drive_error::reason::deadlock);
    EXPECT_THAT(error.what(), HasSubstr("input 'left': 7 of 30 tokens accepted"));
  }
}

TEST(stream_driver, reports_progress) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  drive_options options = stalled(1, 90, 90, 0);
  std::vector<double> shares;
  options.progress = [&](double share) { shares.push_back(share); };
  static_cast<void>(drive(*model, make_scenario(no_fault, 1, 20000).request, options));
  ASSERT_GE(shares.size(), 2u);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LE(shares.back(), 1.0);
}

TEST(stream_driver, catches_a_withdrawn_tvalid) {
  std::string message;
  EXPECT_EQ(reason_of(1, stalled(11, 0, 0, 50), message), drive_error::reason::rule_violation);
  EXPECT_THAT(message, AllOf(HasSubstr("clock "), HasSubstr("port 'out' withdrew tvalid"), HasSubstr("seed 11")));
}

TEST(stream_driver, catches_a_payload_that_changes_while_it_waits) {
  std::string message;
  EXPECT_EQ(reason_of(2, stalled(12, 0, 0, 50), message), drive_error::reason::rule_violation);
  EXPECT_THAT(message, AllOf(HasSubstr("port 'out' changed its payload"), HasSubstr("seed 12")));
}

TEST(stream_driver, catches_a_lost_token) {
  std::string message;
  EXPECT_EQ(reason_of(3, stalled(13, 25, 0, 0), message), drive_error::reason::deadlock);
  EXPECT_THAT(message, AllOf(HasSubstr("output 'out': 29 of 30"), HasSubstr("input 'left': 30 of 30"),
                             HasSubstr("input 'right': 30 of 30"), HasSubstr("seed 13")));
}

TEST(stream_driver, catches_a_token_sent_twice) {
  std::string message;
  EXPECT_EQ(reason_of(4, stalled(14, 25, 0, 0), message), drive_error::reason::surplus_tokens);
  EXPECT_THAT(message, AllOf(HasSubstr("port 'out' sent more than the 30 tokens"), HasSubstr("seed 14")));
}

TEST(stream_driver, catches_a_deadlock_and_names_every_port) {
  std::string message;
  EXPECT_EQ(reason_of(5, stalled(15, 0, 0, 0), message), drive_error::reason::deadlock);
  EXPECT_THAT(
      message,
      AllOf(HasSubstr("no token moved for 2000 clocks"),
            HasSubstr("input 'left': 5 of 30 tokens accepted, tvalid=1 tready=0"), HasSubstr("input 'right': 5 of 30"),
            HasSubstr("output 'out': 5 of 30 tokens sent, tvalid=0 tready=1"), HasSubstr("input 'call': 1 of 1")));
}

TEST(stream_driver, catches_a_tvalid_that_waits_for_tready) {
  drive_options options = stalled(16, 0, 0, 0);
  std::string message;
  options.ready_after_valid = true;
  EXPECT_EQ(reason_of(6, options, message), drive_error::reason::deadlock);
  options.ready_after_valid = false;
  options.probe_outputs = true;
  EXPECT_EQ(reason_of(6, options, message), drive_error::reason::rule_violation);
  EXPECT_THAT(message, HasSubstr("tvalid of port 'out' depends on tready"));
}

TEST(stream_driver, catches_a_payload_that_depends_on_tready) {
  drive_options options = stalled(17, 0, 0, 0);
  options.probe_outputs = true;
  std::string message;
  EXPECT_EQ(reason_of(7, options, message), drive_error::reason::rule_violation);
  EXPECT_THAT(message, HasSubstr("payload of port 'out' depends on tready"));
}

TEST(stream_driver, catches_tokens_left_unread) {
  std::string message;
  EXPECT_EQ(reason_of(8, stalled(18, 0, 0, 0), message), drive_error::reason::unread_tokens);
  EXPECT_THAT(message, AllOf(HasSubstr("left unread"), HasSubstr("input 'left': 29 of 30"),
                             HasSubstr("input 'right': 29 of 30")));
}

TEST(stream_driver, shows_random_payload_while_tvalid_is_low) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  const scenario wanted = make_scenario(9, 1, 30);
  const drive_result result = drive(*model, wanted.request, stalled(19, 50, 0, 0));
  EXPECT_NE(result.outputs.at("out").tokens, wanted.sums);
}

TEST(stream_driver, takes_any_number_of_tokens_from_an_output_without_a_count) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  scenario wanted = make_scenario(4, 1, 30);
  wanted.request.expected.clear();
  EXPECT_EQ(drive(*model, wanted.request, stalled(20, 0, 0, 0)).outputs.at("out").tokens.size(), 31u);
}

TEST(stream_driver, refuses_requests_that_do_not_fit_the_module) {
  const std::unique_ptr<rtl_model> model = make_faulty_adder_model(1);
  const auto refused = [&](const drive_request& request, const drive_options& options) -> std::string {
    try {
      static_cast<void>(drive(*model, request, options));
    } catch (const drive_error& error) {
      EXPECT_EQ(error.why(), drive_error::reason::bad_request);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refused({.inputs = {{"middle", token_list(8)}}, .expected = {}}, {}),
              HasSubstr("no input port 'middle'"));
  EXPECT_THAT(refused({.inputs = {{"left", token_list(8)}}, .expected = {}}, {}),
              HasSubstr("'left' takes tokens of 9 bits, not 8"));
  EXPECT_THAT(refused({.inputs = {}, .expected = {{"left", 1}}}, {}), HasSubstr("no output port 'left'"));
  drive_options options;
  options.stalls = {{"middle", {50, 1}}};
  EXPECT_THAT(refused({}, options), HasSubstr("no port 'middle' to stall"));
  options.stalls = {{"left", {100, 1}}};
  EXPECT_THAT(refused({}, options), HasSubstr("100 % of pauses"));
}

TEST(token_list, fields_cross_word_borders) {
  std::vector<std::uint32_t> token(3);
  set_bits_at(token, 20, 50, 0x2aaaabbbbccccull);
  EXPECT_EQ(bits_at(token, 20, 50), 0x2aaaabbbbccccull);
  EXPECT_EQ(bits_at(token, 0, 20), 0u);
  EXPECT_EQ(bits_at(token, 70, 26), 0u);
  set_bits_at(token, 32, 32, 0xffffffffu);
  set_bits_at(token, 40, 8, 0);
  EXPECT_EQ(token[1], 0xffff00ffu);
  EXPECT_EQ(bits_at(token, 32, 64), 0xffff00ffull | std::uint64_t{token[2]} << 32);
}

}  // namespace
}  // namespace epiline::cosim
