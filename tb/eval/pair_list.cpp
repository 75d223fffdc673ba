#include "eval/pair_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "eval/json_place.hpp"
#include "eval/truth_masks.hpp"

namespace epiline::eval {
namespace {

namespace fs = std::filesystem;

// ---- the list ----

/// Names that stay in the folder they are looked for in.
std::string plain_name(const json_place& place, std::string name) {
  if (name.find('/') != std::string::npos || name == "." || name == "..") {
    place.fail(fmt::format("'{}' is not a plain name", name));
  }
  return name;
}

pair_entry entry_of(const json_place& place) {
  place.require_object({"scene", "family", "levels", "truth_scale", "files", "sources"});
  pair_entry entry;
  const auto scene = place.field("scene");
  entry.scene = plain_name(scene, scene.text());
  if (place.has("family")) entry.family = place.field("family").text();
  entry.levels = place.field("levels").whole_number(1, largest_levels);
  if (const auto scale = place.field("truth_scale"); !scale.value().is_null()) {
    entry.truth_scale = scale.positive_number("a number above 0 (grey levels a pixel of disparity), or null for PFM");
  }
  const auto files = place.field("files");
  files.require(files.value().is_object(), "an object of file names and their SHA-256");
  for (const auto& [name, sum] : files.value().items()) {
    const auto file = files.field(name);
    (void)file.text();
    entry.files.push_back(plain_name(file, name));
  }
  if (!place.has("sources")) return entry;
  const auto sources = place.field("sources");
  sources.require(sources.value().is_object(), "an object of file names and where they come from");
  for (const auto& [name, source] : sources.value().items()) {
    const auto from = sources.field(name);
    from.require_object({"url", "member", "package", "path", "convert", "optional"});
    if (!from.has("optional")) continue;
    const auto optional = from.field("optional");
    optional.require(optional.value().is_boolean(), "true or false");
    if (optional.value().get<bool>()) entry.optional_files.push_back(name);
  }
  return entry;
}

// ---- a pair ----

/// The files of one pair.
class pair_files {
 public:
  pair_files(const pair_entry& entry, fs::path folder) : entry_(entry), folder_(std::move(folder)) {
    for (const auto& file : fs::directory_iterator(folder_)) present_.push_back(file.path().filename().string());
    std::ranges::sort(present_);
  }

  /// The file of that stem, empty if there is none. Throws when the list promises one that is not there.
  [[nodiscard]] fs::path find(std::string_view stem) const {
    const auto has_stem = [&](const fs::path& name) { return name.stem() == stem; };
    const auto listed = std::ranges::find_if(entry_.files, has_stem);
    if (listed != entry_.files.end() && std::ranges::find(present_, *listed) != present_.end())
      return folder_ / *listed;
    const auto other = std::ranges::find_if(present_, has_stem);
    if (other != present_.end()) return folder_ / *other;
    if (listed != entry_.files.end() &&
        std::ranges::find(entry_.optional_files, *listed) == entry_.optional_files.end()) {
      throw file_error(
          fmt::format("{} is missing, which the list of pairs names; fetch it again (scripts/fetch_data.py {})",
                      (folder_ / *listed).string(), entry_.scene));
    }
    return {};
  }

  [[nodiscard]] fs::path require(std::string_view stem) const {
    fs::path file = find(stem);
    if (file.empty()) throw file_error(fmt::format("{} has no {} image ({}.*)", folder_.string(), stem, stem));
    return file;
  }

