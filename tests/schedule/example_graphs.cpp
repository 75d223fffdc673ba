#include "example_graphs.hpp"

namespace epiline::testing {

graph make_counter() {
  graph_builder b("counter");
  const auto in = b.stream("in", true, 4);
  const auto out = b.stream("out", false, 9);
  const node_id one = b.always();
  b.read(in, one);
  const auto [count, value] = b.state("count", 9, 0);
  b.line = 7;
  b.set(count, b.sum(value, b.constant(9, 1)), one);
  b.write(out, one, value);
  return b.g;
}

graph make_adder_pipeline() {
  graph_builder b("adders");
  const auto in = b.stream("in", true, 32);
  const auto out = b.stream("out", false, 32);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  node_id y = x;
  for (unsigned i = 0; i < 6; ++i) {
    b.line = 10 + i;
    y = b.sum(y, b.binary(operation::bit_xor, x, b.constant(32, 0x1234567u * (i + 1))));
  }
  b.write(out, one, y);
  return b.g;
}

graph make_filter() {
  graph_builder b("fir");
  const auto in = b.stream("in", true, 8);
  const auto out = b.stream("out", false, 20);
  const node_id one = b.always();
  node_id sample = b.read(in, one);
  node_id sum = b.constant(20, 0);
  for (unsigned tap = 0; tap < 8; ++tap) {
    b.line = 20 + tap;
    const node_id wide = b.extend(sample, 20);
    sum = b.sum(sum, b.binary(operation::multiply, wide, b.constant(20, 3 + 5 * tap)));
    const auto [r, value] = b.state("tap", 8, 0);
    b.set(r, sample, one);
    sample = value;
  }
  b.write(out, one, sum);
  return b.g;
}

graph make_histogram(unsigned distance) {
  graph_builder b("histogram");
  const auto in = b.stream("in", true, 8);
  const auto out = b.stream("out", false, 16);
  const node_id one = b.always();
  const node_id bin = b.read(in, one);
  const auto ram = b.memory("bins", 256, 16, distance);
  b.line = 30;
  const node_id old = b.load(ram, bin, one);
  b.line = 31;
  const node_id next = b.sum(old, b.constant(16, 1));
  b.line = 32;
  b.store(ram, bin, next, one);
  b.write(out, one, next);
  return b.g;
}

graph make_conditional_streams() {
  graph_builder b("conditional");
  const auto in_a = b.port("a", dataflow::port_kind::stream, true, {{"tdata", 8}, {"tuser", 1}, {"tlast", 1}});
  const auto in_b = b.stream("b", true, 8);
  const auto out = b.port("sum", dataflow::port_kind::stream, false, {{"tdata", 9}, {"tlast", 1}});
  const auto total_out = b.stream("total", false, 12);
  const node_id one = b.always();
  const auto [wants, wants_b] = b.state("wants_b", 1, 0);
  const auto [total, total_value] = b.state("total", 12, 100);
  const node_id a = b.read(in_a, one);
  const node_id other = b.read(in_b, wants_b);
  b.set(wants, b.slice(a, 8, 1), one);
  const node_id sum = b.sum(b.extend(b.slice(a, 0, 8), 9), b.extend(other, 9));
  const node_id odd = b.slice(sum, 0, 1);
  const node_id last = b.slice(a, 9, 1);
  b.write(out, odd, b.add(operation::concat, 10, {last, sum}));
  const node_id total_next = b.sum(total_value, b.extend(sum, 12));
  b.set(total, b.select(last, b.constant(12, 0), total_next), b.binary(operation::bit_or, odd, last));
  b.write(total_out, last, total_next);
  return b.g;
}

graph make_accumulator(unsigned width, unsigned adders) {
  graph_builder b("accumulator");
  const auto in = b.stream("in", true, width);
  const auto out = b.stream("out", false, width);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const auto [r, value] = b.state("running_sum", width, 5);
  node_id next = value;
  for (unsigned i = 0; i < adders; ++i) {
    b.line = 44 + i;
    next = b.sum(next, x);
  }
  b.set(r, next, one);
  b.write(out, one, next);
  return b.g;
}

graph make_calls() {
  graph_builder b("calls");
  const auto call = b.port("call", dataflow::port_kind::call, true, {{"length", 6}, {"gain", 8}});
  const auto in = b.stream("in", true, 8);
  const auto out = b.stream("out", false, 16);
  const auto result = b.port("sum", dataflow::port_kind::result, false, {{"tdata", 20}});
  const node_id one = b.always();
  // `left` tokens are still to come; 0: the next iteration is the call itself.
  const auto [left, left_value] = b.state("left", 6, 0);
  const auto [gain, gain_value] = b.state("gain", 8, 0);
  const auto [total, total_value] = b.state("sum", 20, 0);
  const node_id is_call = b.compare(operation::equal, left_value, b.constant(6, 0));
  const node_id is_token = b.invert(is_call);
  const node_id arguments = b.read(call, is_call);
  const node_id token = b.read(in, is_token);
  const node_id fewer = b.binary(operation::subtract, left_value, b.constant(6, 1));
  b.set(left, b.select(is_call, b.slice(arguments, 0, 6), fewer), one);
  b.set(gain, b.sum(b.slice(arguments, 6, 8), b.constant(8, 1)), is_call, true);
  b.g.patient = is_call;
  // Settled arithmetic on the patient parameter, used beside the tokens.
  const node_id bias = b.sum(b.extend(gain_value, 16), b.constant(16, 1000));
  const node_id scaled = b.binary(operation::multiply, b.extend(token, 16), b.extend(gain_value, 16));
  const node_id value = b.sum(scaled, bias);
  b.write(out, is_token, value);
  const node_id next_total = b.sum(total_value, b.extend(value, 20));
  const node_id last = b.binary(operation::bit_and, is_token, b.compare(operation::equal, fewer, b.constant(6, 0)));
  b.set(total, b.select(is_call, b.constant(20, 0), next_total), one);
  b.write(result, last, next_total);
  return b.g;
}

graph make_long_wait(unsigned chain) {
  graph_builder b("long_wait");
  const auto in = b.stream("in", true, 32);
  const auto out = b.stream("out", false, 32);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const node_id early = b.binary(operation::bit_xor, x, b.slice(b.add(operation::concat, 64, {x, x}), 7, 32));
  node_id y = x;
  for (unsigned i = 0; i < chain; ++i) {
    // Non-linear, so that the waiting value cannot be had from the chain's end.
    y = b.sum(y, b.add(operation::concat, 32, {b.slice(y, 0, 13), b.slice(y, 13, 19)}));
  }
  b.write(out, one, b.sum(y, early));
  return b.g;
}

graph make_many_waits(unsigned streams) {
  graph_builder b("many_waits");
  const node_id one = b.always();
  std::vector<node_id> tokens;
  for (unsigned i = 0; i < streams; ++i) tokens.push_back(b.read(b.stream("in" + std::to_string(i), true, 64), one));
  const auto out = b.stream("out", false, 64 * streams);
  for (unsigned i = 0; i < 8; ++i)
    tokens[0] = b.sum(tokens[0], b.add(operation::concat, 64, {b.slice(tokens[0], 0, 13), b.slice(tokens[0], 13, 51)}));
  b.write(out, one, b.add(operation::concat, 64 * streams, tokens));
  return b.g;
}

graph make_many_readers(unsigned levels) {
  graph_builder b("many_readers");
  const auto in = b.stream("in", true, 16);
  const auto out = b.stream("out", false, 16);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const node_id turned = b.slice(b.sum(x, b.constant(16, 0x1234)), 3, 1);
  node_id all = b.sum(x, b.add(operation::concat, 16, {b.slice(x, 0, 5), b.slice(x, 5, 11)}));
  for (unsigned i = 0; i < levels; ++i) {
    const auto [level, value] = b.state("level" + std::to_string(i), 16, i);
    const node_id moved = b.sum(value, b.select(turned, x, b.constant(16, i)));
    b.set(level, moved, i % 3 == 0 ? one : b.slice(x, 0, 1));
    all = b.binary(operation::bit_xor, all, value);
  }
  b.write(out, one, all);
  return b.g;
}

graph make_cleared_levels(unsigned levels) {
  graph_builder b("cleared_levels");
  const auto in = b.stream("in", true, 16);
  const auto out = b.stream("out", false, 16);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const node_id inside = b.slice(x, 15, 1);
  node_id late = x;
  for (unsigned i = 0; i < 6; ++i) late = b.sum(b.binary(operation::multiply, late, late), x);
  node_id all = late;
  for (unsigned i = 0; i < levels; ++i) {
    const auto [level, value] = b.state("level" + std::to_string(i), 16, i);
    b.set(level, b.select(inside, b.sum(late, b.constant(16, i)), b.constant(16, 0)), one);
    all = b.binary(operation::bit_xor, all, value);
  }
  b.write(out, one, all);
  return b.g;
}

graph make_small_memory() {
  graph_builder b("small_memory");
  const auto in = b.stream("in", true, 12);
  const auto out = b.stream("out", false, 16);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const auto ram = b.memory("ring", 24, 8, 1);
  for (unsigned i = 0; i < 24; ++i) b.g.memories[ram].initial[i] = llvm::APInt(8, 7 * i);
  dataflow::table t;
  t.name = "squares";
  t.width = 8;
  for (unsigned i = 0; i < 11; ++i) t.values.push_back(llvm::APInt(8, i * i));
  b.g.tables.push_back(t);
  const auto [place, place_value] = b.state("place", 5, 0);
  const node_id at_end = b.compare(operation::equal, place_value, b.constant(5, 23));
  b.set(place, b.select(at_end, b.constant(5, 0), b.sum(place_value, b.constant(5, 1))), one);
  const node_id old = b.load(ram, place_value, one);
  const node_id square = b.add(operation::table, 8, {b.slice(x, 8, 4)}, 0);
  const node_id wide_square = b.add(operation::table, 8, {b.slice(x, 3, 9)}, 0);
  b.store(ram, place_value, b.sum(old, b.slice(x, 0, 8)), one);
  b.write(out, one, b.add(operation::concat, 16, {old, b.binary(operation::bit_xor, square, wide_square)}));
  return b.g;
}

graph make_late_write(unsigned rams) {
  graph_builder b("late_write");
  const auto in = b.stream("in", true, 33);
  const auto out = b.stream("out", false, 32);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const unsigned words = 1024;
  const auto ram = b.memory("ring", words, 18 * rams, words);
  const auto [place, place_value] = b.state("place", 10, 0);
  b.set(place, b.sum(place_value, b.constant(10, 1)), one);
  const node_id old = b.load(ram, place_value, one);
  node_id y = b.binary(operation::bit_xor, b.slice(x, 0, 32), b.slice(old, 18 * rams - 32, 32));
  for (unsigned i = 0; i < 6; ++i) y = b.sum(y, b.add(operation::concat, 32, {b.slice(y, 0, 13), b.slice(y, 13, 19)}));
  std::vector<node_id> parts(rams, b.slice(y, 7, 18));
  b.store(ram, place_value, b.add(operation::concat, 18 * rams, parts), b.slice(x, 32, 1));
  b.write(out, one, y);
  return b.g;
}

graph make_two_writes(bool exclusive) {
  graph_builder b(exclusive ? "exclusive_writes" : "ordered_writes");
  const auto in = b.stream("in", true, 20);
  const auto out = b.stream("out", false, 8);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const auto ram = b.memory("store", 128, 8, 8);
  const auto [phase, phase_value] = b.state("phase", 5, 0);
  b.set(phase, b.sum(phase_value, b.constant(5, 1)), one);
  // Eight writes into eight words, a pause, eight reads of them: the distance holds by construction.
  const node_id quarter = b.slice(phase_value, 3, 2);
  const node_id writing = b.compare(operation::equal, quarter, b.constant(2, 0));
  const node_id reading = b.compare(operation::equal, quarter, b.constant(2, 2));
  const node_id flag = b.slice(x, 19, 1);
  const node_id low = b.slice(phase_value, 0, 3);
  const node_id address = b.add(operation::concat, 7, {b.constant(4, 3), low});
  const node_id word = b.load(ram, address, reading);
  const node_id first = b.binary(operation::bit_and, writing, flag);
  const node_id second = exclusive ? b.binary(operation::bit_and, writing, b.invert(flag)) : writing;
  b.store(ram, address, b.slice(x, 0, 8), first);
  b.store(ram, exclusive ? address : b.add(operation::concat, 7, {b.constant(4, 3), b.invert(low)}), b.slice(x, 8, 8),
          second);
  b.write(out, reading, word);
  return b.g;
}

graph make_all_operations() {
  graph_builder b("all_operations");
  const auto in = b.stream("in", true, 40);
  const node_id one = b.always();
  const node_id x = b.read(in, one);
  const node_id a = b.slice(x, 0, 13);
  const node_id c = b.slice(x, 13, 13);
  const node_id amount = b.slice(x, 26, 4);
  std::vector<node_id> results;
  for (const operation kind : {operation::add, operation::subtract, operation::multiply, operation::bit_and,
                               operation::bit_or, operation::bit_xor}) {
    results.push_back(b.binary(kind, a, c));
  }
  for (const operation kind : {operation::equal, operation::less_unsigned, operation::less_signed}) {
    results.push_back(b.compare(kind, a, c));
    results.push_back(b.compare(kind, a, b.constant(13, 0x1fff)));
  }
  for (const operation kind :
       {operation::shift_left, operation::shift_right_logical, operation::shift_right_arithmetic}) {
    results.push_back(b.add(kind, 13, {a, amount}));
    results.push_back(b.add(kind, 13, {a, b.slice(x, 20, 20)}));
    results.push_back(b.add(kind, 13, {a, b.constant(3, 5)}));
    results.push_back(b.add(kind, 13, {b.add(kind, 13, {a, b.constant(40, 3)}), amount}));
    results.push_back(b.sum(b.add(kind, 13, {c, amount}), a));
  }
  results.push_back(b.invert(a));
  results.push_back(b.select(b.slice(x, 30, 1), a, b.invert(c)));
  results.push_back(b.add(operation::extend_sign, 17, {a}));
  results.push_back(b.add(operation::extend_sign, 14, {b.sum(a, c)}));
  results.push_back(b.add(operation::extend_sign, 5, {b.slice(x, 3, 1)}));
  results.push_back(b.add(operation::extend_zero, 30, {b.binary(operation::subtract, a, c)}));
  results.push_back(b.compare(operation::less_signed, b.add(operation::extend_sign, 20, {a}), b.constant(20, 0xff000)));
  results.push_back(b.compare(operation::equal, b.sum(a, c), b.binary(operation::subtract, c, a)));
  // Narrow divisions: a chain of this length does not fit a period otherwise.
  const node_id d = b.slice(x, 32, 3);
  const node_id e = b.slice(x, 35, 3);
  for (const operation kind : {operation::divide_unsigned, operation::divide_signed, operation::remainder_unsigned,
                               operation::remainder_signed}) {
    results.push_back(b.add(kind, 3, {d, e}));
  }
  unsigned width = 0;
  for (const node_id r : results) width += b.g.nodes[r].width;
  const auto out = b.stream("out", false, width);
  b.write(out, one, b.add(operation::concat, width, results));
  return b.g;
}

graph make_block_matcher(unsigned levels) {
  constexpr unsigned window = 7;
  constexpr unsigned width = 1024;
  graph_builder b("block_matcher");
  const auto left_in = b.stream("left", true, 24);
  const auto right_in = b.stream("right", true, 24);
  const auto out = b.stream("disparity", false, 24);
  const node_id one = b.always();
  const node_id left = b.read(left_in, one);
  const node_id right = b.read(right_in, one);
  const auto [column, column_value] = b.state("column", 10, 0);
  const node_id at_end = b.compare(operation::equal, column_value, b.constant(10, width - 1));
  b.set(column, b.select(at_end, b.constant(10, 0), b.sum(column_value, b.constant(10, 1))), one);

  // Six older rows of both images in one RAM, newest in the low bits.
  const auto rows = b.memory("rows", width, 48 * (window), width / 4);
  const node_id old_rows = b.load(rows, column_value, one);
  b.store(rows, column_value,
          b.add(operation::concat, 48 * window, {b.slice(old_rows, 0, 48 * (window - 1)), left, right}), one);
  const node_id oldest_left = b.slice(old_rows, 48 * (window - 1) + 24, 24);
  node_id newest_right = right;
  node_id oldest_right = b.slice(old_rows, 48 * (window - 1), 24);

  const unsigned bits = 15;
  const auto sums = b.memory("column_sums", width, bits * levels, width / 4);
  const node_id old_sums = b.load(sums, column_value, one);
  std::vector<node_id> new_sums(levels);
  struct candidate {
    node_id cost, level;
  };
  std::vector<candidate> best;
  const auto difference = [&](node_id a, node_id c) {
    node_id total = dataflow::none;
    for (unsigned channel = 0; channel < 3; ++channel) {
      b.line = 100 + channel;
      const node_id p = b.extend(b.slice(a, 8 * channel, 8), 9);
      const node_id q = b.extend(b.slice(c, 8 * channel, 8), 9);
      const node_id d = b.binary(operation::subtract, p, q);
      const node_id negative = b.slice(d, 8, 1);
      const node_id magnitude =
          b.select(negative, b.binary(operation::subtract, b.constant(8, 0), b.slice(d, 0, 8)), b.slice(d, 0, 8));
      const node_id wide = b.extend(magnitude, 10);
      total = total == dataflow::none ? wide : b.sum(total, wide);
    }
    return total;
  };
  for (unsigned level = 0; level < levels; ++level) {
    b.line = 110;
    const node_id change = b.binary(operation::subtract, b.extend(difference(left, newest_right), bits),
                                    b.extend(difference(oldest_left, oldest_right), bits));
    b.line = 120;
    const node_id sum = b.sum(b.slice(old_sums, bits * level, bits), change);
    new_sums[levels - 1 - level] = sum;
    // The window's sum: add the new column, take away the one that leaves.
    node_id leaving = sum;
    for (unsigned i = 0; i < window; ++i) {
      const auto [r, value] = b.state("window_column", bits, 0);
      b.set(r, leaving, one);
      leaving = value;
    }
    b.line = 130;
    const auto [total, total_value] = b.state("window_sum", 18, 0);
    const node_id net =
        b.add(operation::extend_sign, 18, {b.binary(operation::subtract, b.extend(sum, 16), b.extend(leaving, 16))});
    const node_id cost = b.sum(total_value, net);
    b.set(total, cost, one);
    best.push_back({cost, b.constant(7, level)});
    const auto [r, value] = b.state("right_pixel", 24, 0);
    b.set(r, newest_right, one);
    newest_right = value;
    const auto [o, old_value] = b.state("old_right_pixel", 24, 0);
    b.set(o, oldest_right, one);
    oldest_right = old_value;
  }
  b.store(sums, column_value, b.add(operation::concat, bits * levels, new_sums), one);
  b.line = 140;
  while (best.size() > 1) {
    std::vector<candidate> next;
    for (std::size_t i = 0; i + 1 < best.size(); i += 2) {
      const node_id second = b.compare(operation::less_unsigned, best[i + 1].cost, best[i].cost);
      next.push_back(
          {b.select(second, best[i + 1].cost, best[i].cost), b.select(second, best[i + 1].level, best[i].level)});
    }
    if (best.size() % 2 == 1) next.push_back(best.back());
    best = std::move(next);
  }
  b.write(out, one, b.extend(b.add(operation::concat, 23, {b.slice(best[0].cost, 0, 16), best[0].level}), 24));
  return b.g;
}

}  // namespace epiline::testing
