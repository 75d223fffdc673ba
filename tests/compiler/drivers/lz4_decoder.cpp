#include "../drive.hpp"
namespace kernel_lz4_decoder {
#include "../kernels/lz4_decoder.cpp"
}
using namespace kernel_lz4_decoder;

// Random sequences of literals and matches, as an encoder writes them; the text grows beside.
EPILINE_DRIVER(lz4_decoder) {
  auto& in = s.input<byte_t>("in");
  auto& out = s.output<byte_t>("out");
  std::vector<int> wanted;
  std::size_t blocks = 0;
  for (const int sequences : {8, 0, 25, 3}) {
    std::vector<int> text, code;
    const auto length_bytes = [&](int rest) {
      for (; rest >= 255; rest -= 255) code.push_back(255);
      code.push_back(rest);
    };
    for (int n = 0; n <= sequences; ++n) {
      const bool end = n == sequences;
      const int literals = n == 0 || end  ? int(s.number(5, 20))
                           : s.chance(30) ? 0
                                          : int(s.number(1, n == 2 ? 290 : 17));
      const int match = s.chance(20) ? int(s.number(19, n == 1 ? 300 : 40)) : int(s.number(4, 18));
      code.push_back(std::min(literals, 15) << 4 | (end ? 0 : std::min(match - 4, 15)));
      if (literals >= 15) length_bytes(literals - 15);
      for (int i = 0; i < literals; ++i) {
        text.push_back(int(s.number(0, 255)));
        code.push_back(text.back());
      }
      if (end) break;
      const auto offset =
          s.chance(40) ? 1 + s.number(0, 3) : s.number(1, std::min<std::int64_t>(1023, std::int64_t(text.size())));
      code.push_back(int(offset & 255));
      code.push_back(int(offset >> 8));
      if (match - 4 >= 15) length_bytes(match - 4 - 15);
      for (int i = 0; i < match; ++i) text.push_back(text[text.size() - std::size_t(offset)]);
    }
    for (std::size_t i = 0; i < code.size(); ++i) {
      byte_t beat = s.any<byte_t>();
      beat.data = code[i];
      beat.last = i + 1 == code.size();
      in.push(beat);
    }
    for (std::size_t i = 0; i < text.size(); ++i) wanted.push_back(text[i] * 2 + (i + 1 == text.size()));
    ++blocks;
    lz4_decoder(in.stream, out.stream);
  }
  std::vector<int> found;
  for (const byte_t& beat : out.drain()) found.push_back(int(beat.data) * 2 + int(beat.last));
  s.expect_equal(found, wanted, "out");
}