 private:
  const pair_entry& entry_;
  fs::path folder_;
  std::vector<std::string> present_;
};

template <class Picture>
void require_size_of_image(const fs::path& file, const Picture& picture, const rgb_image& image) {
  if (picture.width == image.width && picture.height == image.height) return;
  throw file_error(fmt::format("{} is {}x{}, but the left image is {}x{}: they must have one size", file.string(),
                               picture.width, picture.height, image.width, image.height));
}

real_map truth_of(const fs::path& file, const pair_entry& entry, const rgb_image& image) {
  const bool is_pfm = file.extension() == ".pfm" || file.extension() == ".PFM";
  if (is_pfm && entry.truth_scale && *entry.truth_scale != 1) {
    throw file_error(fmt::format("{} is PFM, which holds pixels, but the list states truth_scale {}: write null",
                                 file.string(), *entry.truth_scale));
  }
  if (!is_pfm && !entry.truth_scale) {
    throw file_error(
        fmt::format("{} holds grey levels, but the list states no truth_scale: write how many grey levels "
                    "a pixel of disparity is",
                    file.string()));
  }
  real_map truth = read_truth(file, entry.truth_scale);
  require_size_of_image(file, truth, image);
  return truth;
}

/// How well right pixels at x - factor * truth agree with left ones: mean absolute difference of a colour.
std::optional<double> colour_difference(const stereo_pair& pair, const real_map& truth, double factor) {
  double sum = 0;
  std::size_t samples = 0;
  std::size_t known = 0;
  for (int y = 0; y < pair.left.height; y += 2) {
    for (int x = 0; x < pair.left.width; x += 3) {
      const double disparity = factor * truth.values[static_cast<std::size_t>(y) * truth.width + x];
      if (!std::isfinite(disparity)) continue;
      ++known;
      const long column = x - std::lrint(disparity);
      if (column < 0 || column >= pair.right.width) continue;
      const auto* left = pair.left.at(x, y);
      const auto* right = pair.right.at(static_cast<int>(column), y);
      for (int c = 0; c < 3; ++c) sum += std::abs(left[c] - right[c]);
      samples += 3;
    }
  }
  // Where most of the truth points outside the image, what is left says nothing.
  if (samples == 0 || 3 * known > 2 * samples) return std::nullopt;
  return sum / static_cast<double>(samples);
}

/// Throws when another usual scale explains the images far better than the stated one.
void require_fitting_scale(const stereo_pair& pair, const real_map& truth, const fs::path& file) {
  const double stated = pair.entry.truth_scale.value_or(1);
  const auto difference = colour_difference(pair, truth, 1);
  double best = difference.value_or(765);
  double best_scale = stated;
  for (const double scale : {1.0, 2.0, 3.0, 4.0, 8.0, 16.0, 256.0}) {
    const auto other = colour_difference(pair, truth, stated / scale);
    if (other && *other < best) {
      best = *other;
      best_scale = scale;
    }
  }
  constexpr double far_better = 0.6;
  constexpr double noise = 2;  // grey levels: below, textureless images would decide
  if (best_scale == stated || best > far_better * difference.value_or(765) - noise) return;
  throw file_error(fmt::format(
      "{} does not fit the images at the stated truth_scale {}: {}, but {:.1f} at scale {}; correct the list",
      file.string(), stated,
      difference ? fmt::format("the colours of matching pixels differ by {:.1f} on average", *difference)
                 : "most of it points outside the right image",
      best, best_scale));
}

void add_masks(stereo_pair& pair, const pair_files& files) {
  ground_truth& truth = *pair.truth;
  const auto mask_of = [&](const fs::path& file) {
    pixel_mask mask = read_mask(file);
    require_size_of_image(file, mask, pair.left);
    return mask;
  };
  if (const auto file = files.find("mask_all"); !file.empty()) truth.evaluated = mask_of(file);

  fs::path not_occluded = files.find("mask_nonocc");
  if (not_occluded.empty()) not_occluded = files.find("mask_nonocc_left");
  const fs::path right_truth = files.find("disp_right");
  if (!not_occluded.empty()) {
    truth.non_occluded = mask_of(not_occluded);
    pair.non_occluded_source = "the data set's mask";
  } else if (!right_truth.empty()) {
    truth.non_occluded = non_occluded_by_right_truth(truth.disparity, truth_of(right_truth, pair.entry, pair.left));
    pair.non_occluded_source = "derived from the truth of both images";
  }

  const std::string not_hidden = truth.non_occluded ? ", non-occluded pixels only" : ", occluded pixels included";
  if (const auto file = files.find("mask_disc"); !file.empty()) {
    truth.near_discontinuity = mask_of(file);
    pair.near_discontinuity_source = "the data set's mask";
  } else {
    truth.near_discontinuity = near_discontinuities(truth.disparity);
    pair.near_discontinuity_source = "derived from the truth" + not_hidden;
  }
  if (truth.non_occluded) truth.near_discontinuity = both(*truth.near_discontinuity, *truth.non_occluded);
}

void note_unreachable_truth(stereo_pair& pair) {
  std::size_t known = 0;
  std::size_t beyond = 0;
  for (const double disparity : pair.truth->disparity.values) {
    known += std::isfinite(disparity) ? 1 : 0;
    beyond += disparity > pair.entry.levels ? 1 : 0;  // more than 1 above the largest level
  }
  if (known == 0) pair.notes.emplace_back("the truth is unknown everywhere: there is nothing to compare with");
  if (beyond != 0) {
    pair.notes.push_back(fmt::format("{:.1f} % of the known truth lies beyond the {} levels searched",
                                     100.0 * static_cast<double>(beyond) / static_cast<double>(known),
                                     pair.entry.levels));
  }
}

}  // namespace

std::vector<pair_entry> read_pair_list(const fs::path& list) {
  const auto contents = read_json(list, "a list of pairs");
  const json_place root(list, contents);
  root.require(contents.is_array() && !contents.empty(), "a list of one pair or more");
  std::vector<pair_entry> entries;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    pair_entry entry = entry_of(root.item(i));
    if (std::ranges::find(entries, entry.scene, &pair_entry::scene) != entries.end()) {
      root.item(i).field("scene").fail(fmt::format("the scene '{}' is there twice", entry.scene));
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<fs::path> pair_folders(const fs::path& list, const fs::path& data) {
  if (!data.empty()) return {data};
  const fs::path beside = fs::absolute(list).parent_path();
  std::vector<fs::path> folders{beside};
  if (const char* named = std::getenv("EPILINE_DATA"); named != nullptr && *named != '\0') folders.emplace_back(named);
  folders.push_back((beside / "../../shared/data").lexically_normal());
  folders.push_back(beside / "downloads");
  return folders;
}

stereo_pair load_pair(const pair_entry& entry, const std::vector<fs::path>& folders) {
  const auto found =
      std::ranges::find_if(folders, [&](const fs::path& folder) { return fs::is_directory(folder / entry.scene); });
  if (found == folders.end()) {
    std::vector<std::string> names;
    for (const auto& folder : folders) names.push_back(folder.string());
    throw missing_pair(
        fmt::format("no folder '{}' in {}; scripts/fetch_data.py {} fetches it if data/pairs.json has it", entry.scene,
                    fmt::join(names, ", "), entry.scene));
  }
  const pair_files files(entry, *found / entry.scene);
  stereo_pair pair;
  pair.entry = entry;
  pair.left = read_stereo_image(files.require("left"));
  const fs::path right = files.require("right");
  pair.right = read_stereo_image(right);
  require_size_of_image(right, pair.right, pair.left);
  const fs::path truth_file = files.find("disp_left");
  if (truth_file.empty()) {
    pair.notes.emplace_back("no ground truth: only coverage is known");
    return pair;
  }
  real_map truth = truth_of(truth_file, entry, pair.left);
  require_fitting_scale(pair, truth, truth_file);
  pair.truth = ground_truth{std::move(truth), std::nullopt, std::nullopt, std::nullopt};
  add_masks(pair, files);
  note_unreachable_truth(pair);
  return pair;
}

}  // namespace epiline::eval
