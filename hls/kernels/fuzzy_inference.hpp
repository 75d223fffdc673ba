#pragma once
#include <ap_int.h>

namespace epiline::kernels {

/// Mamdani inference with three inputs: the membership degrees of each input, every rule's degree = the minimum over
/// its three labels (AND), every output set's degree = the maximum over the rules that conclude it. No state. All rules
/// are evaluated at once.
///
/// RuleBase provides, as constants:
///   degree_bits            bits of a membership degree; 2^degree_bits - 1 is full membership
///   labels, sets           number of labels of each input, of output sets
///   domain                 entries of a membership table; larger inputs count as domain - 1
///   membership.of[i][k]    degree of input value i under label k
///   rules.set[u][v][w]     the output set concluded from labels u, v, w of the three inputs
/// The last label is that of large inputs; an undefined input belongs to it in full.
template <class RuleBase>
class fuzzy_inference {
 public:
  static constexpr int labels = RuleBase::labels;
  static constexpr int sets = RuleBase::sets;
  using degree_t = ap_uint<RuleBase::degree_bits>;
  static constexpr int degree_bits = RuleBase::degree_bits;
  static constexpr int full = (1 << RuleBase::degree_bits) - 1;

  struct fuzzy_value {
    degree_t label[labels];
  };
  struct conclusion {
    degree_t set[sets];
  };

  template <class Input>
  static fuzzy_value fuzzify(Input input, bool defined) {
#pragma HLS INLINE
    const int entry = input < RuleBase::domain ? int(input) : RuleBase::domain - 1;
    fuzzy_value result;
    for (int k = 0; k < labels; ++k) {
      const degree_t undefined_degree = k == labels - 1 ? full : 0;
      result.label[k] = defined ? degree_t(RuleBase::membership.of[entry][k]) : undefined_degree;
    }
    return result;
  }

  static conclusion infer(const fuzzy_value& u, const fuzzy_value& v, const fuzzy_value& w) {
#pragma HLS INLINE
    conclusion result;
    for (int set = 0; set < sets; ++set) result.set[set] = 0;
#pragma clang loop unroll(full)
    for (int i = 0; i < labels; ++i) {
#pragma clang loop unroll(full)
      for (int j = 0; j < labels; ++j) {
        const degree_t both = smaller(u.label[i], v.label[j]);
        for (int set = 0; set < sets; ++set) {
          // max over k of min(both, w_k) = min(both, max over k of w_k): one minimum for all rules of a set.
          degree_t any = 0;
          for (int k = 0; k < labels; ++k) {
            if (RuleBase::rules.set[i][j][k] == set) any = larger(any, w.label[k]);
          }
          result.set[set] = larger(result.set[set], smaller(both, any));
        }
      }
    }
    return result;
  }

 private:
  static degree_t larger(degree_t a, degree_t b) { return a < b ? b : a; }
  static degree_t smaller(degree_t a, degree_t b) { return a < b ? a : b; }
};

}  // namespace epiline::kernels
