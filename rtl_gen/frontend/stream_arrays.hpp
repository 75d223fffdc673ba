#pragma once
// Tops that take arrays of streams: `hls::stream<T> in[4]` counts as the four parameters in_0 .. in_3.

#include <llvm/IR/Module.h>

#include <map>
#include <string>
#include <vector>

namespace epiline::frontend {

/// A parameter of a top that is written as an array, `in[LANES]`: to the compiler it is a pointer.
struct array_parameter {
  std::string size;        // what stands in the first brackets; empty: no array
  bool is_stream = false;  // says an INTERFACE pragma: its elements come or go one by one, however few they are
};

/// The parameters of each top. Empty if the top's definition is not found.
[[nodiscard]] std::vector<std::vector<array_parameter>> find_array_parameters(const std::string& preprocessed,
                                                                              const std::vector<std::string>& tops);

/// The number of streams in each parameter that is an array of them, by its position from 0, as the call of the top
/// notes it.
[[nodiscard]] std::map<unsigned, unsigned> stream_arrays(llvm::Module& module);

/// The number of elements in each array of values that is one value.
[[nodiscard]] std::map<unsigned, unsigned> value_arrays(llvm::Module& module);

/// The same of those whose elements come or go one by one.
[[nodiscard]] std::map<unsigned, unsigned> data_arrays(llvm::Module& module);

/// The position behind the last parameter if the top returns a value; otherwise 0.
[[nodiscard]] unsigned returned_position(llvm::Module& module);

/// The index of the parameter at `position` when every stream of an array counts as one.
[[nodiscard]] unsigned flat_index(const std::map<unsigned, unsigned>& arrays, unsigned position);

/// The port's name of what a top returns: the vendors'.
inline constexpr const char* returned_name = "ap_return";

}  // namespace epiline::frontend
