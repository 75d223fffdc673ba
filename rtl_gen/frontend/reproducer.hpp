#pragma once

#include <string>

namespace epiline::frontend {

/// A source that shows the same without the user's headers, made of the preprocessed wrapper around it (with clang's
/// line markers): the user's files are in it, those of the system and of the types are included again.
[[nodiscard]] std::string standalone_source(const std::string& preprocessed);

}  // namespace epiline::frontend
