#include "cosim/stream_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <random>

namespace epiline::cosim {
namespace {

constexpr unsigned reset_clocks = 4;
constexpr std::uint64_t progress_interval = 100'000;

/// Decides clock by clock whether a port pauses.
class stall_generator {
 public:
  stall_generator(stall_profile profile, std::uint64_t seed) : profile_(profile), random_(seed) {}

  bool pauses() {
    if (profile_.percent == 0) return false;
    if (clocks_left_ == 0) {
      paused_ = static_cast<int>(random_() % 100) < profile_.percent;
      clocks_left_ = profile_.burst <= 1 ? 1 : 1 + static_cast<unsigned>(random_() % profile_.burst);
    }
    --clocks_left_;
    return paused_;
  }

 private:
  stall_profile profile_;
  std::mt19937_64 random_;
  unsigned clocks_left_ = 0;
  bool paused_ = false;
};

struct source {
  std::size_t port;
  const token_list* tokens;
  port_record* record;
  stall_generator stall;
  std::size_t next = 0;
  bool offered = false;
  bool accepts = false;                  // in the clock looked at
  std::vector<std::uint32_t> junk = {};  // payload while tvalid is 0: nothing may depend on it
};

struct sink {
  std::size_t port;
  std::size_t expected;  // unlimited when unknown
  bool count_known;
  port_record* record;
  stall_generator stall;
  std::vector<std::uint32_t> token;
  std::vector<std::uint32_t> waiting_token;
  bool ready = false;
  bool valid = false;
  bool waiting = false;  // tvalid was 1 and tready 0 in the clock before
};

class session {
 public:
  session(rtl_model& model, const drive_request& request, const drive_options& options)
      : model_(model), request_(request), options_(options) {
    check_names(request);
    std::seed_seq seeds{static_cast<std::uint32_t>(options.seed), static_cast<std::uint32_t>(options.seed >> 32)};
    std::vector<std::uint32_t> port_seeds(model.ports().size());
    seeds.generate(port_seeds.begin(), port_seeds.end());
    for (std::size_t index = 0; index < model.ports().size(); ++index) {
      const model_port& port = model.ports()[index];
      const auto profile = options.stalls.find(port.name);
      const stall_generator stall(profile == options.stalls.end() ? stall_profile{} : profile->second,
                                  port_seeds[index]);
      if (port.input) {
        const auto tokens = request.inputs.find(port.name);
        port_record& record = result_.inputs[port.name];
        sources_.push_back({index, tokens == request.inputs.end() ? nullptr : &tokens->second, &record, stall});
        std::mt19937 junk(port_seeds[index]);
        std::ranges::generate_n(std::back_inserter(sources_.back().junk), (port.width + 31) / 32, junk);
        if (sources_.back().tokens != nullptr) record.clocks.reserve(sources_.back().tokens->size());
      } else {
        const auto expected = request.expected.find(port.name);
        const bool known = expected != request.expected.end();
        port_record& record = result_.outputs[port.name];
        record.tokens = token_list(port.width);
        sinks_.push_back({index,
                          known ? expected->second : std::numeric_limits<std::size_t>::max(),
                          known,
                          &record,
                          stall,
                          std::vector<std::uint32_t>((port.width + 31) / 32),
                          {}});
        sinks_.back().waiting_token = sinks_.back().token;
      }
    }
  }

