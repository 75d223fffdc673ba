#pragma once
// What clang says of a source that does not compile, told to somebody who wrote a kernel and knows nothing of wrappers,
// type headers and template instantiations.

#include <string>

#include "frontend/pragmas.hpp"

namespace epiline::frontend {

/// Clang's messages as "FILE:LINE: error: TEXT: ADVICE", each with the line it speaks of. An error inside the type
/// headers is told at the user's line that led there; one in the call that stands for a pragma is told of the pragma.
[[nodiscard]] std::string explain_messages(const std::string& messages, const pragma_places& pragmas);

/// Why `top` cannot be called: `listing` is what clang knows under that name (-ast-dump-filter), `source` the file as
/// a person would write its path.
[[nodiscard]] std::string explain_top(const std::string& top, const std::string& source, const std::string& listing);

}  // namespace epiline::frontend
