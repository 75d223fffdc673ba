#include "cosim/frame_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "csim/frame_beats.hpp"

namespace epiline::cosim {
namespace {

/// The signals of video; anything else in a payload is a top of another kind.
constexpr std::string_view video_signals[] = {"tdata", "tkeep", "tstrb", "tuser", "tlast"};

void require_video(const model_port& port, unsigned data_bits) {
  for (const model_field& field : port.fields) {
    if (std::ranges::find(video_signals, field.name) == std::end(video_signals)) {
      throw unsuitable_ports(fmt::format("stream '{}' has a signal '{}', which video has not", port.name, field.name));
    }
  }
  const model_field* data = port.find("tdata");
  if (data == nullptr || data->width != data_bits) {
    throw unsuitable_ports(fmt::format("stream '{}' has {} bits of tdata, not {}", port.name,
                                       data == nullptr ? 0 : data->width, data_bits));
  }
}

}  // namespace

frame_tokens::frame_tokens(std::vector<model_port> ports, int pixels_per_beat)
    : ports_(std::move(ports)), pixels_per_beat_(pixels_per_beat) {
  for (const model_port& port : ports_) {
    const model_port** role = nullptr;
    if (port.kind == port_kind::call) role = &call_;
    if (port.kind == port_kind::stream && port.input && port.name == "left") role = &left_;
    if (port.kind == port_kind::stream && port.input && port.name == "right") role = &right_;
    if (port.kind == port_kind::stream && !port.input && output_ == nullptr) role = &output_;
    if (role == nullptr) throw unsuitable_ports(fmt::format("port '{}' has no part in stereo matching", port.name));
    *role = &port;
  }
  if (left_ == nullptr || right_ == nullptr) throw unsuitable_ports("no input streams 'left' and 'right'");
  if (output_ == nullptr) throw unsuitable_ports("no output stream");
  const unsigned lanes = static_cast<unsigned>(pixels_per_beat);
  require_video(*left_, lanes * csim::input_lane_bits);
  require_video(*right_, lanes * csim::input_lane_bits);
  require_video(*output_, lanes * csim::disparity_lane_bits);
}

void frame_tokens::append_frame(const eval::match_request& request, std::map<std::string, token_list>& inputs) const {
  const auto list_of = [&](const model_port& port) -> token_list& {
    return inputs.try_emplace(port.name, port.width).first->second;
  };
  append_image(*left_, request.left, list_of(*left_));
  append_image(*right_, request.right, list_of(*right_));
  for (const auto& [name, value] : request.parameters) {
    if (call_ == nullptr || call_->find(name) == nullptr) {
      throw unsuitable_ports(fmt::format("the top has no scalar for parameter '{}'", name));
    }
  }
  if (call_ == nullptr) return;

  eval::parameter_values scalars = request.parameters;
  scalars["width"] = request.left.width;
  scalars["height"] = request.left.height;
  scalars["levels"] = request.levels;
  const std::span<std::uint32_t> token = list_of(*call_).append();
  for (const model_field& field : call_->fields) {
    const auto scalar = scalars.find(field.name);
    if (scalar == scalars.end()) throw unsuitable_ports(fmt::format("scalar '{}' is unknown", field.name));
    const std::uint64_t value = static_cast<std::uint32_t>(scalar->second);
    if (field.width < 32 && value >> field.width != 0) {
      throw unsuitable_ports(
          fmt::format("scalar '{}' has {} bits, too few for {}", field.name, field.width, scalar->second));
    }
    set_bits_at(token, field.offset, field.width, value);
  }
}

std::size_t frame_tokens::output_tokens(int width, int height) const {
  return std::size_t{csim::beats_a_row(width, pixels_per_beat_)} * static_cast<std::size_t>(height);
}

void frame_tokens::append_image(const model_port& port, const eval::rgb_image& image, token_list& tokens) const {
  for (const csim::beat& beat : csim::beats_of_image(image, pixels_per_beat_)) {
    const std::span<std::uint32_t> token = tokens.append();
    for (const model_field& field : port.fields) {
      if (field.name == "tdata") {
        for (unsigned done = 0; done < field.width; done += 32) {
          set_bits_at(token, field.offset + done, std::min(32u, field.width - done), beat.data[done / 32]);
        }
      } else {
        const std::uint32_t value = field.name == "tuser" ? beat.user : field.name == "tlast" ? beat.last : beat.keep;
        set_bits_at(token, field.offset, field.width, value);
      }
    }
  }
}

eval::disparity_map frame_tokens::map_of(const token_list& tokens, std::size_t first, int width, int height) const {
  const std::size_t count = std::min(output_tokens(width, height), tokens.size() - std::min(first, tokens.size()));
  std::vector<csim::beat> beats(count);
  for (std::size_t index = 0; index < count; ++index) {
    const std::span<const std::uint32_t> token = tokens[first + index];
    csim::beat& beat = beats[index];
    // A signal the stream does not have holds by definition.
    beat.user = index == 0 ? 1 : 0;
    const auto in_row = static_cast<unsigned>(index % csim::beats_a_row(width, pixels_per_beat_));
    beat.last = in_row + 1 == csim::beats_a_row(width, pixels_per_beat_);
    beat.keep = csim::keep_bits(width, in_row, pixels_per_beat_, csim::disparity_lane_bits);
    for (const model_field& field : output_->fields) {
      const std::uint64_t value = bits_at(token, field.offset, std::min(field.width, 64u));
      if (field.name == "tdata") beat.data[0] = static_cast<std::uint32_t>(value);
      if (field.name == "tuser") beat.user = static_cast<std::uint32_t>(value);
      if (field.name == "tlast") beat.last = value != 0;
      if (field.name == "tkeep") beat.keep = static_cast<std::uint32_t>(value);
    }
  }
  return csim::map_of_beats(beats, width, height, pixels_per_beat_);
}

}  // namespace epiline::cosim
