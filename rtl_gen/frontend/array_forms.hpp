#pragma once
// What an array of the source becomes: scalars, multiplexed registers, or the words of a memory or table. Decided for
// each dimension of a variable by how it is indexed, by its size and by the pragmas that name it.

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "frontend/variable_accesses.hpp"

namespace epiline::frontend {

/// What one index of a path is for.
enum class index_role : std::uint8_t { constant, multiplexed, address };

/// Of one variable.
class array_forms {
 public:
  array_forms(const variable& of, const variable_accesses& accesses);

  /// What each step's index is for.
  [[nodiscard]] std::vector<index_role> roles_of(const path_steps& path) const;

  /// Whether #pragma HLS RESET off names it.
  [[nodiscard]] bool is_unreset(const path_steps& path) const;

  /// That of #pragma HLS DEPENDENCE; 0 without.
  [[nodiscard]] unsigned promised_distance(const path_steps& path) const;

 private:
  void apply_pragma(const path_steps& path, llvm::CallInst& call);
  void partition(const path_steps& path, std::size_t length, const std::string& shape, unsigned dimension,
                 const llvm::CallInst& call);
  [[nodiscard]] bool is_partitioned(const path_steps& path, std::size_t position) const;

  const variable& variable_;
  // Shapes of dimensions and parts.
  std::set<std::string> dynamic_;  // indexed at run time
  std::vector<std::pair<std::string, unsigned>> partitioned_;
  std::vector<std::pair<std::string, unsigned>> distances_;
  std::vector<std::string> unreset_;
};

}  // namespace epiline::frontend
