// Rendered scenes: their truth is true, their masks are right, their parameters do what they say.

#include "scenes/render.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "scenes/catalogue.hpp"
#include "scenes/noise.hpp"

namespace epiline::scenes {

// Names a test after its scene.
void PrintTo(const scene_description& scene, std::ostream* stream) { *stream << scene.name; }

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr scene_parameters small{.width = 160, .height = 90, .levels = 40, .seed = 5};

class every_scene : public testing::TestWithParam<scene_description> {
 protected:
  [[nodiscard]] static stereo_scene make(const scene_parameters& parameters = small) {
    return render(GetParam().name, parameters);
  }
};

double disparity(const view& view, int x, int y) {
  return view.disparity.values[static_cast<std::size_t>(y * view.disparity.width + x)];
}
bool visible(const view& view, int x, int y) {
  return view.visible.selected[static_cast<std::size_t>(y * view.visible.width + x)];
}

/// Calls `visit(x, y)` for every pixel.
template <class Visit>
void for_every_pixel(const scene_parameters& of, Visit&& visit) {
  for (int y = 0; y < of.height; ++y) {
    for (int x = 0; x < of.width; ++x) visit(x, y);
  }
}

TEST_P(every_scene, has_truth_within_the_levels_at_every_size) {
  for (const auto& [width, height, levels] :
       {std::array{160, 90, 40}, {640, 8, 80}, {1, 1, 2}, {1, 40, 16}, {40, 1, 80}, {33, 17, 256}, {7, 3, 2}}) {
    const scene_parameters with{.width = width, .height = height, .levels = levels};
    const auto pair = make(with);
    for (const view* side : {&pair.left, &pair.right}) {
      ASSERT_EQ(side->image.width, width);
      ASSERT_EQ(side->image.height, height);
      const std::size_t pixels = static_cast<std::size_t>(width) * height;
      ASSERT_EQ(side->disparity.values.size(), pixels);
      ASSERT_EQ(side->visible.selected.size(), pixels);
      for (const double d : side->disparity.values) {
        ASSERT_GE(d, 0);
        ASSERT_LE(d, levels - 1 + 1e-9);
        if (GetParam().whole_disparities) ASSERT_EQ(d, std::round(d));
      }
    }
  }
}

TEST_P(every_scene, shows_both_cameras_the_same_colour_of_a_point_that_both_see) {
  // At the exact position, which lies between pixels where the disparity is not whole.
  const room scene = build(GetParam().name, small);
  const auto pair = make();
  int compared = 0;
  for_every_pixel(small, [&](int x, int y) {
    if (!visible(pair.left, x, y)) return;
    const auto surfaces = scene.surfaces_of_row(y);
    const double row = y;
    const auto in_left = room::nearest(surfaces, camera::left, {static_cast<double>(x), row});
    const auto in_right = room::nearest(surfaces, camera::right, {x - disparity(pair.left, x, y), row});
    ASSERT_NEAR(in_right.disparity, in_left.disparity, 1e-6);
    ASSERT_EQ(in_left.disparity, disparity(pair.left, x, y));
    // Where surfaces cross, both are there.
    if (in_right.seen != in_left.seen) return;
    const colour difference = in_left.seen->colour_at(in_left.in_left) - in_right.seen->colour_at(in_right.in_left);
    ASSERT_LT(difference.abs().maxCoeff(), 1e-4) << x << "," << y;
    ++compared;
  });
  EXPECT_GT(compared, small.width * small.height / 2);
}

TEST_P(every_scene, is_reproduced_by_warping_the_right_image_by_the_truth) {
  const auto pair = make();
  double sum = 0;
  int compared = 0;
  for_every_pixel(small, [&](int x, int y) {
    if (!visible(pair.left, x, y)) return;
    const double at = x - disparity(pair.left, x, y);
    const int before = static_cast<int>(std::floor(at));
    const double share = at - before;
    if (share != 0) {
      // Between two pixels of the same surface only: over an edge there is nothing to interpolate.
      if (before < 0 || before + 1 >= small.width) return;
      const double here = disparity(pair.left, x, y);
      if (std::abs(disparity(pair.right, before, y) - here) > 0.75) return;
      if (std::abs(disparity(pair.right, before + 1, y) - here) > 0.75) return;
    }
    for (int c = 0; c < 3; ++c) {
      const double warped =
          share == 0 ? pair.right.image.at(before, y)[c]
                     : (1 - share) * pair.right.image.at(before, y)[c] + share * pair.right.image.at(before + 1, y)[c];
      const double difference = std::abs(warped - pair.left.image.at(x, y)[c]);
      if (GetParam().whole_disparities) ASSERT_EQ(difference, 0) << x << "," << y;
      sum += difference;
      ++compared;
    }
  });
  EXPECT_GT(compared, small.width * small.height);
  // What linear interpolation of a texture whose shortest wave is four pixels costs, far below its contrast.
  EXPECT_LT(sum / compared, 4);
}

TEST_P(every_scene, marks_what_the_other_camera_sees) {
  const auto pair = make();
  int seen = 0;
  int hidden = 0;
  int outside = 0;
  for (const bool from_left : {true, false}) {
    const view& here = from_left ? pair.left : pair.right;
    const view& there = from_left ? pair.right : pair.left;
    for_every_pixel(small, [&](int x, int y) {
      const double d = disparity(here, x, y);
      const double at = from_left ? x - d : x + d;
      if (at < -1e-6 || at > small.width - 1 + 1e-6) {
        ASSERT_FALSE(visible(here, x, y));
        ++outside;
        return;
      }
      const int before = std::clamp(static_cast<int>(std::floor(at + 1e-6)), 0, small.width - 1);
      const int after = std::min(static_cast<int>(std::ceil(at - 1e-6)), small.width - 1);
      const double first = disparity(there, before, y);
      const double second = disparity(there, after, y);
      if (visible(here, x, y)) {
        ++seen;
        // One of the pixels beside the position sees the same surface, which changes by half a pixel a column at most.
        ASSERT_LE(std::min(std::abs(first - d), std::abs(second - d)), before == after ? 1e-6 : 0.75) << x << "," << y;
      } else {
        ++hidden;
        ASSERT_GT(std::max(first, second), d) << x << "," << y;
      }
    });
  }
  EXPECT_GT(seen, small.width * small.height);
  EXPECT_GT(outside, 0);
  if (GetParam().name != "corridor") EXPECT_GT(hidden, 0);  // nothing hides anything in an empty corridor
}

std::uint64_t checksum(const stereo_scene& pair) {
  std::uint64_t sum = 0;
  for (const view* side : {&pair.left, &pair.right}) {
    for (const auto value : side->image.pixels) sum = hash(sum, {value});
    for (const double d : side->disparity.values) sum = hash(sum, {std::llround(d * 65536)});
    for (const bool bit : side->visible.selected) sum = hash(sum, {bit ? 1 : 0});
  }
  return sum;
}

TEST_P(every_scene, depends_on_its_parameters_and_on_nothing_else) {
  const auto sum = checksum(make());
  EXPECT_EQ(checksum(make()), sum);
  scene_parameters other = small;
  other.seed = 6;
  EXPECT_NE(checksum(make(other)), sum);
}

INSTANTIATE_TEST_SUITE_P(scenes, every_scene, testing::ValuesIn(all_scenes().begin(), all_scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(render, gives_the_same_bytes_on_every_machine) {
  const scene_parameters with{
      .width = 97, .height = 31, .levels = 50, .seed = 12, .noise = 3, .gain = 1.1, .offset = -4, .misalignment = 0.25};
  const std::pair<const char*, std::uint64_t> known[] = {
      {"corridor", 558037779647414210u},    {"slanted", 11806544159807938502u},
      {"steps", 18255560468054014059u},     {"textureless", 4604035981223788691u},
      {"repetitive", 5525501902951425747u}, {"random_dot", 11233021884977177848u},
      {"mosaic", 11562346409045950435u},
  };
  EXPECT_EQ(std::size(known), all_scenes().size());
  for (const auto& [name, sum] : known) EXPECT_EQ(checksum(render(name, with)), sum) << name;
}

// ---- parameters

TEST(render, adds_noise_of_the_deviation_asked_for_to_each_image_and_colour) {
  scene_parameters with{.width = 160, .height = 90, .levels = 40};
  const auto clean = render("textureless", with);
  with.noise = 5;
  const auto noisy = render("textureless", with);
  std::vector<double> of_colour[6];
  for (int y = 20; y < 70; ++y) {
    for (int x = 50; x < 110; ++x) {  // in the wall in both images: no value is clipped
      for (int c = 0; c < 3; ++c) {
        of_colour[c].push_back(noisy.left.image.at(x, y)[c] - clean.left.image.at(x, y)[c]);
        of_colour[3 + c].push_back(noisy.right.image.at(x, y)[c] - clean.right.image.at(x, y)[c]);
      }
    }
  }
  const auto mean_product = [](const auto& a, const auto& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0) / static_cast<double>(a.size());
  };
  for (int i = 0; i < 6; ++i) {
    const double mean = std::accumulate(of_colour[i].begin(), of_colour[i].end(), 0.0) / 3000;
    EXPECT_NEAR(mean, 0, 0.8) << i;  // the wall's own value was rounded, by up to 0.5
    for (double& value : of_colour[i]) value -= mean;
    EXPECT_NEAR(std::sqrt(mean_product(of_colour[i], of_colour[i])), 5, 0.3) << i;
    for (int j = 0; j < i; ++j) EXPECT_NEAR(mean_product(of_colour[i], of_colour[j]) / 25, 0, 0.08) << i << j;
  }
  EXPECT_EQ(noisy.left.disparity.values, clean.left.disparity.values);
}

TEST(render, changes_gain_and_offset_of_the_right_image_only) {
  scene_parameters with = small;
  const auto plain = render("steps", with);
  with.gain = 1.25;
  with.offset = -20;
  const auto changed = render("steps", with);
  EXPECT_EQ(changed.left.image.pixels, plain.left.image.pixels);
  EXPECT_EQ(changed.right.disparity.values, plain.right.disparity.values);
  for (std::size_t i = 0; i < plain.right.image.pixels.size(); ++i) {
    const double expected = std::clamp(1.25 * plain.right.image.pixels[i] - 20, 0.0, 255.0);
    // Values that were clipped before may come back into the range.
    if (plain.right.image.pixels[i] == 0 || plain.right.image.pixels[i] == 255) continue;
    ASSERT_NEAR(changed.right.image.pixels[i], expected, 1.25 / 2 + 0.5);
  }
}

TEST(render, moves_the_right_image_down_by_the_misalignment) {
  scene_parameters with = small;
  const auto aligned = render("slanted", with);
  with.misalignment = 2;
  const auto lower = render("slanted", with);
  EXPECT_EQ(lower.left.image.pixels, aligned.left.image.pixels);
  EXPECT_EQ(lower.right.disparity.values, aligned.right.disparity.values);
  EXPECT_EQ(lower.right.visible.selected, aligned.right.visible.selected);
  const std::size_t two_rows = std::size_t{2} * 3 * 160;
  EXPECT_TRUE(std::equal(lower.right.image.pixels.begin() + two_rows, lower.right.image.pixels.end(),
                         aligned.right.image.pixels.begin()));

  // By half a row: nearer to the mean of two rows than to either.
  with.misalignment = 0.5;
  const auto between = render("slanted", with);
  double to_mean = 0;
  double to_row = 0;
  double to_row_above = 0;
  for (std::size_t i = 3 * 160; i < between.right.image.pixels.size(); ++i) {
    const double row = aligned.right.image.pixels[i];
    const double above = aligned.right.image.pixels[i - 3 * 160];
    const double value = between.right.image.pixels[i];
    to_mean += std::abs(value - (row + above) / 2);
    to_row += std::abs(value - row);
    to_row_above += std::abs(value - above);
  }
  EXPECT_LT(to_mean, to_row / 2);
  EXPECT_LT(to_mean, to_row_above / 2);
}

TEST(render, repeats_the_pattern_of_the_repetitive_wall) {
  const auto pair = render("repetitive", small);
  const int period = 40 / 5;
  for (int y = 30; y < 60; ++y) {
    for (int x = 40; x < 100; ++x) {
      for (int c = 0; c < 3; ++c) ASSERT_EQ(pair.left.image.at(x, y)[c], pair.left.image.at(x + period, y)[c]);
    }
  }
}

TEST(render, refuses_bad_parameters) {
  const auto expect = [](auto&& change, const std::string& name, const std::string& range) {
    scene_parameters with;
    change(with);
    EXPECT_THAT([&] { (void)render("corridor", with); },
                ThrowsMessage<scene_error>(AllOf(HasSubstr(name), HasSubstr("must be " + range))));
  };
  for (const int value : {0, -1, 4097}) {
    expect([&](auto& p) { p.width = value; }, "width is " + std::to_string(value), "1 to 4096");
    expect([&](auto& p) { p.height = value; }, "height is " + std::to_string(value), "1 to 4096");
  }
  for (const int value : {1, 257}) {
    expect([&](auto& p) { p.levels = value; }, "levels is " + std::to_string(value), "2 to 256");
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {-0.1, 64.5, nan}) expect([&](auto& p) { p.noise = value; }, "noise is ", "0 to 64");
  for (const double value : {0.0, 10.5, nan}) expect([&](auto& p) { p.gain = value; }, "gain is ", "0.1 to 10");
  for (const double value : {-256.0, 256.0, nan})
    expect([&](auto& p) { p.offset = value; }, "offset is ", "-255 to 255");
  for (const double value : {-16.5, 16.5, nan}) {
    expect([&](auto& p) { p.misalignment = value; }, "misalignment is ", "-16 to 16");
  }
  EXPECT_THAT([] { (void)render("coridor", {}); },
              ThrowsMessage<scene_error>(AllOf(HasSubstr("'coridor'"), HasSubstr("did you mean corridor?"))));
  EXPECT_THAT([] { (void)render("", {}); },
              ThrowsMessage<scene_error>(AllOf(HasSubstr("unknown scene ''"), HasSubstr("corridor, slanted"))));
}

TEST(noise, is_uniform_and_nearly_normal) {
  double sum = 0;
  double squares = 0;
  double normal = 0;
  double normal_squares = 0;
  constexpr int count = 20000;
  int seen[5] = {};
  for (int i = 0; i < count; ++i) {
    const double u = uniform(hash(3, {i}));
    ASSERT_TRUE(u >= 0 && u < 1);
    sum += u;
    squares += u * u;
    const double g = gaussian(4, {i, -1});
    normal += g;
    normal_squares += g * g;
    ++seen[between(hash(5, {i}), -2, 2) + 2];
  }
  EXPECT_NEAR(sum / count, 0.5, 0.01);
  EXPECT_NEAR(squares / count, 1 / 3.0, 0.01);
  EXPECT_NEAR(normal / count, 0, 0.03);
  EXPECT_NEAR(normal_squares / count, 1, 0.04);
  for (const int times : seen) EXPECT_NEAR(times, count / 5, 300);
}

}  // namespace
}  // namespace epiline::scenes
