#pragma once
// Tops that take arrays of streams: `hls::stream<T> in[4]` counts as the four parameters in_0 .. in_3.

#include <llvm/IR/Module.h>

#include <map>
#include <string>
#include <vector>

namespace epiline::frontend {

/// What stands in the brackets of each parameter of each top that is written as an array of one dimension, `in[LANES]`,
/// and nothing for others: to the compiler such a parameter is a pointer. Empty if the top's definition is not found.
[[nodiscard]] std::vector<std::vector<std::string>> sizes_of_array_parameters(const std::string& preprocessed,
                                                                              const std::vector<std::string>& tops);

/// The number of streams in each parameter that is an array of them, by its position from 0, as the call of the top
/// notes it.
[[nodiscard]] std::map<unsigned, unsigned> stream_arrays(llvm::Module& module);

/// The same of every array, be it of streams or of values.
[[nodiscard]] std::map<unsigned, unsigned> all_arrays(llvm::Module& module);

/// The position behind the last parameter if the top returns a value; otherwise 0.
[[nodiscard]] unsigned returned_position(llvm::Module& module);

/// The index of the parameter at `position` when every stream of an array counts as one.
[[nodiscard]] unsigned flat_index(const std::map<unsigned, unsigned>& arrays, unsigned position);

/// The port's name of what a top returns: the vendors'.
inline constexpr const char* returned_name = "ap_return";

}  // namespace epiline::frontend
