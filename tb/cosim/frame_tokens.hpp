#pragma once
// A matching request as the tokens of a stereo top, and its output tokens as a disparity map: what the engines that run
// a top token by token (dataflow graph, RTL, netlist) share.
//
// Such a top has the input streams `left` and `right`, one output stream of any name, and scalars among `width`,
// `height`, `levels` and the design's parameters.

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "cosim/model.hpp"
#include "cosim/token_list.hpp"
#include "eval/engine.hpp"

namespace epiline::cosim {

/// The ports are not those of a stereo top; what() names the port or scalar.
class unsuitable_ports : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class frame_tokens {
 public:
  /// Throws unsuitable_ports.
  frame_tokens(std::vector<model_port> ports, int pixels_per_beat);
  frame_tokens(const frame_tokens&) = delete;
  frame_tokens& operator=(const frame_tokens&) = delete;

  /// The name of the disparity stream.
  [[nodiscard]] const std::string& output() const { return output_->name; }

  /// Adds the tokens of one frame, and of one call, to `inputs` (by port name).
  /// Throws unsuitable_ports when a scalar is unknown, its value does not fit, or a parameter has no scalar.
  void append_frame(const eval::match_request& request, std::map<std::string, token_list>& inputs) const;

  /// Output tokens of a frame of that size.
  [[nodiscard]] std::size_t output_tokens(int width, int height) const;

  /// The map in tokens `first` .. `first + output_tokens(width, height)`. Throws csim::malformed_frame.
  [[nodiscard]] eval::disparity_map map_of(const token_list& tokens, std::size_t first, int width, int height) const;

 private:
  void append_image(const model_port& port, const eval::rgb_image& image, token_list& tokens) const;

  std::vector<model_port> ports_;
  const model_port* left_ = nullptr;
  const model_port* right_ = nullptr;
  const model_port* output_ = nullptr;
  const model_port* call_ = nullptr;
  int pixels_per_beat_;
};

}  // namespace epiline::cosim
