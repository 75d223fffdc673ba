#include "passes/merge_registers.hpp"

#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "passes/builder.hpp"

namespace epiline::passes {

namespace {

/// Rounds after which the search gives up. Each one splits at least one class; real designs need a handful.
constexpr unsigned max_rounds = 50;

/// Numbers expressions so that two nodes have one number if they are equal whenever registers of one class are equal.
class numbering {
 public:
  explicit numbering(const graph& g)
      : g_(g), scratch_(shell_of(g)), builder_(scratch_), class_of_(g.registers.size()), number_(g.nodes.size(), none) {
    std::map<std::vector<std::uint64_t>, std::uint32_t>
        classes;  // all registers of one initial value start in one class
    for (register_id r = 0; r < g.registers.size(); ++r) {
      const auto& state = g.registers[r];
      // One without an initial value must not stand for one that has it: hardware would not reset it.
      std::vector<std::uint64_t> key = {state.width, state.patient, state.initial.has_value(), state.resets};
      if (state.initial)
        key.insert(key.end(), state.initial->getRawData(), state.initial->getRawData() + state.initial->getNumWords());
      class_of_[r] = classes.try_emplace(std::move(key), static_cast<std::uint32_t>(classes.size())).first->second;
    }
    count_ = static_cast<std::uint32_t>(classes.size());
  }

  /// Splits classes until next values and enables agree within each. False: gave up.
  bool refine() {
    for (unsigned round = 0; round < max_rounds; ++round) {
      number_nodes();
      std::map<std::array<std::uint32_t, 3>, std::uint32_t> classes;
      for (register_id r = 0; r < class_of_.size(); ++r) {
        const std::array<std::uint32_t, 3> key = {class_of_[r], number_[g_.registers[r].next],
                                                  number_[g_.registers[r].enable]};
        class_of_[r] = classes.try_emplace(key, static_cast<std::uint32_t>(classes.size())).first->second;
      }
      if (classes.size() == count_) return true;
      count_ = static_cast<std::uint32_t>(classes.size());
    }
    return false;
  }

  const std::vector<std::uint32_t>& class_of() const { return class_of_; }

 private:
  /// The first register of the class of each, as the nodes read them.
  std::vector<register_id> representatives() const {
    std::vector<register_id> first(count_, none);
    std::vector<register_id> representative(g_.registers.size(), none);
    for (const node& n : g_.nodes) {
      if (n.kind != operation::register_value) continue;
      register_id& of_class = first[class_of_[n.object]];
      if (of_class == none) of_class = n.object;
      representative[n.object] = of_class;
    }
    return representative;
  }

  /// A node that is made of the same as in the round before keeps its number.
  void number_nodes() {
    const std::vector<register_id> before = std::exchange(representative_, representatives());
    std::vector<char> is_renumbered(g_.nodes.size(), 0);
    for (node_id id = 0; id < g_.nodes.size(); ++id) {
      const node& n = g_.nodes[id];
      if (n.kind == operation::memory_write) continue;  // nothing is made of it
      const bool is_register = n.kind == operation::register_value;
      bool is_changed = number_[id] == none || (is_register && representative_[n.object] != before[n.object]);
      for (const node_id operand : n.operands) is_changed = is_changed || is_renumbered[operand] != 0;
      if (!is_changed) continue;
      node again = {n.kind, n.width, n.operands, is_register ? representative_[n.object] : n.object,
                    n.low,  n.value, {},         n.where};
      for (node_id& operand : again.operands) operand = number_[operand];
      const node_id number = builder_.make(std::move(again));
      is_renumbered[id] = number != number_[id];
      number_[id] = number;
    }
  }

  const graph& g_;
  graph scratch_;  // of the nodes that numbers are of
  builder builder_;
  std::vector<std::uint32_t> class_of_;      // of each register
  std::vector<register_id> representative_;  // of each register, in this round
  std::vector<node_id> number_;              // of each node
  std::uint32_t count_ = 0;
};

/// The first register of the class of each.
std::vector<register_id> first_of_classes(const std::vector<std::uint32_t>& class_of) {
  std::map<std::uint32_t, register_id> first;
  std::vector<register_id> representative;
  for (register_id r = 0; r < class_of.size(); ++r)
    representative.push_back(first.try_emplace(class_of[r], r).first->second);
  return representative;
}

}  // namespace

std::vector<register_id> first_equal_registers(const graph& g) {
  numbering numbers(g);
  if (numbers.refine()) return first_of_classes(numbers.class_of());
  std::vector<register_id> each(g.registers.size());
  std::iota(each.begin(), each.end(), 0);
  return each;
}

void merge_registers(graph& g) {
  numbering numbers(g);
  if (!numbers.refine()) return;
  const std::vector<register_id> representative = first_of_classes(numbers.class_of());
  rebuild(g, [&](builder& b, node n, node_id) {
    if (n.kind == operation::register_value) n.object = representative[n.object];
    return b.make(std::move(n));
  });
}

}  // namespace epiline::passes
