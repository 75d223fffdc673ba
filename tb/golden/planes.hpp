#pragma once
// What the reference models have in common: pictures as arrays, and sums over windows of them.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

namespace epiline::golden {

/// One value a pixel; rows() is the height, cols() the width.
template <class T>
using plane = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct colour_image {
  plane<std::uint8_t> red;
  plane<std::uint8_t> green;
  plane<std::uint8_t> blue;
};

/// Disparities with a valid bit; the disparity of an undefined pixel is 0.
struct disparity_plane {
  plane<std::uint8_t> disparity;
  plane<bool> defined;
};

/// |left(x) - right(max(x - d, 0))| of one colour, d >= 0.
[[nodiscard]] inline plane<std::int16_t> absolute_difference(const plane<std::uint8_t>& left,
                                                             const plane<std::uint8_t>& right, Eigen::Index d) {
  const Eigen::Index clamped = std::min(d, left.cols());
  plane<std::int16_t> matching(left.rows(), left.cols());
  matching.leftCols(clamped) = right.col(0).cast<std::int16_t>().replicate(1, clamped);
  matching.rightCols(left.cols() - clamped) = right.leftCols(left.cols() - clamped).cast<std::int16_t>();
  return (left.cast<std::int16_t>() - matching).abs();
}

/// Sum over a centred square of `window` rows and columns, `window` odd; values outside the image are 0.
template <class T>
[[nodiscard]] plane<T> window_sum(const plane<T>& values, int window) {
  const Eigen::Index rows = values.rows();
  const Eigen::Index columns = values.cols();
  const Eigen::Index reach = window / 2;
  plane<T> above_and_below = plane<T>::Zero(rows + window - 1, columns);
  above_and_below.middleRows(reach, rows) = values;
  plane<T> beside = plane<T>::Zero(rows, columns + window - 1);
  for (int k = 0; k < window; ++k) beside.middleCols(reach, columns) += above_and_below.middleRows(k, rows);
  plane<T> sum = plane<T>::Zero(rows, columns);
  for (int k = 0; k < window; ++k) sum += beside.middleCols(k, columns);
  return sum;
}

}  // namespace epiline::golden
