// Arguments behind an AXI4-Lite slave: registers that hold what is written, calls that take them when they start, and
// whole frames whose parameters change. The stream driver checks the handshake of every channel at every clock.

#include <gtest/gtest.h>

#include <random>

#include "argument_echo_axi_model.hpp"
#include "color_fuzzy_small_axi_model.hpp"
#include "color_fuzzy_small_rtl_model.hpp"
#include "count_up_axi_model.hpp"
#include "frame_bench.hpp"
#include "register_master.hpp"

namespace epiline::cosim {
namespace {

using registers = std::map<std::string, mapped_register>;

constexpr unsigned argument_bits = 1 + 5 + 31 + 32 + 33 + 64 + 65;
constexpr std::size_t argument_words = (argument_bits + 31) / 32;
using argument_token = std::array<std::uint32_t, argument_words>;

argument_token random_arguments(std::mt19937& random) {
  argument_token token{};
  for (unsigned low = 0; low < argument_bits; low += 32) {
    const unsigned bits = std::min(32u, argument_bits - low);
    // All ones and all zeros more often than by chance: signs and carries.
    const std::uint32_t kind = static_cast<std::uint32_t>(random() % 4);
    set_bits_at(token, low, bits, kind == 0 ? 0 : kind == 1 ? 0xffffffffu : static_cast<std::uint32_t>(random()));
  }
  return token;
}

/// Pauses on every channel, different from run to run.
drive_options with_stalls(const rtl_model& model, std::uint64_t seed) {
  drive_options options;
  options.seed = seed;
  options.quiet_clocks = 100;
  options.patience = 3000;
  if (seed == 0) return options;  // none
  std::mt19937_64 random(seed);
  for (const model_port& port : model.ports()) {
    constexpr int percents[] = {0, 25, 50, 90};
    options.stalls[port.name] = {percents[random() % 4], seed % 3 == 0 ? 8u : 1u};
  }
  options.probe_outputs = seed % 2 == 0;
  options.ready_after_valid = seed % 5 == 0;
  return options;
}

TEST(axi_lite, registers_hold_what_is_written_byte_by_byte) {
  const registers map = read_register_map(ECHO_REGISTERS);
  ASSERT_EQ(map.at("sixty_five").words, 3u);
  const auto model = make_argument_echo_axi_model(1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed) + 50);
    register_master master;
    std::map<unsigned, std::uint32_t> held;  // by address: the bits that exist
    std::map<unsigned, std::pair<unsigned, bool>> shape;
    for (const auto& [name, where] : map) {
      if (!where.is_argument) continue;
      for (unsigned word = 0; word < where.words; ++word) {
        shape[where.address + 4 * word] = {std::min(32u, where.width - 32 * word), where.is_signed};
      }
    }
    const auto read_back = [&](unsigned address) {
      const auto [bits, is_signed] = shape.at(address);
      const std::uint32_t value = held[address];
      const bool negative = is_signed && (value >> (bits - 1) & 1) != 0;
      return bits == 32 || !negative ? value : value | ~((1u << bits) - 1);
    };
    for (const auto& [address, ignored] : shape) master.read(address, 0);  // after reset
    for (int step = 0; step < 300; ++step) {
      auto target = shape.begin();
      std::advance(target, static_cast<std::ptrdiff_t>(random() % shape.size()));
      const auto [address, form] = *target;
      const unsigned byte_of_word = static_cast<unsigned>(random() % 4);  // not looked at
      if (random() % 2 == 0) {
        const auto data = static_cast<std::uint32_t>(random());
        const auto strobe = static_cast<std::uint32_t>(random() % 16);
        for (unsigned byte = 0; byte < 4; ++byte) {
          if ((strobe >> byte & 1) == 0) continue;
          const std::uint32_t lane = 0xffu << 8 * byte;
          held[address] = (held[address] & ~lane) | (data & lane);
        }
        if (form.first < 32) held[address] &= (1u << form.first) - 1;
        master.write(address + byte_of_word, data, strobe);
      } else {
        master.read(address + byte_of_word, read_back(address));
      }
      if (step % 20 == 7) {  // nothing there: an error, and no effect
        const unsigned nowhere = step % 40 == 7 ? 0x8 : 0xffc;
        master.write(nowhere, static_cast<std::uint32_t>(random()), 0xf, register_master::slave_error);
        master.write(register_master::calls, 77, 0xf, register_master::slave_error);
        master.read(nowhere, 0, register_master::slave_error);
        master.read(register_master::calls, 0);
      }
    }
    for (const auto& [address, ignored] : shape) master.read(address, read_back(address));
    drive_request request;
    request.expected["echoes"] = 0;
    master.play(request, *model);
    const drive_result result = drive(*model, request, with_stalls(*model, seed));
    EXPECT_EQ(master.wrong_response(result), "");
  }
}

