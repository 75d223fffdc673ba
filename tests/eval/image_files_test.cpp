#include "eval/image_files.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "eval/scratch_folder.hpp"

namespace epiline::eval {
namespace {

using test::read_file;
using test::scratch_folder;
using test::write_file;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

cv::Mat colour_picture(int width = 40, int height = 30) {
  cv::Mat picture(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<std::uint8_t>(x * 5), static_cast<std::uint8_t>(y * 7),
                                              static_cast<std::uint8_t>(x * y + 31));  // blue, green, red
    }
  }
  return picture;
}

template <class Function>
void expect_refusal(Function&& function, const std::string& first, const std::string& second) {
  EXPECT_THAT(function, ThrowsMessage<file_error>(AllOf(HasSubstr(first), HasSubstr(second))));
}

// ---- stereo inputs
// -----------------------------------------------------------------------------------------------------

TEST(read_stereo_image, reads_the_lossless_formats_as_red_green_blue) {
  const scratch_folder folder;
  const cv::Mat picture = colour_picture();
  for (const char* name : {"a.png", "a.ppm", "a.bmp", "a.tiff"}) {
    cv::imwrite(folder / name, picture);
    const rgb_image image = read_stereo_image(folder / name);
    ASSERT_EQ(image.width, 40) << name;
    ASSERT_EQ(image.height, 30) << name;
    EXPECT_EQ(image.at(3, 2)[0], 3 * 2 + 31) << name;
    EXPECT_EQ(image.at(3, 2)[1], 14) << name;
    EXPECT_EQ(image.at(3, 2)[2], 15) << name;
    EXPECT_EQ(image.at(39, 29)[2], 195) << name;
  }
}

TEST(read_stereo_image, takes_grey_as_three_equal_colours_and_drops_transparency) {
  const scratch_folder folder;
  const cv::Mat grey(5, 6, CV_8UC1, cv::Scalar(77));
  cv::imwrite(folder / "grey.png", grey);
  cv::imwrite(folder / "grey.pgm", grey);
  cv::imwrite(folder / "alpha.png", cv::Mat(5, 6, CV_8UC4, cv::Scalar(1, 2, 3, 128)));
  for (const char* name : {"grey.png", "grey.pgm"}) {
    const rgb_image image = read_stereo_image(folder / name);
    EXPECT_THAT(std::vector<int>(image.at(5, 4), image.at(5, 4) + 3), ElementsAre(77, 77, 77)) << name;
  }
  const rgb_image image = read_stereo_image(folder / "alpha.png");
  EXPECT_THAT(std::vector<int>(image.at(5, 4), image.at(5, 4) + 3), ElementsAre(3, 2, 1));
}

TEST(read_stereo_image, refuses_what_has_more_than_8_bits) {
  const scratch_folder folder;
  cv::imwrite(folder / "deep.png", cv::Mat(5, 6, CV_16UC3, cv::Scalar(1, 2, 3)));
  cv::imwrite(folder / "deep.pgm", cv::Mat(5, 6, CV_16UC1, cv::Scalar(300)));
  write_file(folder / "real.pfm", pfm_of(disparity_map(2, 2)));
  expect_refusal([&] { (void)read_stereo_image(folder / "deep.png"); }, "deep.png", "16 bits");
  expect_refusal([&] { (void)read_stereo_image(folder / "deep.pgm"); }, "deep.pgm", "16 bits");
  expect_refusal([&] { (void)read_stereo_image(folder / "real.pfm"); }, "real.pfm", "floating-point");
}

TEST(read_stereo_image, refuses_what_is_missing_empty_a_folder_or_no_picture) {
  const scratch_folder folder;
  write_file(folder / "empty.png", "");
  write_file(folder / "text.png", "this is not a picture\n");
  expect_refusal([&] { (void)read_stereo_image(folder / "none.png"); }, "none.png", "No such file or directory");
  expect_refusal([&] { (void)read_stereo_image(folder / "."); }, "is a directory", "image file");
  expect_refusal([&] { (void)read_stereo_image(folder / "empty.png"); }, "empty.png", "is empty");
  expect_refusal([&] { (void)read_stereo_image(folder / "text.png"); }, "text.png", "not a picture");
}

