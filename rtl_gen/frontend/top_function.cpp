#include "frontend/top_function.hpp"

#include <fmt/format.h>
#include <llvm/IR/DebugInfo.h>
#include <llvm/IR/InstIterator.h>

#include <algorithm>

#include "frontend/stream_arrays.hpp"

namespace epiline::frontend {

namespace {

void check_parameters(const top_description& top) {
  if (top.parameters.empty())
    refuse(top.place, "the top has no parameters: ports are made of them: give it hls::stream references");
  std::set<std::string> names;
  for (const auto& [index, name] : top.parameters)
    if (!name.empty() && !names.insert(name).second)
      refuse(top.place,
             fmt::format("two ports are named '{}', one of them for a stream of an array: rename a parameter", name));
}

}  // namespace

llvm::Function* find_top(llvm::Module& module, const std::string& top) {
  const std::size_t scope = top.rfind("::");
  const std::string base = scope == std::string::npos ? top : top.substr(scope + 2);
  llvm::Function* found = nullptr;
  for (llvm::Function& function : module)
    if (const llvm::DISubprogram* program = function.getSubprogram();
        !function.isDeclaration() && program != nullptr && program->getName() == base)
      found = &function;
  return found;
}

top_description describe_top(const llvm::Function& top, llvm::Module& module) {
  top_description result;
  const std::map<unsigned, unsigned> arrays = stream_arrays(module);
  const auto add = [&](unsigned position, const std::string& name) {
    const unsigned index = flat_index(arrays, position);
    const auto array = arrays.find(position);
    if (array == arrays.end()) {
      result.parameters.try_emplace(index, name);
      return;
    }
    for (unsigned i = 0; i < array->second; ++i)
      result.parameters.try_emplace(index + i, fmt::format("{}_{}", name, i));
  };
  result.place = place_of(top);
  for (const llvm::Instruction& instruction : llvm::instructions(top))
    for (const llvm::DbgVariableRecord& record : llvm::filterDbgVars(instruction.getDbgRecordRange()))
      if (const unsigned argument = record.getVariable()->getArg();
          argument != 0 && record.getVariable()->getScope()->getSubprogram() == top.getSubprogram())
        add(argument - 1, record.getVariable()->getName().str());
  if (const unsigned returned = returned_position(module); returned != 0) add(returned, returned_name);
  check_parameters(result);
  return result;
}

std::string fresh_name(const std::string& wanted, const top_description& top, std::set<std::string>& taken) {
  std::string name = wanted;
  const auto is_parameter = [&] {
    return std::any_of(top.parameters.begin(), top.parameters.end(),
                       [&](const auto& parameter) { return parameter.second == name; });
  };
  for (unsigned number = 2; taken.count(name) != 0 || is_parameter(); ++number)
    name = fmt::format("{}_{}", wanted, number);
  taken.insert(name);
  return name;
}

}  // namespace epiline::frontend
