#pragma once
// What the tests of the methods' RTL share: requests, the maps every level must send, and runs of several frames.

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <vector>

#include "../kernels/frame_harness.hpp"
#include "cosim/frame_tokens.hpp"
#include "cosim/model.hpp"
#include "cosim/stream_driver.hpp"
#include "eval/engine.hpp"
#include "golden/engines.hpp"

namespace epiline::cosim {

inline eval::rgb_image image_of(const test::picture& picture) {
  eval::rgb_image image(picture.width, picture.height);
  image.pixels = picture.channels;
  return image;
}

/// What a test needs to know of a method: the design's name, its settings, random ones, and its kernels.
struct color_fuzzy_method {
  static constexpr const char* name = "color_fuzzy";
  using settings = test::settings;
  struct config : tops::color_fuzzy_config {};

  static eval::parameter_values parameters(const settings& with) {
    return {{"left_right", with.left_right ? 1 : 0},
            {"uniqueness", with.uniqueness},
            {"fuzzy", with.fuzzy},
            {"careful_fill", with.careful_fill ? 1 : 0}};
  }
  static settings random_settings(std::mt19937& random) {
    settings with;
    with.left_right = random() % 4 != 0;
    with.uniqueness = random() % 4 == 0 ? 0 : 14 + static_cast<int>(random() % 8);
    with.fuzzy = static_cast<int>(random() % 3);
    with.careful_fill = random() % 2 == 0;
    return with;
  }
  template <class Config>
  static test::disparity_map run(const test::stereo_pair& pair, const settings& with) {
    return test::run_color_fuzzy<Config>(pair, with);
  }
};

struct adaptive_ca_method {
  static constexpr const char* name = "adaptive_ca";
  using settings = test::adaptive_ca_settings;
  struct config : tops::adaptive_ca_config {};

  static eval::parameter_values parameters(const settings& with) {
    return {{"t2", with.t2}, {"t5", with.t5}, {"automaton", with.automaton ? 1 : 0}, {"ring", with.ring}};
  }
  static settings random_settings(std::mt19937& random) {
    const auto below = [&random](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    settings with;
    // Random frames vary much: thresholds around their variation, so that every window is chosen.
    with.t2 = below(4) == 0 ? below(256) : 150 + below(100);
    with.t5 = below(4) == 0 ? below(3183) : 1000 + below(800);
    with.automaton = below(4) != 0;
    with.ring = below(4) == 0 ? 1 + below(40) : 1 + below(8);
    return with;
  }
  template <class Config>
  static test::disparity_map run(const test::stereo_pair& pair, const settings& with) {
    return test::run_adaptive_ca<Config>(pair, with);
  }
};

template <class Method>
eval::match_request request_of(const test::stereo_pair& pair, const typename Method::settings& with) {
  eval::match_request request;
  request.left = image_of(pair.left);
  request.right = image_of(pair.right);
  request.levels = with.levels;
  request.parameters = Method::parameters(with);
  return request;
}

/// A frame with random size, content and parameters within a configuration's limits.
template <class Method>
struct random_frame_of {
  test::stereo_pair pair;
  typename Method::settings with;

  random_frame_of(std::mt19937& random, int max_width, int max_height, int max_levels)
      : pair(test::random_pair(random, 1 + static_cast<int>(random() % static_cast<unsigned>(max_width)),
                               1 + static_cast<int>(random() % static_cast<unsigned>(max_height)), max_levels - 1,
                               static_cast<int>(random() % 20))) {
    const int levels = 1 + static_cast<int>(random() % static_cast<unsigned>(max_levels));
    with = Method::random_settings(random);
    with.levels = levels;
  }

