#include "prove/confirm.hpp"

#include "dataflow/interpreter.hpp"

namespace epiline::prove {

using namespace dataflow;
using llvm::APInt;

concrete_end run_one_iteration(graph g, const concrete_start& start) {
  for (register_id r = 0; r < g.registers.size(); ++r) g.registers[r].initial = start.registers[r];
  for (memory_id m = 0; m < g.memories.size(); ++m) {
    g.memories[m].initial.assign(g.memories[m].words, APInt(g.memories[m].width, 0));
    for (const auto& [index, word] : start.words[m])
      if (index < g.memories[m].words) g.memories[m].initial[index] = word;
  }
  interpreter machine(g);
  for (port_id p = 0; p < g.ports.size(); ++p)
    if (g.ports[p].input) machine.push(p, start.tokens[p]);
  concrete_end end;
  end.advanced = machine.step() == outcome::advanced;
  for (port_id p = 0; p < g.ports.size(); ++p) {
    const bool waits = machine.available(p) > 0;
    end.accessed.push_back(g.ports[p].input ? !waits : waits);
    end.tokens.emplace_back(g.ports[p].width, 0);
    if (!g.ports[p].input && waits) end.tokens.back() = *machine.pop(p);
  }
  for (register_id r = 0; r < g.registers.size(); ++r) end.registers.push_back(machine.register_value(r));
  end.words.resize(g.memories.size());
  for (memory_id m = 0; m < g.memories.size(); ++m)
    for (const auto& [index, word] : start.words[m])
      if (index < g.memories[m].words) end.words[m].emplace(index, machine.memory_word(m, index));
  return end;
}

}  // namespace epiline::prove
