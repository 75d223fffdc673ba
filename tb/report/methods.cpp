#include "report/methods.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace epiline::report {
namespace {

struct setting {
  std::string_view name;
  int value;
};

/// A design with some parameters set and the others at their defaults.
struct variant {
  std::string_view design;
  std::string_view id;
  std::string_view title;
  bool pictured;
  bool final;
  std::vector<setting> settings;
};

/// The one table of variants. Before the filter, after it, and steps between.
const std::vector<variant>& variants() {
  static const std::vector<variant> table = {
      {"adaptive_ca", "off", "Method 1, no automaton", true, false, {{"automaton", 0}}},
      {"adaptive_ca", "r1", "Method 1, automaton, R = 1 (paper)", false, false, {{"automaton", 1}, {"ring", 1}}},
      {"adaptive_ca", "r20", "Method 1, automaton, R = 20", false, false, {{"automaton", 1}, {"ring", 20}}},
      {"adaptive_ca", "r24", "Method 1, automaton, R = 24", true, true, {{"automaton", 1}, {"ring", 24}}},
      {"color_fuzzy", "raw", "Method 2, raw winner", true, false, {{"left_right", 0}, {"uniqueness", 0}, {"fuzzy", 0}}},
      {"color_fuzzy", "confident", "Method 2, with confidence, no FIS", true, false, {{"fuzzy", 0}}},
      {"color_fuzzy", "fis", "Method 2, with confidence and FIS twice", true, true, {}},
  };
  return table;
}

}  // namespace

std::vector<method> methods_of(const eval::design_description& design, const eval::engine_registry::entry& engine) {
  std::vector<method> methods;
  for (const auto& entry : variants()) {
    if (entry.design != design.name) continue;
    method made;
    made.id = fmt::format("{}-{}", design.name, entry.id);
    made.title = entry.title;
    made.design = &design;
    made.engine = &engine;
    made.parameters = eval::default_parameters(design);
    for (const auto& [name, value] : entry.settings) {
      if (eval::find_parameter(design, name) == nullptr) {
        throw std::logic_error(fmt::format("variant {} sets {}, which design {} has not", made.id, name, design.name));
      }
      made.parameters[std::string(name)] = value;
    }
    made.pictured = entry.pictured;
    made.final = entry.final;
    methods.push_back(std::move(made));
  }
  if (methods.empty()) {
    method made;
    made.id = std::string(design.name);
    made.title = fmt::format("{}, defaults", design.name);
    made.design = &design;
    made.engine = &engine;
    made.parameters = eval::default_parameters(design);
    methods.push_back(std::move(made));
  }
  for (auto& made : methods) {
    std::vector<std::string> texts;
    for (const auto& [name, value] : made.parameters) texts.push_back(fmt::format("{} {}", name, value));
    made.settings = fmt::format("{}: {}", design.name, fmt::join(texts, ", "));
  }
  return methods;
}

std::vector<method> opencv_methods() {
  method block_matching;
  block_matching.id = "opencv-stereobm";
  block_matching.title = "OpenCV StereoBM 11x11";
  block_matching.matcher = opencv::matcher::block_matching;
  method semi_global;
  semi_global.id = "opencv-stereosgbm";
  semi_global.title = "OpenCV StereoSGBM, 8 paths";
  semi_global.matcher = opencv::matcher::semi_global;
  for (auto* made : {&block_matching, &semi_global}) made->settings = opencv::parameters_of(made->matcher);
  return {block_matching, semi_global};
}

}  // namespace epiline::report