  drive_result run() {
    reset();
    std::uint64_t last_move = 0;
    while (true) {
      if (one_clock()) last_move = clock_;
      ++clock_;
      const std::uint64_t idle = clock_ - last_move;
      if (all_done()) {
        if (idle > options_.quiet_clocks) break;
      } else if (idle > options_.patience) {
        give_up();
        break;
      }
      if (options_.progress && clock_ % progress_interval == 0) options_.progress(share_done());
    }
    result_.clocks = clock_;
    for (std::size_t index = 0; index < model_.fifos().size(); ++index) {
      if (const auto fill = model_.fill(index)) result_.peak_fills[model_.fifos()[index].name] = fill->peak;
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(drive_error::reason why, const std::string& message) const {
    throw drive_error(why, fmt::format("{}: {} (seed {})", model_.name(), message, options_.seed));
  }

  void check_names(const drive_request& request) const {
    const auto find = [this](const std::string& name, bool input) -> const model_port& {
      const auto port = std::ranges::find_if(model_.ports(), [&](const model_port& candidate) {
        return candidate.name == name && candidate.input == input;
      });
      if (port == model_.ports().end()) {
        fail(drive_error::reason::bad_request, fmt::format("no {} port '{}'", input ? "input" : "output", name));
      }
      return *port;
    };
    for (const auto& [name, tokens] : request.inputs) {
      const model_port& port = find(name, true);
      if (tokens.width() != port.width) {
        fail(drive_error::reason::bad_request,
             fmt::format("port '{}' takes tokens of {} bits, not {}", name, port.width, tokens.width()));
      }
    }
    for (const auto& [name, count] : request.expected) static_cast<void>(find(name, false));
    for (const auto& [name, profile] : options_.stalls) {
      if (std::ranges::none_of(model_.ports(), [&](const model_port& port) { return port.name == name; })) {
        fail(drive_error::reason::bad_request, fmt::format("no port '{}' to stall", name));
      }
      if (profile.percent < 0 || profile.percent > 99) {
        fail(drive_error::reason::bad_request,
             fmt::format("port '{}': {} % of pauses is not within 0..99", name, profile.percent));
      }
    }
  }

  void reset() {
    for (const source& from : sources_) model_.set_valid(from.port, false);
    for (const sink& to : sinks_) model_.set_ready(to.port, false);
    model_.set_reset(true);
    for (unsigned count = 0; count < reset_clocks; ++count) {
      model_.settle();
      model_.rising_edge();
    }
    model_.set_reset(false);
  }

  /// Returns whether a token moved.
  bool one_clock() {
    for (source& from : sources_) {
      const bool pauses = from.stall.pauses();
      if (!from.offered && from.tokens != nullptr && from.next < from.tokens->size() && !pauses && may_offer(from)) {
        model_.set_token(from.port, (*from.tokens)[from.next].data());
        model_.set_valid(from.port, true);
        from.offered = true;
      } else if (!from.offered) {
        model_.set_token(from.port, from.junk.data());
      }
    }
    for (sink& to : sinks_) {
      const bool pauses = to.stall.pauses();
      to.ready = !pauses && (!options_.ready_after_valid || to.waiting);
    }
    if (options_.probe_outputs) probe_outputs();
    for (const sink& to : sinks_) model_.set_ready(to.port, to.ready);
    model_.settle();

    bool moved = false;
    for (sink& to : sinks_) moved |= look_at(to);
    for (source& from : sources_) from.accepts = from.offered && model_.ready(from.port);
    model_.rising_edge();
    for (source& from : sources_) {
      if (!from.accepts) continue;
      from.record->clocks.push_back(clock_);
      ++from.next;
      from.offered = false;
      model_.set_valid(from.port, false);
      moved = true;
    }
    return moved;
  }

  [[nodiscard]] bool may_offer(const source& from) const {
    return !request_.may_offer || request_.may_offer(model_.ports()[from.port].name, from.next, result_);
  }

  /// Checks the rules at an output and takes its token. Returns whether there was one.
  bool look_at(sink& to) {
    const model_port& port = model_.ports()[to.port];
    to.valid = model_.valid(to.port);
    if (to.waiting && !to.valid) {
      fail(drive_error::reason::rule_violation,
           fmt::format("clock {}: port '{}' withdrew tvalid before tready", clock_, port.name));
    }
    if (!to.valid) return false;
    model_.get_token(to.port, to.token.data());
    if (to.waiting && to.token != to.waiting_token) {
      fail(drive_error::reason::rule_violation,
           fmt::format("clock {}: port '{}' changed its payload from {} to {} before tready", clock_, port.name,
                       hexadecimal(to.waiting_token), hexadecimal(to.token)));
    }
    to.waiting = !to.ready;
    if (!to.ready) {
      to.waiting_token = to.token;
      return false;
    }
    if (to.record->tokens.size() == to.expected) {
      fail(drive_error::reason::surplus_tokens,
           fmt::format("clock {}: port '{}' sent more than the {} tokens expected", clock_, port.name, to.expected));
    }
    to.record->tokens.push_back(to.token);
    to.record->clocks.push_back(clock_);
    return true;
  }

  void probe_outputs() {
    std::vector<std::uint32_t> other;
    for (const bool level : {false, true}) {
      for (const sink& to : sinks_) model_.set_ready(to.port, level);
      model_.settle();
      for (sink& to : sinks_) {
        const std::string& name = model_.ports()[to.port].name;
        if (!level) {
          to.valid = model_.valid(to.port);
          model_.get_token(to.port, to.token.data());
        } else if (model_.valid(to.port) != to.valid) {
          fail(drive_error::reason::rule_violation,
               fmt::format("clock {}: tvalid of port '{}' depends on tready", clock_, name));
        } else if (to.valid) {
          other.resize(to.token.size());
          model_.get_token(to.port, other.data());
          if (other != to.token) {
            fail(drive_error::reason::rule_violation,
                 fmt::format("clock {}: payload of port '{}' depends on tready", clock_, name));
          }
        }
      }
    }
  }

  [[nodiscard]] bool inputs_done() const {
    return std::ranges::all_of(
        sources_, [](const source& from) { return from.tokens == nullptr || from.next == from.tokens->size(); });
  }
  [[nodiscard]] bool outputs_done() const {
    return std::ranges::all_of(
        sinks_, [](const sink& to) { return to.count_known && to.record->tokens.size() == to.expected; });
  }
  [[nodiscard]] bool all_done() const { return inputs_done() && outputs_done(); }

  [[nodiscard]] double share_done() const {
    std::size_t done = 0;
    std::size_t total = 0;
    for (const source& from : sources_) {
      done += from.next;
      total += from.tokens == nullptr ? 0 : from.tokens->size();
    }
    return total == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total);
  }

  /// Nothing moves any more: returns when that is a proper end, else says why it is not.
  void give_up() const {
    bool missing = false;
    for (const sink& to : sinks_) missing |= to.count_known && to.record->tokens.size() < to.expected;
    if (missing) {
      fail(drive_error::reason::deadlock,
           fmt::format("clock {}: no token moved for {} clocks; {}", clock_, options_.patience, states()));
    }
    if (!inputs_done()) {
      fail(drive_error::reason::unread_tokens, fmt::format("clock {}: input tokens left unread; {}", clock_, states()));
    }
  }

  [[nodiscard]] std::string states() const {
    std::string text;
    for (const source& from : sources_) {
      fmt::format_to(std::back_inserter(text), "{}input '{}': {} of {} tokens accepted, tvalid={} tready={}",
                     text.empty() ? "" : "; ", model_.ports()[from.port].name, from.next,
                     from.tokens == nullptr ? 0 : from.tokens->size(), int{from.offered}, int{model_.ready(from.port)});
    }
    for (const sink& to : sinks_) {
      fmt::format_to(std::back_inserter(text), "{}output '{}': {}{} tokens sent, tvalid={} tready={}",
                     text.empty() ? "" : "; ", model_.ports()[to.port].name, to.record->tokens.size(),
                     to.count_known ? fmt::format(" of {}", to.expected) : "", int{model_.valid(to.port)},
                     int{to.ready});
    }
    for (std::size_t index = 0; index < model_.fifos().size(); ++index) {
      const model_fifo& fifo = model_.fifos()[index];
      const std::optional<fifo_fill> fill = model_.fill(index);
      if (!fill) continue;
      fmt::format_to(std::back_inserter(text), "; stream '{}' {}: {} of {} tokens, at most {}", fifo.name,
                     fill->now == fifo.depth ? "is full"
                     : fill->now == 0        ? "is empty"
                                             : "is neither full nor empty",
                     fill->now, fifo.depth, fill->peak);
    }
    return text;
  }

  static std::string hexadecimal(const std::vector<std::uint32_t>& token) {
    std::string text = fmt::format("{:x}", token.back());
    for (std::size_t word = token.size() - 1; word-- > 0;) text += fmt::format("{:08x}", token[word]);
    return text;
  }

  rtl_model& model_;
  const drive_request& request_;
  const drive_options& options_;
  std::vector<source> sources_;
  std::vector<sink> sinks_;
  drive_result result_;
  std::uint64_t clock_ = 0;
};

}  // namespace

std::uint64_t drive_result::busy_clocks() const {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last = 0;
  for (const auto& [name, record] : inputs) {
    if (!record.clocks.empty()) first = std::min(first, record.clocks.front());
  }
  for (const auto& [name, record] : outputs) {
    if (!record.clocks.empty()) last = std::max(last, record.clocks.back());
  }
  return first > last ? 0 : last - first + 1;
}

drive_result drive(rtl_model& model, const drive_request& request, const drive_options& options) {
  return session(model, request, options).run();
}

}  // namespace epiline::cosim
