#include "csim/engines.hpp"

#include <chrono>

#include "csim/native_top.hpp"
#include "tops/adaptive_ca.hpp"
#include "tops/color_fuzzy.hpp"
#include "tops/color_fuzzy_hx8k.hpp"

namespace {
using color_fuzzy_types = epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_config>;
using adaptive_ca_types = epiline::tops::adaptive_ca_interface<epiline::tops::adaptive_ca_config>;
using color_fuzzy_p2_config = epiline::tops::two_pixels_a_beat_of<epiline::tops::color_fuzzy_config>;
using adaptive_ca_p2_config = epiline::tops::two_pixels_a_beat_of<epiline::tops::adaptive_ca_config>;
using color_fuzzy_p2_types = epiline::tops::color_fuzzy_interface<color_fuzzy_p2_config>;
using color_fuzzy_hx8k_types = epiline::tops::color_fuzzy_interface<epiline::tops::color_fuzzy_hx8k_config>;
using adaptive_ca_p2_types = epiline::tops::adaptive_ca_interface<adaptive_ca_p2_config>;

template <class Types>
using color_fuzzy_top = void(hls::stream<typename Types::video_beat>& left,
                             hls::stream<typename Types::video_beat>& right,
                             hls::stream<typename Types::disparity_beat>& disparity, typename Types::width_t width,
                             typename Types::height_t height, typename Types::levels_t levels, ap_uint<1> left_right,
                             ap_uint<5> uniqueness, ap_uint<2> fuzzy, ap_uint<1> careful_fill);
template <class Types>
using adaptive_ca_top = void(hls::stream<typename Types::video_beat>& left,
                             hls::stream<typename Types::video_beat>& right,
                             hls::stream<typename Types::disparity_beat>& disparity, typename Types::width_t width,
                             typename Types::height_t height, typename Types::levels_t levels, typename Types::t2_t t2,
                             typename Types::t5_t t5, ap_uint<1> automaton, typename Types::ring_t ring);
}  // namespace

// The tops themselves, from hls/tops/*.cpp; tops that only the compiler calls need no declaration in a header.
color_fuzzy_top<color_fuzzy_types> color_fuzzy;
color_fuzzy_top<color_fuzzy_p2_types> color_fuzzy_p2;
color_fuzzy_top<color_fuzzy_hx8k_types> color_fuzzy_hx8k;
adaptive_ca_top<adaptive_ca_types> adaptive_ca;
adaptive_ca_top<adaptive_ca_p2_types> adaptive_ca_p2;

namespace epiline::csim {
namespace {

/// Runs a top on one frame; `call` passes the request's parameters on. Types: the top's interface.
template <class Types>
using top_call = void (*)(const eval::match_request& request, hls::stream<typename Types::video_beat>& left,
                          hls::stream<typename Types::video_beat>& right,
                          hls::stream<typename Types::disparity_beat>& disparity);

template <class Config, class Types>
class native_engine final : public eval::engine {
 public:
  native_engine(const eval::design_description& design, top_call<Types> call) : call_(call) {
    if (design.max_width != Config::max_width || design.max_height != Config::max_height ||
        design.max_levels != Config::levels || design.pixels_per_beat != Config::pixels_per_beat) {
      throw std::logic_error("the table of designs does not describe hls/tops/" + std::string(design.name) + ".cpp");
    }
  }

  eval::match_result match(const eval::match_request& request, const eval::run_options& /*options*/) override {
    const auto start = std::chrono::steady_clock::now();
    eval::match_result result;
    result.map = run_native_top<Types>(request.left, request.right, [&](auto& left, auto& right, auto& disparity) {
      call_(request, left, right, disparity);
    });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  top_call<Types> call_;
};

template <class Config, class Types>
void add(eval::engine_registry& registry, const char* design, top_call<Types> call) {
  registry.add({design, "native", "the hardware's C++ source, run as a program",
                [call](const eval::design_description& description) {
                  return std::make_unique<native_engine<Config, Types>>(description, call);
                }});
}

template <class Config, color_fuzzy_top<tops::color_fuzzy_interface<Config>> Top>
void add_color_fuzzy(eval::engine_registry& registry, const char* design) {
  add<Config, tops::color_fuzzy_interface<Config>>(
      registry, design, [](const eval::match_request& request, auto& left, auto& right, auto& disparity) {
        const auto& with = request.parameters;
        Top(left, right, disparity, request.left.width, request.left.height, request.levels, with.at("left_right"),
            with.at("uniqueness"), with.at("fuzzy"), with.at("careful_fill"));
      });
}

template <class Config, adaptive_ca_top<tops::adaptive_ca_interface<Config>> Top>
void add_adaptive_ca(eval::engine_registry& registry, const char* design) {
  add<Config, tops::adaptive_ca_interface<Config>>(
      registry, design, [](const eval::match_request& request, auto& left, auto& right, auto& disparity) {
        const auto& with = request.parameters;
        Top(left, right, disparity, request.left.width, request.left.height, request.levels, with.at("t2"),
            with.at("t5"), with.at("automaton"), with.at("ring"));
      });
}

}  // namespace

void register_engines(eval::engine_registry& registry) {
  add_color_fuzzy<tops::color_fuzzy_config, color_fuzzy>(registry, "color_fuzzy");
  add_adaptive_ca<tops::adaptive_ca_config, adaptive_ca>(registry, "adaptive_ca");
  add_color_fuzzy<color_fuzzy_p2_config, color_fuzzy_p2>(registry, "color_fuzzy_p2");
  add_color_fuzzy<tops::color_fuzzy_hx8k_config, color_fuzzy_hx8k>(registry, "color_fuzzy_hx8k");
  add_adaptive_ca<adaptive_ca_p2_config, adaptive_ca_p2>(registry, "adaptive_ca_p2");
}

}  // namespace epiline::csim
