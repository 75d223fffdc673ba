#include <cmath>

#include "../drive.hpp"
namespace kernel_cordic {
#include "../kernels/cordic.cpp"
}
using namespace kernel_cordic;
EPILINE_LEAVES(request_t, v.vectoring, v.x, v.y, v.angle);
EPILINE_LEAVES(answer_t, v.x, v.y, v.angle);

// Against the exact sines, arc tangents and lengths, within what sixteen iterations and the word lengths leave.
EPILINE_DRIVER(cordic) {
  auto& in = s.input<request_t>("in");
  auto& out = s.output<answer_t>("out");
  std::vector<request_t> requests;
  for (int i = 0; i < 150; ++i) {
    request_t r = s.any<request_t>();
    if (i < 16) {  // every octant, and the axes
      r.vectoring = i % 2 == 0;
      r.x = (i / 2 % 3 - 1) * 30000;
      r.y = (i / 6 % 3 - 1) * 30000;
      r.angle = i * 4096;
    }
    requests.push_back(r);
    in.push(r);
    cordic(in.stream, out.stream);
  }
  const auto answers = out.drain();
  s.expect(answers.size() == requests.size(), "an answer a request");
  const double gain = 1.646760258, turn = 2 * std::acos(-1.0);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const request_t& r = requests[i];
    const double x = int(r.x), y = int(r.y), length = std::hypot(x, y);
    const auto near = [&](double found, double wanted, double tolerance, const char* what) {
      s.expect(std::abs(found - wanted) <= tolerance, std::string(what) + " of request " + std::to_string(i) + ": " +
                                                          std::to_string(found) + ", wanted " + std::to_string(wanted));
    };
    if (r.vectoring) {
      near(int(answers[i].x), gain * length, 14, "length");
      if (length < 64) continue;  // too short to have a direction
      const double off = std::remainder(int(answers[i].angle) / 65536.0 - std::atan2(y, x) / turn, 1.0);
      near(off * turn * length, 0, 14 + length * turn / 16384, "direction");
    } else {
      const double a = int(r.angle) / 65536.0 * turn;
      near(int(answers[i].x), gain * (x * std::cos(a) - y * std::sin(a)), 16, "x");
      near(int(answers[i].y), gain * (x * std::sin(a) + y * std::cos(a)), 16, "y");
    }
  }
}
