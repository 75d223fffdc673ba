#pragma once
// Fewer levels at a time than there are: a beat then takes several iterations.
#include <ap_int.h>

#include "window/bits.hpp"

namespace epiline::kernels {

/// As a configuration's `parallel_disparities`: one iteration computes all levels.
inline constexpr int all_levels = 0;

/// How a beat's levels are shared out: `count` groups of `size` levels, one an iteration, the lowest levels first.
///
/// State that every level has then exists once a group, as a queue of `count` places: an iteration finds the state of
/// its group in the last place and puts the new one into the first, so no multiplexer chooses among groups.
///
/// Config: levels, parallel_disparities, pixels_per_beat.
template <class Config>
struct level_groups {
  static constexpr int size =
      Config::parallel_disparities == all_levels ? Config::levels : Config::parallel_disparities;
  static_assert(size >= 1 && Config::levels % size == 0, "levels is a multiple of parallel_disparities");
  static constexpr int count = Config::levels / size;
  static_assert(count == 1 || Config::pixels_per_beat == 1,
                "several clocks for a beat of several pixels: one pixel a beat takes as many and less logic");
};

/// The group an iteration computes: a counter through the groups of every beat. One group only: all is constant.
template <class Config>
class level_group {
 public:
  static constexpr int count = level_groups<Config>::count;
  using index_t = ap_uint<window::bits_for(count - 1)>;
  using level_t = ap_uint<7>;

  level_group() : index_(0), first_level_(0), first_(true), last_(count == 1) {}

  index_t index() const { return count == 1 ? index_t(0) : index_; }
  level_t first_level() const { return count == 1 ? level_t(0) : first_level_; }
  /// The beat's first iteration: what enters once a beat does so here.
  bool first() const { return count == 1 || first_; }
  /// The beat's last iteration: what is known of all levels is known here.
  bool last() const { return count == 1 || last_; }

  void advance() {
    first_ = last_;
    index_ = last_ ? index_t(0) : index_t(index_ + 1);
    first_level_ = last_ ? level_t(0) : level_t(first_level_ + level_groups<Config>::size);
    last_ = index_ == count - 1;
  }

 private:
  index_t index_;
  level_t first_level_;
  bool first_;
  bool last_;
};

/// Moves the queue of a group-wise state on by one place; the first one is then free for the newest.
template <int Groups, int Size, class Value>
void move_groups_on(Value (&state)[Groups][Size]) {
  for (int group = Groups - 1; group > 0; --group) {
    for (int i = 0; i < Size; ++i) state[group][i] = state[group - 1][i];
  }
}

}  // namespace epiline::kernels
