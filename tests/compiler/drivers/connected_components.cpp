#include <map>
#include <set>

#include "../drive.hpp"
namespace kernel_connected_components {
#include "../kernels/connected_components.cpp"
}
using namespace kernel_connected_components;
EPILINE_LEAVES(equivalence_t, v.smaller, v.larger, v.last);

// Labels joined by the pairs must divide the foreground exactly as filling from every pixel does.
EPILINE_DRIVER(connected_components) {
  auto& mask = s.input<ap_axiu<1, 1, 1, 1>>("mask");
  auto& labels = s.output<label_t>("labels");
  auto& equivalences = s.output<equivalence_t>("equivalences");
  const int sizes[][3] = {{12, 10, 45}, {1, 1, 100}, {64, 5, 60}, {7, 9, 0}, {9, 7, 100}, {16, 12, 35}};
  for (const auto& size : sizes) {
    const int cols = size[0], rows = size[1];
    std::vector<int> image;
    for (int i = 0; i < cols * rows; ++i) {
      auto beat = s.any<ap_axiu<1, 1, 1, 1>>();
      beat.data = s.chance(unsigned(size[2]));
      image.push_back(int(beat.data));
      mask.push(beat);
    }
    s.call({{"rows", ap_uint<7>(rows)}, {"cols", ap_uint<7>(cols)}});
    connected_components(mask.stream, labels.stream, equivalences.stream, rows, cols);

    std::vector<int> component(image.size(), 0);
    int components = 0;
    for (int start = 0; start < cols * rows; ++start) {
      if (image[std::size_t(start)] == 0 || component[std::size_t(start)] != 0) continue;
      ++components;
      std::vector<int> open = {start};
      while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        if (component[std::size_t(at)] != 0) continue;
        component[std::size_t(at)] = components;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int y = at / cols + dy, x = at % cols + dx;
            if (y >= 0 && y < rows && x >= 0 && x < cols && image[std::size_t(y * cols + x)] != 0)
              open.push_back(y * cols + x);
          }
        }
      }
    }
    std::map<int, int> parent;
    const auto root = [&](int label) {
      while (parent.count(label) != 0) label = parent[label];
      return label;
    };
    int used = -1;
    for (const equivalence_t& e : equivalences.drain()) {
      if (e.last) {
        used = int(e.larger);
      } else {
        s.expect(e.smaller != 0 && e.smaller < e.larger, "the order of a pair");
        const int a = root(int(e.smaller)), b = root(int(e.larger));
        if (a != b) parent[b] = a;
      }
    }
    const auto found = labels.drain();
    s.expect(found.size() == image.size(), "a label a pixel");
    std::map<int, int> component_of;
    std::set<int> roots;
    int largest = 0;
    for (std::size_t i = 0; i < std::min(found.size(), image.size()); ++i) {
      s.expect((found[i] == 0) == (image[i] == 0), "background is 0");
      if (found[i] == 0) continue;
      largest = std::max(largest, int(found[i]));
      const int r = root(int(found[i]));
      roots.insert(r);
      s.expect(component_of.emplace(r, component[i]).first->second == component[i], "one component a joined label");
    }
    s.expect(int(roots.size()) == components, "as many joined labels as components");
    s.expect(used == largest, "the number of labels used");
  }
}