TEST(axi_lite, without_pauses_a_transfer_takes_two_clocks) {
  const auto model = make_argument_echo_axi_model(1);
  register_master master;
  for (std::uint32_t count = 0; count < 100; ++count) master.write(0x10, count);
  drive_request request;
  request.expected["echoes"] = 0;
  master.play(request, *model);
  const drive_result result = drive(*model, request, with_stalls(*model, 0));
  const std::vector<std::uint64_t>& clocks = result.outputs.at("s_axi_b").clocks;
  EXPECT_EQ(clocks.back() - clocks.front(), 2u * 99);
}

/// The echo's token for these arguments and this input.
std::vector<std::uint32_t> echo_of(const argument_token& arguments, std::uint8_t input) {
  std::vector<std::uint32_t> token((argument_bits + 8 + 31) / 32);
  std::ranges::copy(arguments, token.begin());
  set_bits_at(token, argument_bits, 8, input);
  return token;
}

TEST(axi_lite, a_call_has_what_was_written_before_its_first_token) {
  const registers map = read_register_map(ECHO_REGISTERS);
  const auto model = make_argument_echo_axi_model(2);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed) + 10);
    constexpr std::size_t calls = 60;
    register_master master;
    std::vector<std::size_t> writes_before;
    token_list inputs(8), echoes(argument_bits + 8);
    argument_token arguments{};
    for (std::size_t call = 0; call < calls; ++call) {
      const argument_token next = random_arguments(random);
      for (const auto& [name, where] : map) {
        if (!where.is_argument || random() % 3 == 0) continue;
        for (unsigned low = 0; low < where.width; low += 32) {
          const unsigned bits = std::min(32u, where.width - low);
          set_bits_at(arguments, where.offset + low, bits, bits_at(next, where.offset + low, bits));
        }
        // The call before must have started, and its result says so.
        master.only_when(
            [call](const drive_result& so_far) { return so_far.outputs.at("echoes").tokens.size() >= call; });
        master.write_register(where, arguments, random);
      }
      master.only_when(
          [call](const drive_result& so_far) { return so_far.outputs.at("echoes").tokens.size() >= call; });
      master.read(register_master::calls, static_cast<std::uint32_t>(call));
      writes_before.push_back(master.writes());
      const auto input = static_cast<std::uint8_t>(random());
      inputs.push_integer(input);
      echoes.push_back(echo_of(arguments, input));
    }
    drive_request request;
    request.inputs["tokens"] = inputs;
    request.expected["echoes"] = calls;
    master.play(request, *model, [&](const std::string& port, std::size_t index, const drive_result& so_far) {
      // The read of `calls` must not see the call that is still to come.
      return port != "tokens" || (register_master::written(so_far, writes_before[index]) &&
                                  so_far.outputs.at("s_axi_r").tokens.size() > index);
    });
    const drive_result result = drive(*model, request, with_stalls(*model, seed));
    EXPECT_EQ(master.wrong_response(result), "");
    EXPECT_EQ(result.outputs.at("echoes").tokens, echoes);
  }
}

