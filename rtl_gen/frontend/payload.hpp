#pragma once
// How a C++ value travels as a token: its leaves side by side, the first member in the low bits.

#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/IR/DataLayout.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <cstdint>
#include <string>
#include <vector>

#include "dataflow/graph.hpp"
#include "frontend/source.hpp"

namespace epiline::frontend {

/// One scalar of a payload. `path` are the constant indices of a getelementptr from the payload's type to it.
struct leaf {
  std::vector<unsigned> path;
  llvm::IntegerType* storage = nullptr;  // as it lies in memory: at least `width` bits
  unsigned width = 0;
  bool is_signed = false;
  unsigned axis_field = 0;  // 1 tdata .. 7 tdest; 0: not a member of an AXI4-Stream payload
};

/// Recognises { storage, [0 x [W x i8|i16]] }, the layout of ap_uint<W>/ap_int<W> in the synthesis build.
/// Returns whether `type` has it, and then the width and sign.
bool is_arbitrary_precision(llvm::Type* type, unsigned& width, bool& is_signed);

/// The sum of `of` over the scalars that a type is made of, of an array every element.
[[nodiscard]] std::uint64_t sum_of_scalars(llvm::Type* type, llvm::function_ref<std::uint64_t(llvm::Type*)> of);

/// Whether element `index` fills a gap: clang writes the gaps of a struct that mixes C integers with ap types as
/// explicit byte arrays.
[[nodiscard]] bool is_padding(const llvm::StructType& structure, unsigned index, const llvm::DataLayout& layout);

/// Refuses (at `place`) a payload type with a member that is_padding() takes for padding: an array of bytes that fills
/// the very place where padding would be. The debug information of the module tells.
void refuse_members_like_padding(llvm::Type* type, const llvm::Module& module, const source_place& place);

/// The leaves of a payload type in order; more than one AXI4-Stream beat is no such beat. Refuses (at `place`) floating
/// point, pointers and other foreign types. What is padding is told by the module's debug information where the type
/// alone does not tell.
[[nodiscard]] std::vector<leaf> leaves_of(llvm::Type* type, const llvm::Module& module, const source_place& place);

/// The RTL fields of a port that carries these leaves: tdata alone, or one group an AXI4-Stream member.
[[nodiscard]] std::vector<dataflow::field> fields_of(const std::vector<leaf>& leaves);

[[nodiscard]] unsigned width_of(const std::vector<leaf>& leaves);

/// Stores a token's leaves into the object at `pointer`, and the reverse.
void unpack_token(llvm::IRBuilderBase& builder, llvm::Value* token, llvm::Value* pointer, llvm::Type* type,
                  const std::vector<leaf>& leaves);
[[nodiscard]] llvm::Value* pack_token(llvm::IRBuilderBase& builder, llvm::Value* pointer, llvm::Type* type,
                                      const std::vector<leaf>& leaves);

}  // namespace epiline::frontend