  [[nodiscard]] eval::match_request request() const { return request_of<Method>(pair, with); }
};
using random_frame = random_frame_of<color_fuzzy_method>;

/// A scene of slanted and stepped surfaces in texture, from disparity 0 to levels - 1, with noise: larger than a random
/// frame, and closer to what cameras see.
inline test::stereo_pair synthetic_scene(int width, int height, int levels, unsigned seed) {
  std::mt19937 random(seed);
  test::stereo_pair pair{{width, height, {}}, {width, height, {}}};
  const auto count = static_cast<std::size_t>(width * height * 3);
  for (test::picture* picture : {&pair.left, &pair.right}) {
    picture->channels.resize(count);
    for (auto& value : picture->channels) value = static_cast<std::uint8_t>(random());
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool block = (x / 48 + y / 32) % 2 == 0;
      const int disparity = block ? (x / 48 * 13 + y / 32 * 29) % levels : (y * levels / height + x / 16) % levels;
      if (x < disparity) continue;
      for (int channel = 0; channel < 3; ++channel) {
        const int noise = static_cast<int>(random() % 5) - 2;
        const int value = pair.left.at(x, y, channel) + noise;
        pair.right.channels[static_cast<std::size_t>((y * width + x - disparity) * 3 + channel)] =
            static_cast<std::uint8_t>(value < 0     ? 0
                                      : value > 255 ? 255
                                                    : value);
      }
    }
  }
  return pair;
}

template <class Method, class Config>
eval::disparity_map native_map_of(const test::stereo_pair& pair, const typename Method::settings& with) {
  const test::disparity_map values = Method::template run<Config>(pair, with);
  eval::disparity_map map(pair.left.width, pair.left.height);
  EXPECT_EQ(values.size(), map.disparity.size());
  for (std::size_t index = 0; index < values.size(); ++index) {
    const bool defined = values[index] != test::undefined;
    map.defined[index] = defined ? 1 : 0;
    map.disparity[index] = static_cast<std::uint8_t>(defined ? values[index] : 0);
  }
  return map;
}
template <class Config>
eval::disparity_map native_map(const test::stereo_pair& pair, const test::settings& with) {
  return native_map_of<color_fuzzy_method, Config>(pair, with);
}

template <class Method>
eval::disparity_map golden_map(const eval::match_request& request) {
  eval::engine_registry registry;
  golden::register_engines(registry);
  const eval::design_description& design = *eval::find_design(Method::name);
  return registry.find(Method::name, "golden")->make(design)->match(request, {}).map;
}

struct frames_run {
  std::vector<eval::disparity_map> maps;
  std::vector<std::uint64_t> frame_ends;  // clock of each frame's last output token
  std::uint64_t clocks = 0;
};

/// Plays the frames one after another without a pause between them.
inline frames_run run_frames(rtl_model& model, const std::vector<eval::match_request>& requests, int pixels_per_beat,
                             const drive_options& options) {
  const frame_tokens frames(model.ports(), pixels_per_beat);
  drive_request drive_this;
  std::size_t expected = 0;
  for (const eval::match_request& request : requests) {
    frames.append_frame(request, drive_this.inputs);
    expected += frames.output_tokens(request.left.width, request.left.height);
  }
  drive_this.expected[frames.output()] = expected;
  const drive_result driven = drive(model, drive_this, options);
  const port_record& output = driven.outputs.at(frames.output());
  frames_run run;
  run.clocks = driven.clocks;
  std::size_t first = 0;
  for (const eval::match_request& request : requests) {
    run.maps.push_back(frames.map_of(output.tokens, first, request.left.width, request.left.height));
    first += frames.output_tokens(request.left.width, request.left.height);
    run.frame_ends.push_back(output.clocks[first - 1]);
  }
  return run;
}

/// Pixels that differ; a test prints the first.
inline testing::AssertionResult same_maps(const eval::disparity_map& got, const eval::disparity_map& wanted) {
  if (got == wanted) return testing::AssertionSuccess();
  if (got.width != wanted.width || got.height != wanted.height) return testing::AssertionFailure() << "sizes differ";
  std::size_t count = 0;
  std::size_t first = 0;
  for (std::size_t index = got.disparity.size(); index-- > 0;) {
    if (got.disparity[index] == wanted.disparity[index] && got.defined[index] == wanted.defined[index]) continue;
    ++count;
    first = index;
  }
  const auto text = [first](const eval::disparity_map& map) {
    return map.defined[first] != 0 ? std::to_string(map.disparity[first]) : std::string("undefined");
  };
  const std::size_t width = static_cast<std::size_t>(got.width);
  return testing::AssertionFailure() << count << " pixels differ; the first at column " << first % width << ", row "
                                     << first / width << ": " << text(got) << ", not " << text(wanted) << " ("
                                     << got.width << "x" << got.height << ")";
}

}  // namespace epiline::cosim
