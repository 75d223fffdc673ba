#include "../drive.hpp"
namespace kernel_string_search {
#include "../kernels/string_search.cpp"
}
using namespace kernel_string_search;
EPILINE_LEAVES(pattern_byte_t, v.value, v.care, v.last);
EPILINE_LEAVES(match_t, v.position, v.end);

EPILINE_DRIVER(string_search) {
  auto& pattern = s.input<pattern_byte_t>("pattern");
  auto& text = s.input<word_t>("text");
  auto& matches = s.output<match_t>("matches");
  std::vector<unsigned> wanted;
  unsigned occurrences = 0;
  for (const int length : {1, 3, 16, 2, 5, 4}) {
    std::vector<std::pair<int, bool>> bytes;
    for (int i = 0; i < length; ++i) {
      const bool care = i == 0 || s.chance(70);
      bytes.emplace_back(int(s.number('a', 'b')), care);
      pattern.push({static_cast<unsigned char>(bytes.back().first), care, i + 1 == length});
    }
    std::vector<int> letters;
    while (letters.size() < 90) {
      if (s.chance(8)) {  // the pattern itself, now and then
        for (const auto& byte : bytes) letters.push_back(byte.first);
      }
      letters.push_back(int(s.number('a', length > 4 ? 'b' : 'c')));
    }
    const std::size_t size = length == 4 ? 2 : letters.size() - std::size_t(s.number(0, 3));
    for (std::size_t i = 0; i < size; i += 4) {
      word_t w = s.any<word_t>();
      w.keep = 0;
      for (std::size_t b = 0; b < 4 && i + b < size; ++b) {
        w.data.range(int(8 * b + 7), int(8 * b)) = letters[i + b];
        w.keep[int(b)] = 1;
      }
      w.last = i + 4 >= size;
      text.push(w);
    }
    for (std::size_t at = 0; at + std::size_t(length) <= size; ++at) {
      bool equal = true;
      for (std::size_t i = 0; i < bytes.size(); ++i)
        equal = equal && (!bytes[i].second || letters[at + i] == bytes[i].first);
      if (!equal) continue;
      wanted.push_back(2 * unsigned(at));
      ++occurrences;
    }
    wanted.push_back(2 * unsigned(size) + 1);
    string_search(pattern.stream, text.stream, matches.stream);
  }
  s.expect(occurrences > 20, "there is something to find");
  std::vector<unsigned> found;
  for (const match_t& m : matches.drain()) found.push_back(2 * m.position + unsigned(m.end));
  s.expect_equal(found, wanted, "matches");
}
