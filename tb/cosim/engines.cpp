#include "cosim/engines.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "cosim/frame_tokens.hpp"
#include "cosim/stream_driver.hpp"
#include "csim/frame_beats.hpp"

namespace epiline::cosim {
namespace {

class stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class model_engine : public eval::engine {
 public:
  model_engine(const eval::design_description& design, model_factory make_model)
      : pixels_per_beat_(design.pixels_per_beat), make_model_(std::move(make_model)) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& options) override {
    const stopwatch watch;
    try {
      const std::unique_ptr<rtl_model> model = make_model_(options.seed);
      const frame_tokens frames(model->ports(), pixels_per_beat_);
      const int width = request.left.width;
      const int height = request.left.height;
      drive_request drive_this;
      frames.append_frame(request, drive_this.inputs);
      drive_this.expected[frames.output()] = frames.output_tokens(width, height);

      drive_options how;
      how.seed = options.seed;
      how.progress = options.progress;
      for (const model_port& port : model->ports()) {
        how.stalls[port.name] = {port.input ? options.input_gap_percent : options.output_stall_percent, 1};
      }
      const drive_result driven = drive(*model, drive_this, how);
      eval::match_result result;
      result.map = frames.map_of(driven.outputs.at(frames.output()).tokens, 0, width, height);
      result.seconds = watch.seconds();
      result.cycles = driven.busy_clocks();
      return result;
    } catch (const drive_error& error) {
      throw eval::engine_error(error.what());
    } catch (const unsuitable_ports& error) {
      throw eval::engine_error(error.what());
    } catch (const csim::malformed_frame& error) {
      throw eval::engine_error(error.what());
    }
  }

 private:
  int pixels_per_beat_;
  model_factory make_model_;
};

}  // namespace

std::unique_ptr<eval::engine> make_model_engine(const eval::design_description& design, model_factory make_model) {
  return std::make_unique<model_engine>(design, std::move(make_model));
}

}  // namespace epiline::cosim
