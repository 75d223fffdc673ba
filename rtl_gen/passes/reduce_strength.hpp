#pragma once

#include "dataflow/graph.hpp"

namespace epiline::passes {

/// Replaces products with constants that need few terms by shifted sums and differences (canonical signed digits), and
/// divisions and remainders by constants by products. Meant to run when widths are minimal (narrow_widths.hpp), because
/// what it makes is longer than what it replaces.
/// A product stays when it would need more than `max_terms` shifted terms.
void reduce_strength(dataflow::graph& g, unsigned max_terms = 4);

}  // namespace epiline::passes
