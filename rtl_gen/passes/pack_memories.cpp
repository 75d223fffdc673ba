#include "passes/pack_memories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "passes/builder.hpp"

namespace epiline::passes {

namespace {

using llvm::APInt;

/// How a memory is used. Memories with equal keys are one memory with wider words.
using key = std::vector<std::uint64_t>;

struct group {
  std::vector<memory_id> members;  // low bits first
  memory_id packed = none;
};

/// A key of every memory; empty for one that is not to be packed (accesses out of order, or none at all).
std::vector<key> keys_of(const graph& g) {
  std::vector<std::set<std::pair<node_id, node_id>>> reads(g.memories.size());
  std::vector<std::vector<node_id>> writes(g.memories.size());
  std::vector<char> excluded(g.memories.size(), 0);
  for (const node& n : g.nodes) {
    if (n.kind == operation::memory_write) writes[n.object].push_back(static_cast<node_id>(&n - g.nodes.data()));
    if (n.kind != operation::memory_read) continue;
    reads[n.object].insert({n.operands[0], n.operands[1]});
    if (!writes[n.object].empty()) excluded[n.object] = 1;
  }
  std::vector<key> keys(g.memories.size());
  for (memory_id m = 0; m < g.memories.size(); ++m) {
    if (excluded[m] || writes[m].size() > 1 || reads[m].empty()) continue;
    const dataflow::memory& memory = g.memories[m];
    keys[m] = {memory.words, memory.distance, memory.distance_promised, memory.initial.empty(), writes[m].size()};
    for (const node_id id : writes[m]) {
      keys[m].push_back(g.nodes[id].operands[0]);
      keys[m].push_back(g.nodes[id].operands[2]);
    }
    for (const auto& [address, enable] : reads[m]) {
      keys[m].push_back(address);
      keys[m].push_back(enable);
    }
  }
  return keys;
}

/// LUT levels, in tenths, between a node and the clock edge its value comes from at the earliest: a rough measure, for
/// differences of several clocks.
std::vector<unsigned> depths_of(const graph& g) {
  std::vector<unsigned> depths(g.nodes.size(), 0);
  for (node_id id = 0; id < g.nodes.size(); ++id) {
    const node& n = g.nodes[id];
    for (const node_id operand : n.operands) depths[id] = std::max(depths[id], depths[operand]);
    switch (n.kind) {
      case operation::add:
      case operation::subtract:
      case operation::equal:
      case operation::less_unsigned:
      case operation::less_signed:
      case operation::memory_read:
        depths[id] += 20;
        break;
      case operation::multiply:
        depths[id] += 50;
        break;
      case operation::select:
      case operation::table:
      case operation::shift_left:
      case operation::shift_right_logical:
      case operation::shift_right_arithmetic:
        depths[id] += 10;
        break;
      case operation::bit_and:
      case operation::bit_or:
      case operation::bit_xor:
        depths[id] += 4;
        break;
      default:
        break;
    }
  }
  return depths;
}

/// A word is written when its last bit is there. Data that would have to wait this much longer for its neighbours, some
/// two clocks, is better off in a memory of its own.
constexpr unsigned worth_a_memory = 80;

/// Splits memories of equal keys where their data comes much later than the others': keys get a number of the part.
void split_by_arrival(const graph& g, std::vector<key>& keys) {
  const std::vector<unsigned> depths = depths_of(g);
  std::map<key, std::vector<std::pair<unsigned, memory_id>>> arrivals;
  for (const node& n : g.nodes)
    if (n.kind == operation::memory_write && !keys[n.object].empty())
      arrivals[keys[n.object]].emplace_back(depths[n.operands[1]], n.object);
  for (auto& [together, members] : arrivals) {
    std::sort(members.begin(), members.end());
    std::uint64_t part = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0 && members[i].first - members[i - 1].first >= worth_a_memory) ++part;
      keys[members[i].second].push_back(part);
    }
  }
}

/// Bits of a packed word: 16 block RAMs of 18 bits. Wider words have addresses and enables that one flip-flop cannot
/// bring everywhere in a clock; memories of their own have copies of them.
constexpr unsigned widest = 288;

/// Sorts the memories into groups; a group ends where its words would become too wide.
std::vector<group> groups_of(const graph& g) {
  std::vector<key> keys = keys_of(g);
  split_by_arrival(g, keys);
  std::map<key, std::size_t> open;  // last group of each key
  std::map<std::size_t, unsigned> widths;
  std::vector<group> groups;
  for (memory_id m = 0; m < g.memories.size(); ++m) {
    const auto found = keys[m].empty() ? open.end() : open.find(keys[m]);
    const bool joins = found != open.end() && widths[found->second] + g.memories[m].width <= widest;
    const std::size_t index = joins ? found->second : groups.size();
    if (!joins) groups.emplace_back();
    if (!keys[m].empty()) open[keys[m]] = index;
    groups[index].members.push_back(m);
    widths[index] += g.memories[m].width;
  }
  return groups;
}

dataflow::memory packed_memory(const graph& g, const group& members) {
  dataflow::memory packed = g.memories[members.members[0]];
  if (members.members.size() == 1) return packed;
  packed.name += fmt::format("_x{}", members.members.size());
  for (std::size_t i = 1; i < members.members.size(); ++i) {
    const dataflow::memory& next = g.memories[members.members[i]];
    packed.width += next.width;
    packed.origins.insert(packed.origins.end(), next.origins.begin(), next.origins.end());
    for (std::size_t w = 0; w < packed.initial.size(); ++w)
      packed.initial[w] = next.initial[w].concat(packed.initial[w]);
  }
  return packed;
}

}  // namespace

void pack_memories(graph& g) {
  std::vector<group> groups = groups_of(g);
  if (groups.size() == g.memories.size()) return;
  const std::vector<dataflow::memory> old = g.memories;
  std::vector<std::size_t> group_of(old.size());
  std::vector<unsigned> low(old.size(), 0);  // where a memory's bits lie in the packed word
  std::vector<dataflow::memory> packed;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].packed = static_cast<memory_id>(i);
    packed.push_back(packed_memory(g, groups[i]));
    unsigned next = 0;
    for (const memory_id m : groups[i].members) {
      group_of[m] = i;
      low[m] = next;
      next += old[m].width;
    }
  }
  g.memories = std::move(packed);
  std::vector<node> writes(old.size());  // of each old memory, with operands of the new graph
  rebuild(
      g,
      [&](builder& b, node n, node_id) {
        if (n.kind == operation::memory_write) {
          writes[n.object] = n;
          return none;
        }
        if (n.kind != operation::memory_read) return b.make(std::move(n));
        const memory_id m = n.object;
        n.object = groups[group_of[m]].packed;
        n.width = b.target().memories[n.object].width;
        return b.slice(b.make(std::move(n)), low[m], old[m].width);
      },
      {},
      [&](builder& b) {
        for (const group& together : groups) {
          node write = writes[together.members[0]];
          if (write.kind != operation::memory_write) continue;
          std::vector<node_id> parts;
          for (const memory_id m : together.members) parts.push_back(writes[m].operands[1]);
          std::reverse(parts.begin(), parts.end());
          write.object = together.packed;
          write.operands[1] = b.concat(std::move(parts));
          b.make(std::move(write));
        }
      });
}

}  // namespace epiline::passes
