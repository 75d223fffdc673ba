#pragma once
// Proves the passes as the pipeline runs them, one line a pass, and keeps what came out for proof.json.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "prove/prove_pass.hpp"

namespace epiline::prove {

class session {
 public:
  /// `print` gets one line, without its end, for every pass.
  session(options given, std::function<void(const std::string&)> print);

  /// To be called after each pass (passes::pipeline_options::observer) on the graph of `process`.
  void pass_ran(const std::string& process, std::string_view pass, const dataflow::graph& before,
                const dataflow::graph& after);

  [[nodiscard]] bool refuted() const;
  /// The contents of proof.json (docs/proofs.md).
  [[nodiscard]] nlohmann::json to_json() const;

 private:
  struct entry {
    std::string process;
    proof found;
  };
  options given_;
  std::function<void(const std::string&)> print_;
  std::vector<entry> entries_;
};

/// One line: "narrow_widths: proved (0.12 s)"; for a refutation more lines, with the difference and its start.
[[nodiscard]] std::string describe(const proof& p);

}  // namespace epiline::prove
