#pragma once
// Rule bases of the disparity filter: membership tables and rules as constants, for fuzzy_inference.

namespace epiline::kernels {

/// Degrees of `Domain` input values under `Labels` labels.
template <int Domain, int Labels>
struct membership_table {
  unsigned char of[Domain][Labels];
};

/// Output set of every combination of labels of three inputs.
template <int Labels>
struct rule_table {
  unsigned char set[Labels][Labels][Labels];
};

/// Labels of the difference of two disparities.
enum difference_label : unsigned char { same = 0, near = 1, far = 2 };

/// Output sets: singletons.
enum disparity_set : unsigned char {
  centre = 0,      // at the centre's disparity
  neighbours = 1,  // at the disparities of the left and the right neighbour
  undefined = 2,
};

/// Inputs u = |c - l|, v = |c - r|, w = |l - r| of centre c, left neighbour l, right neighbour r. A centre that is the
/// same as one neighbour stays; one that is not gives way to neighbours that agree with each other; three values far
/// apart are no disparity at all.
inline constexpr rule_table<3> disparity_rules = {{
    // v = same, then near, then far; in each w = same, near, far
    {{centre, centre, centre}, {centre, centre, centre}, {centre, centre, centre}},                 // u = same
    {{centre, centre, centre}, {neighbours, centre, centre}, {neighbours, centre, centre}},         // u = near
    {{centre, centre, centre}, {neighbours, centre, centre}, {neighbours, neighbours, undefined}},  // u = far
}};

/// The default: triangular sets with breakpoints 0, 2 and 4 levels whose degrees sum up to full membership everywhere.
/// Which label dominates does not depend on DegreeBits, nor does the filter's result.
template <int DegreeBits>
struct triangular_rule_base {
  static constexpr int degree_bits = DegreeBits;
  static constexpr int labels = 3;
  static constexpr int sets = 3;
  static constexpr int domain = 5;
  static constexpr int full = (1 << DegreeBits) - 1;
  static constexpr int half = full / 2;
  static constexpr membership_table<domain, labels> membership = {{
      // same, near, far
      {full, 0, 0},
      {half, full - half, 0},
      {0, full, 0},
      {0, half, full - half},
      {0, 0, full},
  }};
  static constexpr rule_table<3> rules = disparity_rules;
};

}  // namespace epiline::kernels
