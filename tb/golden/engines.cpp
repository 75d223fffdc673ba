#include "golden/engines.hpp"

#include <chrono>

#include "golden/color_fuzzy.hpp"

namespace epiline::golden {
namespace {

colour_image planes_of(const eval::rgb_image& image) {
  using channel = Eigen::Map<const plane<std::uint8_t>, Eigen::Unaligned, Eigen::Stride<Eigen::Dynamic, 3>>;
  const auto colour = [&](int offset) {
    return channel(image.pixels.data() + offset, image.height, image.width,
                   Eigen::Stride<Eigen::Dynamic, 3>(3 * Eigen::Index{image.width}, 3));
  };
  return {colour(0), colour(1), colour(2)};
}

eval::disparity_map map_of(const disparity_plane& planes) {
  eval::disparity_map map(static_cast<int>(planes.defined.cols()), static_cast<int>(planes.defined.rows()));
  std::copy_n(planes.disparity.data(), planes.disparity.size(), map.disparity.begin());
  std::copy_n(planes.defined.data(), planes.defined.size(), map.defined.begin());
  return map;
}

class color_fuzzy_engine final : public eval::engine {
 public:
  eval::match_result match(const eval::match_request& request, const eval::run_options& /*options*/) override {
    const color_fuzzy_parameters parameters{
        .levels = request.levels,
        .left_right = request.parameters.at("left_right") != 0,
        .uniqueness = request.parameters.at("uniqueness"),
        .fuzzy = request.parameters.at("fuzzy"),
        .careful_fill = request.parameters.at("careful_fill") != 0,
    };
    const auto start = std::chrono::steady_clock::now();
    eval::match_result result;
    result.map = map_of(color_fuzzy(planes_of(request.left), planes_of(request.right), parameters));
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }
};

}  // namespace

void register_engines(eval::engine_registry& registry) {
  registry.add({"color_fuzzy", "golden", "reference model, whole image, written from the equations",
                [](const eval::design_description&) { return std::make_unique<color_fuzzy_engine>(); }});
}

}  // namespace epiline::golden