TEST(read_stereo_image, refuses_a_file_cut_short_at_any_part) {
  const scratch_folder folder;
  for (const char* name : {"a.png", "a.ppm", "a.bmp", "a.jpg", "a.tiff"}) {
    cv::imwrite(folder / name, colour_picture());
    const std::string whole = read_file(folder / name);
    EXPECT_NO_THROW((void)read_stereo_image(folder / name)) << name;
    for (int tenth = 1; tenth <= 10; ++tenth) {
      // The last cut takes one picture line's worth of bytes at most.
      const std::size_t size = tenth == 10 ? whole.size() - 20 : whole.size() * static_cast<std::size_t>(tenth) / 10;
      write_file(folder / name, whole.substr(0, size));
      EXPECT_THROW((void)read_stereo_image(folder / name), file_error) << name << " cut to " << size;
    }
  }
}

// ---- PFM
// ---------------------------------------------------------------------------------------------------------------

std::string big_endian_bytes(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    std::uint32_t bits = 0;
    static_assert(sizeof(bits) == sizeof(value));
    std::memcpy(&bits, &value, sizeof(bits));
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
  }
  return bytes;
}

std::string reversed_words(std::string bytes) {
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    std::swap(bytes[i], bytes[i + 3]);
    std::swap(bytes[i + 1], bytes[i + 2]);
  }
  return bytes;
}

TEST(parse_pfm, reads_both_byte_orders_bottom_row_first_without_dividing_by_the_scale) {
  const std::string data = big_endian_bytes({1, 2.5f, 3, 4, 5, 60.25f});
  for (const auto& bytes : {"Pf\n3 2\n2.0\n" + data, "Pf\n3 2\n-0.003922\n" + reversed_words(data)}) {
    const real_map map = parse_pfm(bytes, "test");
    EXPECT_EQ(map.width, 3);
    EXPECT_EQ(map.height, 2);
    EXPECT_THAT(map.values, ElementsAre(4, 5, 60.25, 1, 2.5, 3));
  }
}

TEST(parse_pfm, refuses_what_it_cannot_use_and_says_why) {
  const std::string data = big_endian_bytes({1, 2, 3, 4});
  const std::pair<std::string, const char*> cases[] = {
      {"PF\n2 2\n1\n" + data, "in colour"},
      {"P5\n2 2\n1\n" + data, "does not start with Pf"},
      {"Pf\n2 x\n1\n" + data, "width and height"},
      {"Pf\n2 -2\n1\n" + data, "width and height"},
      {"Pf\n0 2\n1\n" + data, "width and height"},
      {"Pf\n2 2\n0\n" + data, "scale"},
      {"Pf\n2 2\nnan\n" + data, "scale"},
      {"Pf\n2 2", "scale"},
      {"Pf\n2 2\n1", "cut short"},
      {"Pf\n2 2\n1\n" + data.substr(0, 15), "2x2 pixels need 16 bytes"},
      {"Pf\n2000000000 2000000000\n1\n" + data, "cut short"},
  };
  for (const auto& [bytes, reason] : cases)
    expect_refusal([&] { (void)parse_pfm(bytes, "map.pfm"); }, "map.pfm", reason);
}

// ---- writers
// -----------------------------------------------------------------------------------------------------------

/// 3x2: defined 0, 1, 127 / undefined, 5, undefined.
disparity_map small_map() {
  disparity_map map(3, 2);
  map.disparity = {0, 1, 127, 0, 5, 0};
  map.defined = {1, 1, 1, 0, 1, 0};
  return map;
}

