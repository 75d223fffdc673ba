#include "prove/prove_pass.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dataflow/random_graph.hpp"
#include "dataflow/text.hpp"
#include "passes/pipeline.hpp"
#include "prove/session.hpp"

namespace epiline::prove {
namespace {

using dataflow::graph;
using dataflow::testing::random_graph;

TEST(prove_pass, proves_the_default_pipeline_on_random_graphs) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    graph g = random_graph(seed);
    passes::pipeline_options options;
    options.forwarded_writes = 2;
    options.observer = [&](std::string_view pass, const graph& before, const graph& after) {
      const proof p = prove_pass(std::string(pass), before, after, {1});
      EXPECT_NE(p.result, verdict::refuted) << "seed " << seed << '\n' << describe(p);
    };
    run_default_pipeline(g, options);
  }
}

}  // namespace
}  // namespace epiline::prove
