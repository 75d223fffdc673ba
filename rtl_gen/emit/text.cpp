#include "emit/text.hpp"

#include <llvm/ADT/SmallString.h>
#include <llvm/ADT/StringRef.h>

#include <cctype>

namespace epiline::emit {

std::string literal(const llvm::APInt& value) {
  const unsigned width = value.getBitWidth();
  llvm::SmallString<64> digits;
  const bool small = value.getActiveBits() <= 10;
  value.toString(digits, small ? 10 : 16, false, false);
  std::string text(digits.str());
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return fmt::format("{}'{}{}", width, small ? 'd' : 'h', text);
}

std::string literal(unsigned width, std::uint64_t value) { return literal(llvm::APInt(width, value)); }

}  // namespace epiline::emit
