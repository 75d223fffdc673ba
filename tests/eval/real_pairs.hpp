#pragma once
// The shared stereo pairs, for tests that use them when they are on the machine.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "eval/designs.hpp"
#include "eval/image_files.hpp"
#include "eval/metrics.hpp"

namespace epiline::test {

inline constexpr const char* real_scenes[] = {"tsukuba", "venus", "cones", "teddy", "aloe", "motorcycle"};

struct real_pair {
  int levels = 0;
  eval::rgb_image left;
  eval::rgb_image right;
  eval::ground_truth truth;
  std::optional<eval::real_map> right_truth;
  nlohmann::json figures;           // of the reference maps, by map name
  std::filesystem::path reference;  // folder of the reference maps
};

/// The folder of pairs: EPILINE_DATA, else the shared one beside the repository.
inline std::filesystem::path data_folder() {
  if (const char* data = std::getenv("EPILINE_DATA"); data != nullptr && *data != '\0') return data;
  return std::filesystem::path(EPILINE_SOURCE_DIR) / "../shared/data";
}

/// The file of `folder` with that stem, whatever its extension; empty when there is none.
inline std::filesystem::path file_with_stem(const std::filesystem::path& folder, const std::string& stem) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().stem() == stem) return entry.path();
  }
  return {};
}

/// Empty when the pair or its reference maps are not on this machine.
inline std::optional<real_pair> find_real_pair(const std::string& scene) {
  const auto folder = data_folder() / scene;
  const auto reference = data_folder() / "../reference";
  if (!std::filesystem::exists(folder) || !std::filesystem::exists(reference / scene)) return std::nullopt;
  real_pair pair;
  std::optional<double> scale;
  std::ifstream pairs_file(data_folder() / "pairs.json");
  for (const auto& entry : nlohmann::json::parse(pairs_file)) {
    if (entry["scene"] != scene) continue;
    pair.levels = entry["levels"];
    if (!entry["truth_scale"].is_null()) scale = entry["truth_scale"].get<double>();
  }
  if (pair.levels == 0) throw std::runtime_error(scene + " is not in pairs.json");
  pair.left = eval::read_stereo_image(file_with_stem(folder, "left"));
  pair.right = eval::read_stereo_image(file_with_stem(folder, "right"));
  pair.truth.disparity = eval::read_truth(file_with_stem(folder, "disp_left"), scale);
  for (const auto& [mask, stems] : {std::pair{&pair.truth.evaluated, std::pair{"mask_all", "mask_all"}},
                                    {&pair.truth.non_occluded, {"mask_nonocc", "mask_nonocc_left"}}}) {
    for (const char* stem : {stems.first, stems.second}) {
      if (const auto file = file_with_stem(folder, stem); !file.empty()) *mask = eval::read_mask(file);
    }
  }
  if (const auto file = file_with_stem(folder, "disp_right"); !file.empty()) {
    pair.right_truth = eval::read_truth(file, scale);
  }
  std::ifstream figures_file(reference / "figures.json");
  pair.figures = nlohmann::json::parse(figures_file)[scene]["maps"];
  pair.reference = reference / scene;
  return pair;
}

/// A reference map: 8 bits, 255 = undefined.
inline eval::disparity_map read_reference_map(const std::filesystem::path& file) {
  const eval::rgb_image stored = eval::read_stereo_image(file);
  eval::disparity_map map(stored.width, stored.height);
  for (std::size_t i = 0; i < map.defined.size(); ++i) {
    map.defined[i] = stored.pixels[3 * i] == 255 ? 0 : 1;
    map.disparity[i] = map.defined[i] != 0 ? stored.pixels[3 * i] : 0;
  }
  return map;
}

/// A reference map and how to get it.
struct reference_case {
  const char* design;
  const char* map;                 // stem of its file, name in figures.json
  eval::parameter_values changed;  // parameters that do not have their default
};
inline const reference_case reference_cases[] = {
    {"color_fuzzy", "color_fuzzy-raw", {{"left_right", 0}, {"uniqueness", 0}, {"fuzzy", 0}}},
    {"color_fuzzy", "color_fuzzy-confident", {{"fuzzy", 0}}},
    {"color_fuzzy", "color_fuzzy", {}},
    {"adaptive_ca", "adaptive_ca-off", {{"automaton", 0}}},
    {"adaptive_ca", "adaptive_ca-r1", {{"ring", 1}}},
    {"adaptive_ca", "adaptive_ca-r20", {{"ring", 20}}},
    {"adaptive_ca", "adaptive_ca-r24", {}},
};

}  // namespace epiline::test
