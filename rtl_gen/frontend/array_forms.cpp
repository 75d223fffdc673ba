#include "frontend/array_forms.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "frontend/aggregates.hpp"
#include "frontend/checks.hpp"

namespace epiline::frontend {

namespace {

constexpr std::uint64_t largest_multiplexer = 4096;  // registers that one index chooses from

}  // namespace

array_forms::array_forms(const variable& of, const variable_accesses& accesses) : variable_(of) {
  for (const auto& [path, call] : accesses.pragmas) apply_pragma(path, *call);
  for (const scalar_access& access : accesses.accesses)
    for (std::size_t i = 0; i < access.path.size(); ++i)
      if (access.path[i].dynamic != nullptr) dynamic_.insert(shape_of(access.path, i));
}

void array_forms::apply_pragma(const path_steps& path, llvm::CallInst& call) {
  const llvm::StringRef pragma = call.getCalledFunction()->getName();
  const bool is_dependence = pragma == "__epiline_pragma_dependence";
  // A pointer to an array may have decayed to one to its first element; the pragma speaks of the whole.
  std::size_t length = path.size();
  while (length > 0 && path[length - 1].is_array() && path[length - 1].constant == 0 &&
         path[length - 1].dynamic == nullptr)
    --length;
  const std::string shape = shape_of(path, length);
  if (pragma == "__epiline_pragma_reset") {
    if (variable_.initial == nullptr)
      refuse(place_of(call),
             fmt::format("#pragma HLS RESET off: '{}' is not static, so nothing resets it: remove the pragma",
                         variable_.name));
    unreset_.push_back(shape);
    return;
  }
  const int value = pragma_number(call, 1, is_dependence ? 1 : 0);
  if (is_dependence)
    distances_.emplace_back(shape, static_cast<unsigned>(value));
  else
    partition(path, length, shape, static_cast<unsigned>(value), call);
}

bool array_forms::is_unreset(const path_steps& path) const {
  const std::string shape = shape_of(path, path.size());
  return std::any_of(unreset_.begin(), unreset_.end(),
                     [&](const std::string& prefix) { return llvm::StringRef(shape).starts_with(prefix); });
}

void array_forms::partition(const path_steps& path, std::size_t length, const std::string& shape, unsigned dimension,
                            const llvm::CallInst& call) {
  unsigned dimensions = 0;
  llvm::Type* type = length == 0 ? variable_.type : step_type(path[length - 1]);
  for (; llvm::isa<llvm::ArrayType>(type); ++dimensions) type = type->getArrayElementType();
  const bool is_object = llvm::isa<llvm::StructType>(type);  // whose arrays are meant too
  if (dimensions == 0 && !is_object)
    refuse(place_of(call), fmt::format("#pragma HLS ARRAY_PARTITION: '{}' is not an array", variable_.name));
  if (dimension > dimensions && !is_object)
    refuse(place_of(call), fmt::format("#pragma HLS ARRAY_PARTITION dim={}: '{}' has {} dimension{}", dimension,
                                       variable_.name, dimensions, dimensions == 1 ? "" : "s"));
  partitioned_.emplace_back(shape, dimension);
}

bool array_forms::is_partitioned(const path_steps& path, std::size_t position) const {
  const std::string shape = shape_of(path, position);
  for (const auto& [prefix, dimension] : partitioned_) {
    if (!llvm::StringRef(shape).starts_with(prefix)) continue;
    if (dimension == 0) return true;
    unsigned count = 1;
    for (std::size_t i = 0; i < position; ++i)
      if (path[i].is_array() && shape_of(path, i).size() >= prefix.size()) ++count;
    if (count == dimension) return true;
  }
  return false;
}

unsigned array_forms::promised_distance(const path_steps& path) const {
  const std::string shape = shape_of(path, path.size());
  unsigned distance = 0;
  for (const auto& [prefix, value] : distances_)
    if (llvm::StringRef(shape).starts_with(prefix)) distance = std::max(distance, value);
  return distance;
}

std::vector<index_role> array_forms::roles_of(const path_steps& path) const {
  std::vector<index_role> roles(path.size(), index_role::constant);
  std::uint64_t words = 1;
  bool any_large = false;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i].is_array() && dynamic_.count(shape_of(path, i)) != 0) {
      words *= path[i].size();
      any_large = any_large || (path[i].size() > largest_register_array && !is_partitioned(path, i));
    }
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!path[i].is_array() || dynamic_.count(shape_of(path, i)) == 0) continue;
    const bool multiplexed = !variable_.is_constant && (is_partitioned(path, i) || words <= largest_register_array ||
                                                        (any_large && path[i].size() <= largest_register_array));
    roles[i] = multiplexed ? index_role::multiplexed : index_role::address;
    if (multiplexed && path[i].size() > largest_multiplexer)
      refuse(variable_.place, fmt::format("'{}' has {} elements, reached by an index known at run time: too many for "
                                          "registers: leave out ARRAY_PARTITION, and it becomes a memory",
                                          variable_.name, path[i].size()));
  }
  return roles;
}

}  // namespace epiline::frontend
