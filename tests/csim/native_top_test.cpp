#include "csim/native_top.hpp"

#include <gtest/gtest.h>

#include <type_traits>

#include "eval/metrics.hpp"
#include "eval/random_images.hpp"
#include "golden/engines.hpp"
#include "tops/adaptive_ca.hpp"
#include "tops/color_fuzzy.hpp"

namespace epiline::csim {
namespace {

template <class Full, int PixelsPerBeat, int Levels>
struct narrow_of : Full {
  static constexpr int max_width = 72;
  static constexpr int max_height = 64;
  static constexpr int levels = Levels;
  static constexpr int pixels_per_beat = PixelsPerBeat;
};
template <int PixelsPerBeat, int Levels>
using narrow = narrow_of<tops::color_fuzzy_config, PixelsPerBeat, Levels>;
template <int PixelsPerBeat, int Levels>
using narrow_adaptive = narrow_of<tops::adaptive_ca_config, PixelsPerBeat, Levels>;

using types = tops::color_fuzzy_interface<narrow<2, 12>>;
using video_stream = hls::stream<types::video_beat>;
using disparity_stream = hls::stream<types::disparity_beat>;

/// A top that answers every input beat by "undefined", correctly marked.
void answer_nothing(video_stream& left, video_stream& right, disparity_stream& disparity) {
  while (!left.empty()) {
    const auto token = left.read();
    right.read();
    types::disparity_beat out{};
    out.data = 0;
    out.keep = (token.keep & 8) != 0 ? 3 : 1;  // byte 3 is the first of the second pixel
    out.user = token.user;
    out.last = token.last;
    disparity.write(out);
  }
}

template <class Top>
std::string failure_of(Top&& top) {
  const eval::rgb_image image(5, 2);
  try {
    (void)run_native_top<types>(image, image, top);
  } catch (const eval::engine_error& error) {
    return error.what();
  }
  return "no failure";
}

TEST(run_native_top, accepts_a_whole_frame) { EXPECT_EQ(failure_of(answer_nothing), "no failure"); }

TEST(run_native_top, names_the_streams_with_unread_tokens) {
  const std::string message = failure_of([](auto& left, auto& right, auto&) {
    while (left.size() > 2) left.read();
    while (right.size() > 1) right.read();
  });
  EXPECT_EQ(message, "the top left unread tokens in stream 'left' (2) 'right' (1)");
}

TEST(run_native_top, names_the_stream_of_a_read_that_can_never_be_served) {
  const std::string message = failure_of([](auto& left, auto& right, auto& disparity) {
    answer_nothing(left, right, disparity);
    right.read();
  });
  EXPECT_NE(message.find("read of 'right' can never be served"), std::string::npos) << message;
}

TEST(run_native_top, refuses_an_output_that_is_no_frame) {
  const std::string message = failure_of([](auto& left, auto& right, auto& disparity) {
    answer_nothing(left, right, disparity);
    disparity.read();
  });
  EXPECT_EQ(message, "the disparity stream holds 5 beats, a 5x2 frame has 6");
}

// ---- the kernels against the reference model
// ---------------------------------------------------------------------------

/// Frames of random images, sizes and parameters through `run(request, left, right, disparity)`, the top of a
/// configuration of `name`.
template <class Types, class Config, class Run>
void expect_golden(std::string_view name, Run run) {
  using config = Config;
  eval::engine_registry registry;
  golden::register_engines(registry);
  const auto& design = *eval::find_design(name);
  const auto golden = registry.find(name, "golden")->make(design);

  std::mt19937 random(100 + config::pixels_per_beat);
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  std::uint64_t defined = 0;
  std::uint64_t pixels = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const int width = repeat % 8 == 0 ? config::max_width : between(1, config::max_width);
    const int height = repeat % 8 == 1 ? 1 : between(1, 24);
    const int greys = repeat % 5 == 0 ? 2 : 256;
    auto [left, right] = test::random_pair(random, width, height, config::levels - 1, greys);
    if (repeat % 15 == 7) {  // the largest costs there are
      std::ranges::fill(left.pixels, std::uint8_t{255});
      std::ranges::fill(right.pixels, std::uint8_t{0});
    }
    eval::match_request request{left, right, between(1, config::levels), {}};
    std::string parameters;
    for (const auto& parameter : design.parameters) {
      const int value = repeat % 3 == 0 ? parameter.default_value : between(parameter.minimum, parameter.maximum);
      request.parameters.emplace(parameter.name, value);
      parameters += ", " + std::string(parameter.name) + " " + std::to_string(value);
    }
    const auto map = run_native_top<Types>(left, right, [&](auto& left_stream, auto& right_stream, auto& disparity) {
      run(request, left_stream, right_stream, disparity);
    });
    const auto expected = golden->match(request, {}).map;
    const auto difference = eval::compare(expected, map);
    ASSERT_EQ(difference.differing, 0u) << width << "x" << height << ", levels " << request.levels << parameters
                                        << ": first at column " << difference.first_x << ", row " << difference.first_y;
    for (const auto bit : expected.defined) defined += bit;
    pixels += expected.defined.size();
  }
  // The comparison saw both kinds of pixel in numbers.
  EXPECT_GT(defined, pixels / 10);
  EXPECT_GT(pixels - defined, pixels / 20);
}

template <class Config>
class color_fuzzy_native : public testing::Test {};
using configurations = testing::Types<narrow<1, 12>, narrow<2, 12>, narrow<4, 12>, narrow<1, 33>>;
TYPED_TEST_SUITE(color_fuzzy_native, configurations);

TYPED_TEST(color_fuzzy_native, equals_the_golden_model_on_random_images_sizes_and_parameters) {
  expect_golden<tops::color_fuzzy_interface<TypeParam>, TypeParam>(
      "color_fuzzy", [](const eval::match_request& request, auto& left, auto& right, auto& disparity) {
        const auto& with = request.parameters;
        tops::color_fuzzy_frame<TypeParam>(left, right, disparity, request.left.width, request.left.height,
                                           request.levels, with.at("left_right"), with.at("uniqueness"),
                                           with.at("fuzzy"), with.at("careful_fill"));
      });
}

template <class Config>
class adaptive_ca_native : public testing::Test {};
using adaptive_configurations =
    testing::Types<narrow_adaptive<1, 12>, narrow_adaptive<2, 12>, narrow_adaptive<4, 12>, narrow_adaptive<1, 33>>;
TYPED_TEST_SUITE(adaptive_ca_native, adaptive_configurations);

TYPED_TEST(adaptive_ca_native, equals_the_golden_model_on_random_images_sizes_and_parameters) {
  expect_golden<tops::adaptive_ca_interface<TypeParam>, TypeParam>(
      "adaptive_ca", [](const eval::match_request& request, auto& left, auto& right, auto& disparity) {
        const auto& with = request.parameters;
        tops::adaptive_ca_frame<TypeParam>(left, right, disparity, request.left.width, request.left.height,
                                           request.levels, with.at("t2"), with.at("t5"), with.at("automaton"),
                                           with.at("ring"));
      });
}

}  // namespace
}  // namespace epiline::csim
