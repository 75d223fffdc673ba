#include "report/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "eval/truth_masks.hpp"
#include "report/forked_tasks.hpp"
#include "scenes/render.hpp"

namespace epiline::report {
namespace {

struct computed_map {
  eval::real_map map;
  double seconds = 0;
  std::uint64_t cycles = 0;  // 0: not counted
};

computed_map run(const method& what, const eval::stereo_pair& pair) {
  computed_map computed;
  if (what.design == nullptr) {
    const auto start = std::chrono::steady_clock::now();
    computed.map = opencv::match(what.matcher, pair.left, pair.right, pair.entry.levels);
    computed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return computed;
  }
  const eval::match_request request{pair.left, pair.right, pair.entry.levels, what.parameters};
  eval::check_request(*what.design, request);
  const auto result = what.engine->make(*what.design)->match(request, {});
  computed.map = eval::real_values_of(result.map);
  computed.seconds = result.seconds;
  computed.cycles = result.cycles.value_or(0);
  return computed;
}

// A map on its way from one process to the other, on one machine: plain bytes.
struct map_header {
  int width;
  int height;
  double seconds;
  std::uint64_t cycles;
};

std::string bytes_of(const computed_map& computed) {
  const map_header header{computed.map.width, computed.map.height, computed.seconds, computed.cycles};
  std::string bytes(sizeof header + computed.map.values.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, computed.map.values.data(), computed.map.values.size() * sizeof(double));
  return bytes;
}

computed_map map_of(const std::string& bytes) {
  map_header header{};
  if (bytes.size() < sizeof header) throw std::logic_error("a map without a header");
  std::memcpy(&header, bytes.data(), sizeof header);
  const std::size_t pixels = static_cast<std::size_t>(header.width) * header.height;
  if (bytes.size() != sizeof header + pixels * sizeof(double)) throw std::logic_error("a map that was cut short");
  computed_map computed{{header.width, header.height, std::vector<double>(pixels)}, header.seconds, header.cycles};
  std::memcpy(computed.map.values.data(), bytes.data() + sizeof header, pixels * sizeof(double));
  return computed;
}

method_result result_of(const task_result& ended, const eval::stereo_pair& pair) {
  method_result result;
  if (!ended.succeeded) {
    result.failure = ended.value;
    return result;
  }
  computed_map computed = map_of(ended.value);
  result.figures = eval::measure(computed.map, pair.truth ? &*pair.truth : nullptr);
  result.map = std::move(computed.map);
  result.seconds = computed.seconds;
  if (computed.cycles != 0) result.cycles = computed.cycles;
  return result;
}

pair_result read_pair(const eval::pair_entry& entry, const std::vector<std::filesystem::path>& folders) {
  pair_result read;
  read.entry = entry;
  try {
    read.pair = eval::load_pair(entry, folders);
  } catch (const eval::missing_pair& error) {
    read.missing = true;
    read.failure = error.what();
  } catch (const std::exception& error) {
    read.failure = error.what();
  }
  return read;
}

}  // namespace

bool evaluation::complete() const {
  return std::ranges::all_of(pairs, [](const pair_result& pair) {
    return pair.failure.empty() &&
           std::ranges::all_of(pair.methods, [](const method_result& result) { return result.failure.empty(); });
  });
}

pair_result synthetic_corridor() {
  constexpr scenes::scene_parameters parameters{.width = 384, .height = 288, .levels = 16, .noise = 2};
  const auto scene = scenes::render(corridor_name, parameters);
  pair_result made;
  made.synthetic = true;
  made.entry.scene = corridor_name;
  made.entry.family =
      fmt::format("Rendered by this project (tb/scenes, seed {}, noise of {} grey levels), not the paper's picture",
                  parameters.seed, parameters.noise);
  made.entry.levels = parameters.levels;
  made.pair.emplace();
  made.pair->entry = made.entry;
  made.pair->left = scene.left.image;
  made.pair->right = scene.right.image;
  eval::ground_truth truth{scene.left.disparity, std::nullopt, scene.left.visible, std::nullopt};
  truth.near_discontinuity = eval::both(eval::near_discontinuities(truth.disparity), *truth.non_occluded);
  made.pair->truth = std::move(truth);
  made.pair->non_occluded_source = "exact, of the rendered scene";
  made.pair->near_discontinuity_source = "derived from the truth, non-occluded pixels only";
  return made;
}

std::vector<pair_result> read_pairs(const std::vector<eval::pair_entry>& entries,
                                    const std::vector<std::filesystem::path>& folders) {
  std::vector<pair_result> pairs;
  for (const auto& entry : entries) pairs.push_back(read_pair(entry, folders));
  return pairs;
}

evaluation evaluate(std::string engine, std::vector<method> methods, std::vector<pair_result> pairs, int jobs,
                    const progress_function& progress) {
  cv::setNumThreads(1);  // copies of this process have none of its threads; the cores are busy anyway
  evaluation found{std::move(engine), std::move(methods), std::move(pairs)};
  struct place {
    std::size_t pair;
    std::size_t method;
  };
  std::vector<place> places;
  std::vector<std::function<std::string()>> tasks;
  for (std::size_t p = 0; p < found.pairs.size(); ++p) {
    if (!found.pairs[p].pair) continue;
    found.pairs[p].methods.resize(found.methods.size());
    for (std::size_t m = 0; m < found.methods.size(); ++m) {
      places.push_back({p, m});
      tasks.emplace_back([&found, p, m] { return bytes_of(run(found.methods[m], *found.pairs[p].pair)); });
    }
  }
  std::size_t done = 0;
  const auto results = run_forked(tasks, jobs, [&](std::size_t task) {
    const auto& at = places[task];
    progress(++done, tasks.size(), fmt::format("{} {}", found.pairs[at.pair].entry.scene, found.methods[at.method].id));
  });
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    auto& pair = found.pairs[places[task].pair];
    pair.methods[places[task].method] = result_of(results[task], *pair.pair);
  }
  return found;
}

}  // namespace epiline::report
