#include "prove/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace epiline::prove {

session::session(options given, std::function<void(const std::string&)> print)
    : given_(given), print_(std::move(print)) {}

void session::pass_ran(const std::string& process, std::string_view pass, const dataflow::graph& before,
                       const dataflow::graph& after) {
  entries_.push_back({process, prove_pass(std::string(pass), before, after, given_)});
  print_(fmt::format("{}: {}", process, describe(entries_.back().found)));
}

bool session::refuted() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [](const entry& e) { return e.found.result == verdict::refuted; });
}

nlohmann::json session::to_json() const {
  nlohmann::json passes = nlohmann::json::array(), totals = nlohmann::json::object();
  for (const auto& [process, p] : entries_) {
    nlohmann::json item = {{"process", process},
                           {"pass", p.pass},
                           {"verdict", name_of(p.result)},
                           {"relation", p.relation},
                           {"compared", p.obligations},
                           {"unproved", p.unproved},
                           {"ranges_needed", p.with_facts},
                           {"seconds", p.seconds}};
    if (!p.reason.empty()) item["reason"] = p.reason;
    if (p.difference) {
      nlohmann::json start = nlohmann::json::array();
      for (const auto& [name, value] : p.difference->start) start.push_back({{"name", name}, {"value", value}});
      item["counterexample"] = {{"what", p.difference->what},
                                {"place", p.difference->place},
                                {"start", start},
                                {"confirmed_by_interpreter", p.difference->confirmed}};
    }
    passes.push_back(std::move(item));
    nlohmann::json& total = totals.emplace(p.pass, nlohmann::json::object()).first.value();
    for (const verdict v : {verdict::proved, verdict::timed_out, verdict::refuted, verdict::not_covered})
      total[name_of(v)] = total.value(name_of(v), 0) + (p.result == v ? 1 : 0);
  }
  return {{"version", 1},
          {"solver", "Z3 " + solver_version()},
          {"seconds_a_pass", given_.seconds},
          {"passes", passes},
          {"totals", totals}};
}

std::string describe(const proof& p) {
  std::string text = fmt::format("{}: {} ({:.2f} s)", p.pass, name_of(p.result), p.seconds);
  if (p.result == verdict::timed_out) text += fmt::format(", {} of {} not proved", p.unproved, p.obligations);
  if (!p.reason.empty()) text += ": " + p.reason;
  if (!p.difference) return text;
  const counterexample& c = *p.difference;
  text += fmt::format("\n  {}{} differs{}", c.place.empty() ? "" : c.place + ": ", c.what,
                      c.confirmed ? "; the interpreter says so, too" : "; not seen by the interpreter");
  if (!c.start.empty()) text += "\n  starting from";
  for (const auto& [name, value] : c.start) text += fmt::format("\n    {} = {}", name, value);
  return text;
}

}  // namespace epiline::prove