TEST(png_of, keeps_colours_and_masks) {
  const scratch_folder folder;
  rgb_image image(2, 1);
  image.pixels = {1, 2, 3, 253, 254, 255};
  write_file(folder / "image.png", png_of(image));
  EXPECT_EQ(read_stereo_image(folder / "image.png").pixels, image.pixels);
  const pixel_mask mask{3, 1, {true, false, true}};
  write_file(folder / "mask.png", png_of(mask));
  EXPECT_EQ(read_mask(folder / "mask.png").selected, mask.selected);
}

TEST(pfm_of, writes_real_values_with_infinity_for_unknown) {
  const real_map map{2, 2, {0.5, std::nan(""), -3, 1e6}};
  EXPECT_THAT(parse_pfm(pfm_of(map), "").values, ElementsAre(0.5, std::numeric_limits<double>::infinity(), -3, 1e6));
}

TEST(pfm_of, writes_plain_values_with_infinity_for_undefined) {
  const std::string bytes = pfm_of(small_map());
  EXPECT_TRUE(bytes.starts_with("Pf\n3 2\n-1.0\n"));
  EXPECT_EQ(bytes.size(), std::string("Pf\n3 2\n-1.0\n").size() + 24);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(parse_pfm(bytes, "").values, ElementsAre(0, 1, 127, infinity, 5, infinity));
}

TEST(png_of, writes_16_bits_with_0_for_undefined_and_1_for_a_defined_0) {
  const std::string bytes = png_of(small_map());
  const cv::Mat picture = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.type(), CV_16UC1);
  EXPECT_THAT(std::vector<int>(picture.begin<std::uint16_t>(), picture.end<std::uint16_t>()),
              ElementsAre(1, 256, 127 * 256, 0, 5 * 256, 0));
}

TEST(pgm_of, writes_8_bits_with_255_for_undefined) {
  EXPECT_EQ(pgm_of(small_map()), std::string("P5\n3 2\n255\n") + std::string("\x00\x01\x7f\xff\x05\xff", 6));
}

TEST(encode_map, goes_by_the_extension_in_any_case) {
  EXPECT_EQ(encode_map(small_map(), "x/y.pfm"), pfm_of(small_map()));
  EXPECT_EQ(encode_map(small_map(), "y.PNG"), png_of(small_map()));
  EXPECT_EQ(encode_map(small_map(), "y.pgm"), pgm_of(small_map()));
  for (const char* name : {"y.jpg", "y", "pfm", "y.pfm.gz"}) {
    expect_refusal([&] { (void)encode_map(small_map(), name); }, name, ".pfm, .png (16 bit) or .pgm");
  }
}

TEST(picture_of, shows_undefined_pixels_black_and_no_defined_one) {
  const std::string bytes = picture_of(small_map(), 128);
  const cv::Mat picture = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.type(), CV_8UC3);
  const disparity_map map = small_map();
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      const bool black = picture.at<cv::Vec3b>(y, x) == cv::Vec3b(0, 0, 0);
      EXPECT_EQ(black, map.defined[map.index(x, y)] == 0) << x << "," << y;
    }
  }
  const cv::Vec3b near_colour = picture.at<cv::Vec3b>(0, 2);  // disparity 127 of 0..127: red end
  EXPECT_GT(near_colour[2], near_colour[0]);
  EXPECT_NO_THROW((void)picture_of(small_map(), 1));
}

// ---- truth and masks
// ---------------------------------------------------------------------------------------------------

MATCHER(is_unknown, "") { return std::isnan(arg); }

