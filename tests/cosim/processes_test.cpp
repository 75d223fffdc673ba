// A top made of processes in Verilator: the fills of its FIFOs, and a standstill that is told by the streams' names.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "cosim/stream_driver.hpp"
#include "dataflow/network_interpreter.hpp"
#include "dataflow/network_text.hpp"
#include "shallow_fifo_rtl_model.hpp"

namespace epiline::cosim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

drive_request one_call(unsigned count) {
  token_list call(8);
  call.push_integer(count);
  token_list in(8);
  for (unsigned i = 0; i < count; ++i) in.push_integer(3 * i);
  drive_request request;
  request.inputs = {{"call", call}, {"in", in}};
  request.expected = {{"out", count}};
  return request;
}

drive_options impatient() {
  drive_options options;
  options.patience = 300;
  options.quiet_clocks = 20;
  return options;
}

TEST(processes, tell_how_full_their_streams_were) {
  const auto model = make_shallow_fifo_rtl_model(1);
  const drive_result result = drive(*model, one_call(4), impatient());
  ASSERT_EQ(result.outputs.at("out").tokens.size(), 4u);
  ASSERT_EQ(model->fifos().size(), 2u);
  EXPECT_EQ(model->fifos()[0].depth, 2u);
  // Four tokens wait for the late ones; what does not fit into the FIFO stands in the processes' registers.
  EXPECT_GT(result.peak_fills.at("early"), 0u);
  EXPECT_LE(result.peak_fills.at("early"), 2u);
  EXPECT_EQ(model->fill(0)->now, 0u);
}

TEST(processes, that_stand_still_name_the_full_and_the_empty_stream) {
  const auto model = make_shallow_fifo_rtl_model(2);
  try {
    static_cast<void>(drive(*model, one_call(200), impatient()));
    FAIL() << "200 tokens cannot wait in two places";
  } catch (const drive_error& error) {
    EXPECT_EQ(error.why(), drive_error::reason::deadlock);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("stream 'early' is full: 2 of 2 tokens, at most 2"),
                                    HasSubstr("stream 'late' is empty: 0 of 2 tokens, at most 0")));
  }
}

TEST(processes, stand_still_in_the_graphs_interpreter_too) {
  std::ifstream file(SHALLOW_FIFO_GRAPH);
  std::ostringstream text;
  text << file.rdbuf();
  dataflow::network_interpreter machine(dataflow::parse_network(text.str()));
  machine.push(machine.find_port("call", true), llvm::APInt(8, 200));
  for (unsigned i = 0; i < 200; ++i) machine.push(machine.find_port("in", true), llvm::APInt(8, i));
  EXPECT_EQ(machine.run_until_blocked(10'000).last, dataflow::outcome::blocked);
  EXPECT_THAT(machine.message(), AllOf(HasSubstr("'shallow_fifo_send' waits for room in stream 'early', which is full "
                                                 "(2 of 2)"),
                                       HasSubstr("'shallow_fifo_meet' waits for a token of stream 'late', which is "
                                                 "empty")));
}

}  // namespace
}  // namespace epiline::cosim