TEST(axi_lite, an_update_between_calls_that_never_stop_comes_as_a_whole) {
  const registers map = read_register_map(ECHO_REGISTERS);
  const auto model = make_argument_echo_axi_model(3);
  std::size_t sets_seen = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed) + 30);
    constexpr std::size_t updates = 25;
    constexpr std::size_t calls = 1500;
    register_master master;
    std::vector<argument_token> sets{argument_token{}};
    for (std::size_t update = 0; update < updates; ++update) {
      sets.push_back(random_arguments(random));
      master.write(register_master::control, register_master::keep);
      for (const auto& [name, where] : map) {
        if (!where.is_argument) continue;
        // Nothing but the addresses' order is kept from here on: the slave must not mix the sets itself.
        master.write_register(where, sets.back(), random);
      }
      master.write(register_master::control, 0);
    }
    token_list inputs(8);
    for (std::size_t call = 0; call < calls; ++call) inputs.push_integer(call % 256);
    drive_request request;
    request.inputs["tokens"] = inputs;
    request.expected["echoes"] = calls;
    master.play(request, *model);
    drive_options options = with_stalls(*model, seed);
    options.stalls["tokens"] = {20, 1};
    options.stalls["echoes"] = {20, 1};
    const drive_result result = drive(*model, request, options);
    EXPECT_EQ(master.wrong_response(result), "");
    std::size_t set = 0;
    for (std::size_t call = 0; call < calls; ++call) {
      const auto token = result.outputs.at("echoes").tokens[call];
      const std::size_t before = set;
      while (set < sets.size() && !std::ranges::equal(token, echo_of(sets[set], static_cast<std::uint8_t>(call))))
        ++set;
      ASSERT_LT(set, sets.size()) << "call " << call << " has a mixture, or a set older than " << before;
      sets_seen += set != before;
    }
  }
  EXPECT_GT(sets_seen, 100u) << "too few updates fell between calls to show anything";
}

TEST(axi_lite, hold_stops_calls_start_lets_one_pass_and_a_release_all) {
  const auto model = make_argument_echo_axi_model(4);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    constexpr std::size_t calls = 10;
    register_master master;
    const auto echoes = [](const drive_result& so_far) { return so_far.outputs.at("echoes").tokens.size(); };
    master.write(register_master::control, register_master::hold);
    // Time in which a call would start: tokens wait at the input.
    master.only_when([](const drive_result& so_far) { return so_far.inputs.at("tokens").clocks.size() >= 2; });
    for (int pass = 0; pass < 50; ++pass) master.read(register_master::calls, 0);
    master.read(register_master::control, register_master::hold);
    master.write(register_master::control, register_master::hold | register_master::start);
    master.only_when([&](const drive_result& so_far) { return echoes(so_far) == 1; });
    for (int pass = 0; pass < 50; ++pass) master.read(register_master::calls, 1);
    master.read(register_master::control, register_master::hold);  // `start` has gone by itself
    const std::size_t before_release = master.writes();
    master.write(register_master::control, 0);
    master.only_when([&](const drive_result& so_far) { return echoes(so_far) == calls; });
    master.read(register_master::calls, calls);
    drive_request request;
    token_list inputs(8);
    for (std::size_t call = 0; call < calls; ++call) inputs.push_integer(call);
    request.inputs["tokens"] = inputs;
    request.expected["echoes"] = calls;
    master.play(request, *model, [](const std::string& port, std::size_t, const drive_result& so_far) {
      return port != "tokens" || register_master::written(so_far, 1);
    });
    const drive_result result = drive(*model, request, with_stalls(*model, seed));
    EXPECT_EQ(master.wrong_response(result), "");
    const std::uint64_t release = result.inputs.at("s_axi_w").clocks[before_release];
    EXPECT_GT(result.outputs.at("echoes").clocks[1], release) << "the second call did not wait";
  }
}

TEST(axi_lite, a_start_before_its_input_counts) {
  const auto model = make_argument_echo_axi_model(5);
  register_master master;
  // The call starts, with five = -3, before there is a token for it; what is written later is for the next call.
  const mapped_register five = read_register_map(ECHO_REGISTERS).at("five");
  master.write(five.address, static_cast<std::uint32_t>(-3));
  master.write(register_master::control, register_master::start);
  for (int wait = 0; wait < 4; ++wait) master.read(five.address, static_cast<std::uint32_t>(-3));
  master.read(register_master::calls, 1);
  master.write(five.address, 9);
  const std::size_t all = master.writes();
  drive_request request;
  token_list inputs(8);
  for (int call = 0; call < 2; ++call) inputs.push_integer(1);
  request.inputs["tokens"] = inputs;
  request.expected["echoes"] = 2;
  master.play(request, *model, [&](const std::string& port, std::size_t, const drive_result& so_far) {
    return port != "tokens" || register_master::written(so_far, all);
  });
  const drive_result result = drive(*model, request, with_stalls(*model, 0));
  EXPECT_EQ(master.wrong_response(result), "");
  const token_list& echoes = result.outputs.at("echoes").tokens;
  EXPECT_EQ(bits_at(echoes[0], five.offset, 5), 0x1du);
  EXPECT_EQ(bits_at(echoes[1], five.offset, 5), 9u);
}

