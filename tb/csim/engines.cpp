#include "csim/engines.hpp"

#include <chrono>

#include "csim/native_top.hpp"
#include "tops/color_fuzzy.hpp"

// The top itself, from hls/tops/color_fuzzy.cpp; tops that only the compiler calls need no declaration in a header.
void color_fuzzy(
    hls::stream<epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::video_beat>& left,
    hls::stream<epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::video_beat>& right,
    hls::stream<epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::disparity_beat>& disparity,
    epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::width_t width,
    epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::height_t height,
    epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>::levels_t levels, ap_uint<1> left_right,
    ap_uint<5> uniqueness, ap_uint<2> fuzzy, ap_uint<1> careful_fill);

namespace epiline::csim {
namespace {

class color_fuzzy_engine final : public eval::engine {
 public:
  explicit color_fuzzy_engine(const eval::design_description& design) {
    using config = tops::color_fuzzy_config;
    if (design.max_width != config::max_width || design.max_height != config::max_height ||
        design.max_levels != config::levels || design.pixels_per_beat != config::pixels_per_beat) {
      throw std::logic_error("the table of designs does not describe hls/tops/color_fuzzy.cpp");
    }
  }

  eval::match_result match(const eval::match_request& request, const eval::run_options& /*options*/) override {
    using types = tops::color_fuzzy_interface<tops::color_fuzzy_config>;
    const auto parameter = [&](const char* name) { return request.parameters.at(name); };
    const auto start = std::chrono::steady_clock::now();
    eval::match_result result;
    result.map = run_native_top<types>(request.left, request.right, [&](auto& left, auto& right, auto& disparity) {
      color_fuzzy(left, right, disparity, request.left.width, request.left.height, request.levels,
                  parameter("left_right"), parameter("uniqueness"), parameter("fuzzy"), parameter("careful_fill"));
    });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }
};

}  // namespace

void register_engines(eval::engine_registry& registry) {
  registry.add({"color_fuzzy", "native", "the hardware's C++ source, run as a program",
                [](const eval::design_description& design) { return std::make_unique<color_fuzzy_engine>(design); }});
}

}  // namespace epiline::csim
