#include "golden/engines.hpp"

#include <chrono>

#include "golden/adaptive_ca.hpp"
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

disparity_plane run_color_fuzzy(const eval::match_request& request) {
  return color_fuzzy(planes_of(request.left), planes_of(request.right),
                     {
                         .levels = request.levels,
                         .left_right = request.parameters.at("left_right") != 0,
                         .uniqueness = request.parameters.at("uniqueness"),
                         .fuzzy = request.parameters.at("fuzzy"),
                         .careful_fill = request.parameters.at("careful_fill") != 0,
                     });
}

disparity_plane run_adaptive_ca(const eval::match_request& request) {
  return adaptive_ca(planes_of(request.left), planes_of(request.right),
                     {
                         .levels = request.levels,
                         .t2 = request.parameters.at("t2"),
                         .t5 = request.parameters.at("t5"),
                         .automaton = request.parameters.at("automaton") != 0,
                         .ring = request.parameters.at("ring"),
                     });
}

class golden_engine final : public eval::engine {
 public:
  using reference_model = disparity_plane (*)(const eval::match_request&);
  explicit golden_engine(reference_model model) : model_(model) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& /*options*/) override {
    const auto start = std::chrono::steady_clock::now();
    eval::match_result result;
    result.map = map_of(model_(request));
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  reference_model model_;
};

}  // namespace

void register_engines(eval::engine_registry& registry) {
  const auto add = [&](const char* design, golden_engine::reference_model model) {
    registry.add({design, "golden", "reference model, whole image, written from the equations",
                  [model](const eval::design_description&) { return std::make_unique<golden_engine>(model); }});
  };
  for (const char* design : {"color_fuzzy", "color_fuzzy_p2", "color_fuzzy_hx8k"}) add(design, run_color_fuzzy);
  for (const char* design : {"adaptive_ca", "adaptive_ca_p2"}) add(design, run_adaptive_ca);
}

}  // namespace epiline::golden