TEST(axi_lite, a_top_without_inputs_runs_once_for_every_start) {
  const registers map = read_register_map(COUNT_UP_REGISTERS);
  const auto model = make_count_up_axi_model(1);
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    register_master master;
    token_list numbers(16);
    for (std::uint32_t call = 0; call < 12; ++call) {
      const std::uint32_t first = static_cast<std::uint32_t>(random()) & 0xffff;
      const std::uint32_t count = 1 + static_cast<std::uint32_t>(random() % 20);
      const std::size_t before = numbers.size();
      for (std::uint32_t number = 0; number < count; ++number) numbers.push_integer((first + number) & 0xffff);
      master.only_when(
          [before](const drive_result& so_far) { return so_far.outputs.at("numbers").tokens.size() == before; });
      master.read(register_master::calls, call);
      master.write(map.at("first").address, first);
      master.write(map.at("count").address, count);
      master.write(register_master::control, register_master::start);
    }
    drive_request request;
    request.expected["numbers"] = numbers.size();
    master.play(request, *model);
    const drive_result result = drive(*model, request, with_stalls(*model, seed));
    EXPECT_EQ(master.wrong_response(result), "");
    EXPECT_EQ(result.outputs.at("numbers").tokens, numbers);
  }
}

struct small_config : tops::color_fuzzy_config {
  static constexpr int max_width = 64;
  static constexpr int max_height = 255;
  static constexpr int levels = 8;
};

TEST(color_fuzzy_axi_lite, frames_whose_parameters_change_are_the_native_ones) {
  const registers map = read_register_map(COLOR_FUZZY_REGISTERS);
  const auto model = make_color_fuzzy_small_axi_model(1);
  // The same top with its arguments at ports: how frames and arguments become tokens.
  const auto plain = make_color_fuzzy_small_rtl_model(1);
  const frame_tokens frames(plain->ports(), small_config::pixels_per_beat);
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(static_cast<std::uint32_t>(seed) + 70);
    register_master master;
    drive_request request;
    std::vector<random_frame> pairs;
    std::vector<std::size_t> writes_before, first_input, first_output{0};
    for (int frame = 0; frame < 4; ++frame) {
      do pairs.emplace_back(random, 24, 10, small_config::levels);
      while (pairs.back().pair.left.width < 5 && (pairs.pop_back(), true));
      const eval::match_request wanted = pairs.back().request();
      first_input.push_back(request.inputs["left"].size());
      std::map<std::string, token_list> tokens;
      frames.append_frame(wanted, tokens);
      for (const char* side : {"left", "right"}) {
        if (frame == 0) request.inputs[side] = token_list(tokens.at(side).width());
        request.inputs[side].append_all(tokens.at(side));
      }
      // The frame before has started once it has taken in more tokens than its input registers hold.
      const std::size_t started = frame == 0 ? 0 : first_input[first_input.size() - 2] + 3;
      for (const auto& [name, where] : map) {
        if (!where.is_argument) continue;
        master.only_when(
            [started](const drive_result& so_far) { return so_far.inputs.at("left").clocks.size() >= started; });
        master.write_register(where, tokens.at("call")[0], random);
      }
      writes_before.push_back(master.writes());
      first_output.push_back(first_output.back() + frames.output_tokens(wanted.left.width, wanted.left.height));
    }
    request.expected[frames.output()] = first_output.back();
    master.play(request, *model, [&](const std::string& port, std::size_t index, const drive_result& so_far) {
      if (port != "left" && port != "right") return true;
      const auto frame = std::ranges::upper_bound(first_input, index) - first_input.begin() - 1;
      return register_master::written(so_far, writes_before[static_cast<std::size_t>(frame)]);
    });
    const drive_result result = drive(*model, request, with_stalls(*model, seed));
    EXPECT_EQ(master.wrong_response(result), "");
    for (std::size_t frame = 0; frame < pairs.size(); ++frame) {
      const test::stereo_pair& pair = pairs[frame].pair;
      const eval::disparity_map map_of_rtl = frames.map_of(result.outputs.at(frames.output()).tokens,
                                                           first_output[frame], pair.left.width, pair.left.height);
      ASSERT_TRUE(same_maps(map_of_rtl, native_map<small_config>(pair, pairs[frame].with))) << "frame " << frame;
    }
  }
}

}  // namespace
}  // namespace epiline::cosim
