// The simulation models of the ECP5 cells: a module and its netlist must send the same tokens.

#include <gmock/gmock.h>

#include <random>

#include "cosim/stream_driver.hpp"
#include "rams_netlist_model.hpp"
#include "rams_rtl_model.hpp"

namespace epiline::cosim {
namespace {

constexpr std::size_t delay = 9;

token_list random_tokens(std::size_t count) {
  std::mt19937 random(3);
  token_list tokens(80);
  for (std::size_t index = 0; index < count; ++index) {
    const std::array<std::uint32_t, 3> token{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random()),
                                             static_cast<std::uint32_t>(random()) & 0xffffu};
    tokens.push_back(token);
  }
  return tokens;
}

/// What rams.v does, for tokens `newest` and the one nine before it.
std::array<std::uint32_t, 3> expected_token(std::span<const std::uint32_t> newest,
                                            std::span<const std::uint32_t> oldest) {
  const std::uint64_t index = bits_at(newest, 71, 9);
  const std::uint64_t product = bits_at(newest, 0, 18) * bits_at(newest, 18, 18);
  std::array<std::uint32_t, 3> token{};
  set_bits_at(token, 0, 40, bits_at(oldest, 0, 40));
  set_bits_at(token, 40, 2, bits_at(oldest, 40, 2) ^ bits_at({{static_cast<std::uint32_t>(product)}}, 4, 2));
  set_bits_at(token, 42, 9, bits_at(oldest, 58, 9));
  set_bits_at(token, 51, 4, bits_at(oldest, 67, 4) ^ (product & 0xf));
  set_bits_at(token, 64, 16, (index * index & 0xffff) ^ product >> 20);
  set_bits_at(token, 18, 18, bits_at(token, 18, 18) ^ bits_at(oldest, 40, 18));
  return token;
}

class netlist_cells : public testing::TestWithParam<int> {};

TEST_P(netlist_cells, send_what_the_module_sends) {
  // Enough tokens to go round every memory more than once.
  const token_list tokens = random_tokens(5000);
  drive_request request;
  request.inputs = {{"in", tokens}};
  request.expected = {{"out", tokens.size() - delay}};
  drive_options options;
  options.seed = 42;
  options.stalls = {{"in", {GetParam(), 1}}, {"out", {GetParam(), 1}}};
  const token_list of_netlist = drive(*make_rams_netlist_model(1), request, options).outputs.at("out").tokens;
  const token_list of_rtl = drive(*make_rams_rtl_model(1), request, options).outputs.at("out").tokens;
  ASSERT_EQ(of_rtl.size(), tokens.size() - delay);
  for (std::size_t index = 0; index < of_rtl.size(); ++index) {
    const auto expected = expected_token(tokens[index + delay], tokens[index]);
    ASSERT_THAT(of_rtl[index], testing::ElementsAreArray(expected)) << "token " << index;
    ASSERT_THAT(of_netlist[index], testing::ElementsAreArray(expected)) << "token " << index;
  }
}

INSTANTIATE_TEST_SUITE_P(stalls, netlist_cells, testing::Values(0, 50));

}  // namespace
}  // namespace epiline::cosim
