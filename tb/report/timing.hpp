#pragma once
// Measured speed of the hardware, from a file that scripts/frame_rates.py writes.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/paper.hpp"

namespace epiline::report {

struct timed_frame {
  frame_size size;
  int levels;
  double cycles;  // clocks from the first input beat to the last output beat
};

struct design_timing {
  double megahertz = 0;
  std::string clock_source;   // in words: an estimate, or measured after place and route
  std::string cycles_source;  // in words: what counted them
  std::vector<timed_frame> frames;

  /// Of the frame of that size, none if it was not run.
  [[nodiscard]] std::optional<double> cycles(frame_size size) const;
  [[nodiscard]] std::optional<double> frames_a_second(frame_size size) const;
};

using timings = std::map<std::string, design_timing, std::less<>>;  // by design

/// Reads {"schema": "epiline-timing/1", "designs": {NAME: {"clock": {"megahertz": X, "source": TEXT}, "cycles_source":
/// TEXT, "frames": [{"width": W, "height": H, "levels": D, "cycles": N}, ...]}}}. Throws eval::file_error naming the
/// place in the file.
[[nodiscard]] timings read_timings(const std::filesystem::path& file);

}  // namespace epiline::report
