#include "../drive.hpp"
namespace regression_bytes_between {
#include "../regressions/bytes_between.cpp"
}
using regression_bytes_between::record_t;
EPILINE_LEAVES(record_t, v.kind, v.bytes[0], v.bytes[1], v.bytes[2], v.value, v.more[0], v.more[1], v.more[2],
               v.more[3], v.more[4], v.more[5], v.more[6], v.wide, v.last);

EPILINE_DRIVER(bytes_between) {
  auto& in = s.input<record_t>("in");
  auto& out = s.output<record_t>("out");
  const auto byte = [&] { return static_cast<unsigned char>(s.number(0, 255)); };
  std::vector<unsigned> wanted;
  for (int i = 0; i < 100; ++i) {
    record_t r{};
    r.kind = byte();
    for (unsigned char& b : r.bytes) b = byte();
    for (unsigned char& b : r.more) b = byte();
    r.value = static_cast<unsigned>(s.number(0, 0x1ffff));
    r.wide = static_cast<std::uint64_t>(s.number(0, 0x7fffffff)) << 31;
    r.last = byte();
    in.push(r);
    wanted.push_back(static_cast<unsigned>(r.bytes[0] ^ r.bytes[2]));
    regression_bytes_between::bytes_between(in.stream, out.stream);
  }
  std::vector<unsigned> found;
  for (const record_t& r : out.drain()) found.push_back(r.bytes[1]);
  s.expect_equal(found, wanted, "out");
}
