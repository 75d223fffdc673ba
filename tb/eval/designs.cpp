#include "eval/designs.hpp"

#include <algorithm>
#include <numeric>

namespace epiline::eval {
namespace {

constexpr parameter_description color_fuzzy_parameters[] = {
    {"left_right", 0, 1, 1, "keep a pixel only if the right image's winner agrees within 1"},
    {"uniqueness", 0, 31, 17, "keep it only if 16 * second minimum >= uniqueness * minimum; 0 = off"},
    {"fuzzy", 0, 2, 2, "passes of the fuzzy filter"},
    {"careful_fill", 0, 1, 0, "the filter fills a pixel only between two defined neighbours that agree"},
};

constexpr parameter_description adaptive_ca_parameters[] = {
    {"t2", 0, 255, 32, "grey levels of local variation in 2x2 pixels above which the window is 3x3 (4 * t2 in sum)"},
    {"t5", 0, 3182, 100, "the same in 5x5 pixels above which it is 5x5, else 7x7 (25 * t5 in sum)"},
    {"automaton", 0, 1, 1, "filter the map with the cellular automaton"},
    {"ring", 1, 40, 24, "how many of the 40 pixels around must agree with the automaton's choice"},
};

constexpr design_description designs[] = {
    {.name = "color_fuzzy",
     .meaning = "method 2: colour SAD 7x7, left-right check and uniqueness, fuzzy inference",
     .max_width = 1024,
     .max_height = 4095,
     .max_levels = 80,
     .default_levels = 80,
     .pixels_per_beat = 1,
     .parameters = color_fuzzy_parameters},
    {.name = "adaptive_ca",
     .meaning = "method 1: grey SAD, window chosen by local variation, cellular automaton",
     .max_width = 1024,
     .max_height = 4095,
     .max_levels = 80,
     .default_levels = 80,
     .pixels_per_beat = 1,
     .parameters = adaptive_ca_parameters},
    {.name = "color_fuzzy_p2",
     .meaning = "color_fuzzy with two pixels a clock",
     .max_width = 1024,
     .max_height = 4095,
     .max_levels = 80,
     .default_levels = 80,
     .pixels_per_beat = 2,
     .parameters = color_fuzzy_parameters,
     .same_maps_as = "color_fuzzy"},
    {.name = "adaptive_ca_p2",
     .meaning = "adaptive_ca with two pixels a clock",
     .max_width = 1024,
     .max_height = 4095,
     .max_levels = 80,
     .default_levels = 80,
     .pixels_per_beat = 2,
     .parameters = adaptive_ca_parameters,
     .same_maps_as = "adaptive_ca"},
    {.name = "color_fuzzy_hx8k",
     .meaning = "color_fuzzy for a small device: 160x120, 16 levels, eight clocks a pixel",
     .max_width = 160,
     .max_height = 120,
     .max_levels = 16,
     .default_levels = 16,
     .pixels_per_beat = 1,
     .parameters = color_fuzzy_parameters,
     .same_maps_as = "color_fuzzy"},
};

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::span<const design_description> all_designs() { return designs; }

const design_description* find_design(std::string_view name) {
  const auto found = std::ranges::find(designs, name, &design_description::name);
  return found == std::end(designs) ? nullptr : &*found;
}

const parameter_description* find_parameter(const design_description& design, std::string_view name) {
  const auto found = std::ranges::find(design.parameters, name, &parameter_description::name);
  return found == design.parameters.end() ? nullptr : &*found;
}

parameter_values default_parameters(const design_description& design) {
  parameter_values values;
  for (const auto& parameter : design.parameters) values.emplace(parameter.name, parameter.default_value);
  return values;
}

std::string_view closest_name(std::string_view name, std::span<const std::string_view> known) {
  // Up to a third of the letters may be wrong; beyond that a suggestion misleads.
  std::size_t nearest = std::max<std::size_t>(1, name.size() / 3) + 1;
  std::string_view best;
  for (const auto candidate : known) {
    if (const auto distance = edit_distance(name, candidate); distance < nearest) {
      nearest = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace epiline::eval
