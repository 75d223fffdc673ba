#include "report/timing.hpp"

#include <algorithm>

#include "eval/json_place.hpp"

namespace epiline::report {
namespace {

using eval::json_place;

timed_frame frame_of(const json_place& place) {
  constexpr int largest_side = 65535;
  constexpr int most_clocks = 2'000'000'000;
  place.require_object({"width", "height", "levels", "cycles"});
  return {{place.field("width").whole_number(1, largest_side), place.field("height").whole_number(1, largest_side)},
          place.field("levels").whole_number(1, largest_side),
          static_cast<double>(place.field("cycles").whole_number(1, most_clocks))};
}

design_timing timing_of(const json_place& place) {
  place.require_object({"clock", "cycles_source", "frames"});
  const auto clock = place.field("clock");
  clock.require_object({"megahertz", "source"});
  design_timing timing;
  timing.megahertz = clock.field("megahertz").positive_number("a number of megahertz above 0");
  timing.clock_source = clock.field("source").text();
  timing.cycles_source = place.field("cycles_source").text();
  const auto frames = place.field("frames");
  frames.require(frames.value().is_array(), "a list of frames");
  for (std::size_t i = 0; i < frames.value().size(); ++i) timing.frames.push_back(frame_of(frames.item(i)));
  return timing;
}

}  // namespace

std::optional<double> design_timing::cycles(frame_size size) const {
  const auto found = std::ranges::find_if(frames, [&](const timed_frame& frame) {
    return frame.size.width == size.width && frame.size.height == size.height;
  });
  if (found == frames.end()) return std::nullopt;
  return found->cycles;
}

std::optional<double> design_timing::frames_a_second(frame_size size) const {
  const auto clocks = cycles(size);
  if (!clocks) return std::nullopt;
  return megahertz * 1e6 / *clocks;
}

timings read_timings(const std::filesystem::path& file) {
  const auto contents = eval::read_json(file, "measured timing (scripts/frame_rates.py writes it)");
  const json_place root(file, contents);
  root.require_object({"schema", "designs"});
  if (const auto schema = root.field("schema"); schema.text() != "epiline-timing/1") {
    schema.require(false, "\"epiline-timing/1\"");
  }
  const auto designs = root.field("designs");
  designs.require(designs.value().is_object(), "an object of designs");
  timings found;
  for (const auto& [name, value] : designs.value().items()) found.emplace(name, timing_of(designs.field(name)));
  return found;
}

}  // namespace epiline::report
