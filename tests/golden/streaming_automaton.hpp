#pragma once
// The cellular automaton once more, as a stream of labels can compute it: without binary planes, one pixel at a time
// (ALGORITHMS.md, section 2). It counts the branches it takes, so that a test can show that it took all of them.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "golden/planes.hpp"

namespace epiline::test {

/// How often each case came up, by its name.
using branch_counts = std::map<std::string, long>;

class streaming_automaton {
 public:
  streaming_automaton(const golden::disparity_plane& map, branch_counts& branches)
      : labels_(labels_of(map)), branches_(branches) {}

  /// Both rules and the recomposition.
  golden::disparity_plane filter(int ring) {
    golden::plane<int> next = labels_;
    for_every_pixel([&](Eigen::Index y, Eigen::Index x) { next(y, x) = rule_1(y, x); });
    labels_ = next;
    for_every_pixel([&](Eigen::Index y, Eigen::Index x) { next(y, x) = rule_2(y, x, ring); });
    return {next.max(0).cast<std::uint8_t>(), next >= 0};
  }

 private:
  static constexpr int undefined = -1;

  static golden::plane<int> labels_of(const golden::disparity_plane& map) {
    return map.defined.select(map.disparity.cast<int>(), undefined);
  }

  template <class Visit>
  void for_every_pixel(Visit&& visit) {
    for (Eigen::Index y = 0; y < labels_.rows(); ++y) {
      for (Eigen::Index x = 0; x < labels_.cols(); ++x) visit(y, x);
    }
  }

  [[nodiscard]] bool inside(Eigen::Index y, Eigen::Index x) const {
    return y >= 0 && y < labels_.rows() && x >= 0 && x < labels_.cols();
  }
  [[nodiscard]] int label(Eigen::Index y, Eigen::Index x) const { return inside(y, x) ? labels_(y, x) : undefined; }

  int rule_1(Eigen::Index y, Eigen::Index x) {
    std::array<int, 8> neighbours{};
    std::size_t n = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dy != 0 || dx != 0) neighbours[n++] = label(y + dy, x + dx);
      }
    }
    const auto equal_to = [&](int v) { return std::count(neighbours.begin(), neighbours.end(), v); };
    const int centre = labels_(y, x);
    // Of any two neighbours one at least has the label that seven have.
    for (const int k : {0, 1}) {
      const int v = neighbours[static_cast<std::size_t>(k)];
      if (v == undefined || equal_to(v) < 7) continue;
      ++branches_[std::string("rule 1 b: seven agree with neighbour ") + (k == 0 ? "0" : "1, not 0")];
      ++branches_[equal_to(v) == 7 ? "rule 1 b: seven of eight" : "rule 1 b: eight of eight"];
      ++branches_[centre == v           ? "rule 1 b: pixel has the level already"
                  : centre == undefined ? "rule 1 b: undefined pixel is born"
                                        : "rule 1 b: born pixel leaves its plane"];
      // The pixel that leaves would have stayed by rule a): its old level has the neighbour that is not v.
      if (centre != v && centre != undefined && equal_to(centre) == 1)
        ++branches_["rule 1 b: ... where it had company"];
      return v;
    }
    if (centre == undefined) {
      ++branches_["rule 1: undefined stays undefined"];
      return undefined;
    }
    const auto company = equal_to(centre);
    ++branches_[company == 0   ? "rule 1 a: no neighbour agrees"
                : company == 1 ? "rule 1: one neighbour agrees"
                : company == 6 ? "rule 1: six neighbours agree"
                               : "rule 1: two to five neighbours agree"];
    return company == 0 ? undefined : centre;
  }

  int rule_2(Eigen::Index y, Eigen::Index x, int ring) {
    std::array<int, 40> around{};
    std::vector<int> distinct;
    std::size_t n = 0;
    bool cut_off = false;
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const int v = label(y + dy, x + dx);
        cut_off = cut_off || !inside(y + dy, x + dx);
        if (std::abs(dy) > 1 || std::abs(dx) > 1) {
          around[n++] = v;
        } else if (v != undefined && std::count(distinct.begin(), distinct.end(), v) == 0) {
          distinct.push_back(v);
        }
      }
    }
    int claims = 0;
    int claimed = undefined;
    for (const int v : distinct) {
      const auto agree = std::count(around.begin(), around.end(), v);
      if (agree == ring) ++branches_["rule 2 d: exactly as many as needed"];
      if (agree == ring - 1) ++branches_["rule 2 d: one too few"];
      if (agree < ring) continue;
      ++claims;
      claimed = v;
    }
    const int centre = labels_(y, x);
    if (claims == 1) {
      ++branches_[claimed == centre     ? "rule 2: claimed by its own level"
                  : centre == undefined ? "rule 2 c: undefined pixel filled"
                                        : "rule 2 c: taken over by another level"];
      if (distinct.size() > 1) ++branches_["rule 2: one of several levels claims"];
      if (cut_off) ++branches_["rule 2: claimed beside the border"];
      return claimed;
    }
    ++branches_[distinct.empty() ? "rule 2: no level in the 3x3"
                : claims == 0    ? "rule 2 d: no level with enough support"
                : claims == 2    ? "rule 2: claimed by two levels"
                                 : "rule 2: claimed by three levels or more"];
    return undefined;
  }

  golden::plane<int> labels_;
  branch_counts& branches_;
};

inline constexpr const char* automaton_branches[] = {
    "rule 1 b: seven agree with neighbour 0",
    "rule 1 b: seven agree with neighbour 1, not 0",
    "rule 1 b: seven of eight",
    "rule 1 b: eight of eight",
    "rule 1 b: pixel has the level already",
    "rule 1 b: undefined pixel is born",
    "rule 1 b: born pixel leaves its plane",
    "rule 1 b: ... where it had company",
    "rule 1: undefined stays undefined",
    "rule 1 a: no neighbour agrees",
    "rule 1: one neighbour agrees",
    "rule 1: two to five neighbours agree",
    "rule 1: six neighbours agree",
    "rule 2 d: exactly as many as needed",
    "rule 2 d: one too few",
    "rule 2 d: no level with enough support",
    "rule 2: claimed by its own level",
    "rule 2 c: undefined pixel filled",
    "rule 2 c: taken over by another level",
    "rule 2: one of several levels claims",
    "rule 2: claimed beside the border",
    "rule 2: no level in the 3x3",
    "rule 2: claimed by two levels",
    "rule 2: claimed by three levels or more",
};

}  // namespace epiline::test