TEST(read_truth, divides_pictures_by_the_scale_and_takes_0_as_unknown) {
  const scratch_folder folder;
  const cv::Mat eight = (cv::Mat_<std::uint8_t>(1, 4) << 0, 1, 6, 255);
  cv::imwrite(folder / "t.png", eight);
  cv::imwrite(folder / "t.pgm", eight);
  for (const char* name : {"t.png", "t.pgm"}) {
    EXPECT_THAT(read_truth(folder / name, 4).values, ElementsAre(is_unknown(), 0.25, 1.5, 63.75)) << name;
    EXPECT_THAT(read_truth(folder / name).values, ElementsAre(is_unknown(), 1, 6, 255)) << name;
  }
  const cv::Mat sixteen = (cv::Mat_<std::uint16_t>(1, 3) << 0, 128, 5120);
  cv::imwrite(folder / "t16.png", sixteen);
  EXPECT_THAT(read_truth(folder / "t16.png").values, ElementsAre(is_unknown(), 0.5, 20));
  EXPECT_THAT(read_truth(folder / "t16.png", 128).values, ElementsAre(is_unknown(), 1, 40));
}

TEST(read_truth, reads_pfm_with_every_value_that_is_not_finite_as_unknown) {
  const scratch_folder folder;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  write_file(folder / "t.pfm", "Pf\n5 1\n0.5\n" + big_endian_bytes({0, infinity, -infinity, std::nanf(""), 8}));
  EXPECT_THAT(read_truth(folder / "t.pfm").values, ElementsAre(0, is_unknown(), is_unknown(), is_unknown(), 8));
  EXPECT_THAT(read_truth(folder / "t.pfm", 2).values, ElementsAre(0, is_unknown(), is_unknown(), is_unknown(), 4));
}

TEST(read_truth, takes_a_grey_picture_saved_in_colour_but_no_colour_picture) {
  const scratch_folder folder;
  cv::imwrite(folder / "grey.png", cv::Mat(1, 2, CV_8UC3, cv::Scalar(9, 9, 9)));
  cv::imwrite(folder / "colour.png", cv::Mat(1, 2, CV_8UC3, cv::Scalar(9, 8, 9)));
  EXPECT_THAT(read_truth(folder / "grey.png").values, ElementsAre(9, 9));
  expect_refusal([&] { (void)read_truth(folder / "colour.png"); }, "colour.png", "in colour");
}

TEST(read_truth, refuses_what_is_missing_damaged_or_scaled_by_nothing) {
  const scratch_folder folder;
  cv::imwrite(folder / "t.png", cv::Mat(1, 2, CV_8UC1, cv::Scalar(9)));
  write_file(folder / "bad.pfm", "Pf\n9 9\n1\nabc");
  expect_refusal([&] { (void)read_truth(folder / "none.png"); }, "none.png", "No such file");
  expect_refusal([&] { (void)read_truth(folder / "bad.pfm"); }, "bad.pfm", "cut short");
  for (const double scale : {0.0, -4.0, std::nan("")}) {
    expect_refusal([&] { (void)read_truth(folder / "t.png", scale); }, "t.png", "not above 0");
  }
}

TEST(read_mask, selects_pixels_that_are_255) {
  const scratch_folder folder;
  const cv::Mat stored = (cv::Mat_<std::uint8_t>(1, 4) << 0, 128, 255, 254);
  cv::imwrite(folder / "m.png", stored);
  EXPECT_THAT(read_mask(folder / "m.png").selected, ElementsAre(false, false, true, false));
}

TEST(read_mask, refuses_what_selects_nothing_or_is_no_mask) {
  const scratch_folder folder;
  cv::imwrite(folder / "m.png", cv::Mat(2, 2, CV_8UC1, cv::Scalar(1)));
  cv::imwrite(folder / "deep.png", cv::Mat(2, 2, CV_16UC1, cv::Scalar(255)));
  cv::imwrite(folder / "colour.png", cv::Mat(2, 2, CV_8UC3, cv::Scalar(255, 0, 0)));
  expect_refusal([&] { (void)read_mask(folder / "m.png"); }, "m.png", "selects no pixel");
  expect_refusal([&] { (void)read_mask(folder / "deep.png"); }, "deep.png", "8-bit");
  expect_refusal([&] { (void)read_mask(folder / "colour.png"); }, "colour.png", "in colour");
}

}  // namespace
}  // namespace epiline::eval
