// Native C-simulation of methods 1 and 2 at 640x480, 80 levels, one thread, beside OpenCV's matchers on the same pair
// in the same run. The pair is a textured scene with three depths, made here, so the figures need no data. Rates are
// frames per second of processor time; `ratio_to_sgbm` is the kernels' rate over StereoSGBM's.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <ctime>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "tops/adaptive_ca.hpp"
#include "tops/color_fuzzy.hpp"

namespace {

constexpr int width = 640;
constexpr int height = 480;
constexpr int levels = 80;

struct scene {
  cv::Mat left;  // 8-bit red, green, blue
  cv::Mat right;
};

/// Smooth random texture, shifted by 10, 30 and 60 levels in three bands, with a little noise in the right image.
scene make_scene() {
  std::mt19937 random(1);
  cv::Mat texture(height, width + levels, CV_8UC3);
  for (auto it = texture.begin<cv::Vec3b>(); it != texture.end<cv::Vec3b>(); ++it) {
    for (int c = 0; c < 3; ++c) (*it)[c] = static_cast<std::uint8_t>(random() % 256);
  }
  cv::GaussianBlur(texture, texture, {3, 3}, 0);
  scene made{texture(cv::Rect(0, 0, width, height)).clone(), cv::Mat(height, width, CV_8UC3)};
  for (int y = 0; y < height; ++y) {
    const int shift = y < height / 3 ? 10 : y < 2 * height / 3 ? 30 : 60;
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const int noisy = texture.at<cv::Vec3b>(y, x + shift)[c] + static_cast<int>(random() % 7) - 3;
        made.right.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(noisy);
      }
    }
  }
  return made;
}

const scene& shared_scene() {
  static const scene made = make_scene();
  return made;
}

using color_fuzzy_config = epiline::tops::color_fuzzy_config;
using adaptive_ca_config = epiline::tops::adaptive_ca_config;
static_assert(color_fuzzy_config::levels == levels && adaptive_ca_config::levels == levels);
using types = epiline::tops::stereo_interface<color_fuzzy_config>;  // method 1's beats are the same

void fill(hls::stream<types::video_beat>& stream, const cv::Mat& image) {
  for (auto it = image.begin<cv::Vec3b>(); it != image.end<cv::Vec3b>(); ++it) {
    types::video_beat beat{};
    beat.data = static_cast<std::uint32_t>((*it)[0] | ((*it)[1] << 8) | ((*it)[2] << 16));
    stream.write(beat);
  }
}

/// Frames per second of processor time of the benchmark that ran before, for the ratio.
double sgbm_seconds_a_frame = 0;

/// Times `top(left, right, disparity)` on the scene, frame by frame.
template <class Top>
void run_native(benchmark::State& state, Top top) {
  hls::stream<types::video_beat> left("left");
  hls::stream<types::video_beat> right("right");
  hls::stream<types::disparity_beat> disparity("disparity");
  const scene& images = shared_scene();
  double seconds = 0;
  for (auto _ : state) {
    fill(left, images.left);
    fill(right, images.right);
    const std::clock_t begin = std::clock();
    top(left, right, disparity);
    const double frame_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    state.SetIterationTime(frame_seconds);
    seconds += frame_seconds;
    while (!disparity.empty()) benchmark::DoNotOptimize(disparity.read());
  }
  const auto frames = static_cast<double>(state.iterations());
  state.counters["frames/s"] = frames / seconds;
  if (sgbm_seconds_a_frame > 0) state.counters["ratio_to_sgbm"] = sgbm_seconds_a_frame * frames / seconds;
}

void color_fuzzy_native(benchmark::State& state) {
  const bool whole_method = state.range(0) != 0;
  run_native(state, [whole_method](auto& left, auto& right, auto& disparity) {
    epiline::tops::color_fuzzy_frame<color_fuzzy_config>(left, right, disparity, width, height, levels, whole_method,
                                                         whole_method ? 17 : 0, whole_method ? 2 : 0, 0);
  });
}

void adaptive_ca_native(benchmark::State& state) {
  const bool automaton = state.range(0) != 0;
  run_native(state, [automaton](auto& left, auto& right, auto& disparity) {
    epiline::tops::adaptive_ca_frame<adaptive_ca_config>(left, right, disparity, width, height, levels, 32, 100,
                                                         automaton, 24);
  });
}

void match_with(benchmark::State& state, cv::StereoMatcher& matcher, bool grey, double* seconds_a_frame) {
  cv::setNumThreads(1);
  cv::Mat left = shared_scene().left;
  cv::Mat right = shared_scene().right;
  if (grey) {
    cv::cvtColor(shared_scene().left, left, cv::COLOR_RGB2GRAY);
    cv::cvtColor(shared_scene().right, right, cv::COLOR_RGB2GRAY);
  }
  cv::Mat disparity;
  double seconds = 0;
  for (auto _ : state) {
    const std::clock_t begin = std::clock();
    matcher.compute(left, right, disparity);
    const double frame_seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    state.SetIterationTime(frame_seconds);
    seconds += frame_seconds;
    benchmark::DoNotOptimize(disparity.data);
  }
  state.counters["frames/s"] = static_cast<double>(state.iterations()) / seconds;
  if (seconds_a_frame != nullptr) *seconds_a_frame = seconds / static_cast<double>(state.iterations());
}

void opencv_sgbm(benchmark::State& state) {
  const auto matcher =
      cv::StereoSGBM::create(0, levels, 5, 8 * 3 * 25, 32 * 3 * 25, 1, 0, 10, 0, 0, static_cast<int>(state.range(0)));
  match_with(state, *matcher, false, &sgbm_seconds_a_frame);
}

void opencv_bm(benchmark::State& state) {
  const auto matcher = cv::StereoBM::create(levels, 11);
  match_with(state, *matcher, true, nullptr);
}

// StereoSGBM runs first: the ratio is to its default mode (five paths), the last one to run.
BENCHMARK(opencv_bm)->UseManualTime()->Unit(benchmark::kMillisecond)->Name("opencv_bm_11x11");
BENCHMARK(opencv_sgbm)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->ArgName("mode")
    ->Arg(cv::StereoSGBM::MODE_HH)
    ->Arg(cv::StereoSGBM::MODE_SGBM);
BENCHMARK(color_fuzzy_native)->UseManualTime()->Unit(benchmark::kMillisecond)->ArgName("whole_method")->Arg(0)->Arg(1);
BENCHMARK(adaptive_ca_native)->UseManualTime()->Unit(benchmark::kMillisecond)->ArgName("automaton")->Arg(0)->Arg(1);

}  // namespace

BENCHMARK_MAIN();
