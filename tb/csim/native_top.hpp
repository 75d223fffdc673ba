#pragma once
// Runs the native C++ of a stereo top as a vendor's testbench would: fill the inputs, call the top, drain the output.

#include <hls_stream.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "csim/frame_beats.hpp"
#include "eval/engine.hpp"

namespace epiline::csim {

/// `bits` of a token's field, 32 at a time.
template <class Wide>
void set_words(Wide& bits, int width, const std::array<std::uint32_t, 4>& words) {
  for (int low = 0; low < width; low += 32) {
    bits.range(std::min(low + 31, width - 1), low) = words[static_cast<std::size_t>(low / 32)];
  }
}

template <class Wide>
std::array<std::uint32_t, 4> words_of(const Wide& bits, int width) {
  std::array<std::uint32_t, 4> words{};
  for (int low = 0; low < width; low += 32) {
    words[static_cast<std::size_t>(low / 32)] =
        static_cast<std::uint32_t>(bits.range(std::min(low + 31, width - 1), low).to_uint());
  }
  return words;
}

/// Calls `top(left, right, disparity)` on streams that hold one frame, and returns the disparity map.
/// `Types` names the payloads: video_beat and disparity_beat, with `lanes` pixels each.
/// Throws eval::engine_error when the top reads from an empty stream, leaves tokens unread or writes what is no frame.
template <class Types, class Top>
eval::disparity_map run_native_top(const eval::rgb_image& left_image, const eval::rgb_image& right_image, Top&& top) {
  using video_beat = typename Types::video_beat;
  using disparity_beat = typename Types::disparity_beat;
  constexpr int lanes = Types::lanes;

  hls::stream<video_beat> left("left");
  hls::stream<video_beat> right("right");
  hls::stream<disparity_beat> disparity("disparity");
  const auto fill = [](hls::stream<video_beat>& stream, const eval::rgb_image& image) {
    for (const beat& token : beats_of_image(image, lanes)) {
      video_beat payload{};
      set_words(payload.data, lanes * static_cast<int>(input_lane_bits), token.data);
      payload.keep = token.keep;
      payload.strb = token.keep;
      payload.user = token.user;
      payload.last = token.last;
      stream.write(payload);
    }
  };
  const auto discard = [](auto& stream) {  // so that its destructor has nothing to add to the error
    while (!stream.empty()) stream.read();
  };
  try {
    fill(left, left_image);
    fill(right, right_image);
    top(left, right, disparity);
    std::string unread;
    for (const auto* stream : {&left, &right}) {
      if (!stream->empty()) unread += " '" + stream->name() + "' (" + std::to_string(stream->size()) + ")";
    }
    if (!unread.empty()) throw eval::engine_error("the top left unread tokens in stream" + unread);

    std::vector<beat> tokens;
    tokens.reserve(disparity.size());
    while (!disparity.empty()) {
      const disparity_beat payload = disparity.read();
      beat token;
      token.data = words_of(payload.data, lanes * static_cast<int>(disparity_lane_bits));
      token.keep = static_cast<std::uint32_t>(payload.keep);
      token.user = static_cast<std::uint32_t>(payload.user);
      token.last = payload.last != 0;
      tokens.push_back(token);
    }
    return map_of_beats(tokens, left_image.width, left_image.height, lanes);
  } catch (const hls::stream_error& error) {
    discard(left);
    discard(right);
    discard(disparity);
    throw eval::engine_error(error.what());
  } catch (const malformed_frame& error) {
    throw eval::engine_error(error.what());
  } catch (const eval::engine_error&) {
    discard(left);
    discard(right);
    discard(disparity);
    throw;
  }
}

}  // namespace epiline::csim
