#include "../drive.hpp"
namespace regression_table_in_recurrence {
#include "../regressions/table_in_recurrence.cpp"
}

EPILINE_DRIVER(table_in_recurrence) {
  auto& in = s.input<ap_uint<8>>("in");
  auto& out = s.output<ap_uint<32>>("out");
  std::uint32_t crc = 0xffffffff;  // bit by bit, without a table
  std::vector<std::uint64_t> wanted;
  for (unsigned i = 0; i < 100; ++i) {
    const unsigned x = (i * 91 + 5) % 256;
    in.push(x);
    crc ^= x;
    for (int k = 0; k < 8; ++k) crc = (crc & 1) != 0 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
    wanted.push_back(crc);
    regression_table_in_recurrence::table_in_recurrence(in.stream, out.stream);
  }
  std::vector<std::uint64_t> found;
  for (const auto& word : out.drain()) found.push_back(word.to_uint64());
  s.expect_equal(found, wanted, "out");
}
