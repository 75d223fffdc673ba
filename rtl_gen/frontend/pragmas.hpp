#pragma once
// `#pragma HLS ...` lines become calls, so that clang resolves their variables in scope and they travel with the code
// through inlining and templates. Each pragma is honoured, accepted because the flow does the same by itself, or
// refused: none is ignored in silence.

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace epiline::frontend {

/// Where pragmas stand, by file and line: their names.
using pragma_places = std::map<std::pair<std::string, unsigned>, std::string>;

struct pragma_rewrite {
  std::string source;              // preprocessed source, pragmas replaced by calls on the same lines
  std::vector<std::string> notes;  // pragmas that have no effect here and why, "FILE:LINE: note: ..."
  pragma_places places;
};

/// The parameters that a function's body declares to be streams: `INTERFACE axis port=NAME`, and ap_fifo.
[[nodiscard]] std::set<std::string> stream_ports(const std::string& body);

/// Rewrites preprocessed source (with clang's line markers). Throws `refused` for a pragma that cannot be honoured.
[[nodiscard]] pragma_rewrite rewrite_pragmas(const std::string& preprocessed);

}  // namespace epiline::frontend
