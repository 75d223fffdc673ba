#include "report/figures_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "eval/figures_json.hpp"
#include "report/paper.hpp"

namespace epiline::report {
namespace {

using nlohmann::ordered_json;

ordered_json result_json(const method_result& result) {
  if (!result.failure.empty()) return {{"failure", result.failure}};
  ordered_json json = eval::figures_json(result.figures);
  json["seconds"] = result.seconds;
  if (result.cycles) json["cycles"] = *result.cycles;
  return json;
}

ordered_json pair_json(const evaluation& found, const pair_result& result) {
  ordered_json json;
  json["scene"] = result.entry.scene;
  json["family"] = result.entry.family;
  json["synthetic"] = result.synthetic;
  json["levels"] = result.entry.levels;
  if (!result.pair) {
    json["failure"] = result.failure;
    json["missing"] = result.missing;
    return json;
  }
  const auto& pair = *result.pair;
  json["width"] = pair.left.width;
  json["height"] = pair.left.height;
  json["non_occluded_mask"] =
      pair.non_occluded_source.empty() ? ordered_json() : ordered_json(pair.non_occluded_source);
  json["discontinuity_mask"] =
      pair.near_discontinuity_source.empty() ? ordered_json() : ordered_json(pair.near_discontinuity_source);
  json["notes"] = pair.notes;
  for (std::size_t m = 0; m < found.methods.size(); ++m) {
    json["methods"][found.methods[m].id] = result_json(result.methods[m]);
  }
  return json;
}

ordered_json law_json(const power_law& law) { return {{"factor", law.factor}, {"exponent", law.exponent}}; }

ordered_json paper_json(const report_contents& contents) {
  ordered_json json;
  for (const auto& row : printed_rows()) {
    ordered_json cells;
    for (std::size_t s = 0; s < row.cells.size(); ++s) {
      if (!row.cells[s]) continue;
      const auto& coverage = row.cells[s]->coverage;
      cells[std::string(printed_scenes()[s].scene)] = {
          {"accuracy", row.cells[s]->accuracy}, {"coverage", coverage ? ordered_json(*coverage) : ordered_json()}};
    }
    ordered_json ours;
    for (const auto& each : row.ours) ours.push_back(each.method);
    json["accuracy"].push_back({{"row", row.title}, {"methods", ours}, {"printed", cells}});
  }
  for (const auto& speed : printed_speeds()) {
    ordered_json entry = {{"design", speed.design}, {"printed_line", law_json(speed.line)}};
    const auto timing = contents.timing.find(speed.design);
    const bool timed = timing != contents.timing.end();
    if (timed) {
      entry["megahertz"] = timing->second.megahertz;
      entry["clock_source"] = timing->second.clock_source;
      entry["cycles_source"] = timing->second.cycles_source;
    }
    std::vector<rate_point> printed;
    std::vector<rate_point> ours;
    for (std::size_t s = 0; s < speed.frames.size(); ++s) {
      const auto size = printed_sizes()[s];
      const double pixels = static_cast<double>(size.width) * size.height;
      ordered_json rate = {{"width", size.width}, {"height", size.height}, {"printed", speed.frames[s]}};
      printed.push_back({pixels, speed.frames[s]});
      if (const auto frames = timed ? timing->second.frames_a_second(size) : std::nullopt) {
        rate["cycles"] = *timing->second.cycles(size);
        rate["measured"] = *frames;
        ours.push_back({pixels, *frames});
      }
      entry["frames_a_second"].push_back(rate);
    }
    entry["line_through_printed"] = law_json(fitted_power_law(printed));
    if (ours.size() >= 2) entry["line_through_measured"] = law_json(fitted_power_law(ours));
    for (const auto& time : speed.times) {
      ordered_json pair = {{"pair", time.title}, {"printed_milliseconds", time.milliseconds}};
      if (const auto frames = timed ? timing->second.frames_a_second(time.size) : std::nullopt) {
        pair["measured_milliseconds"] = 1000 / *frames;
      }
      entry["times"].push_back(pair);
    }
    json["speed"].push_back(entry);
  }
  for (const auto& printed : printed_membership_errors()) {
    json["membership_error"].push_back(
        {{"bits", printed.bits}, {"printed", printed.error}, {"computed", membership_error(printed.bits)}});
  }
  return json;
}

std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace

ordered_json evaluation_json(const report_contents& contents) {
  const auto& found = contents.found;
  ordered_json json;
  json["schema"] = figures_schema;
  json["epiline"] = contents.version;
  json["command"] = contents.command;
  json["engine"] = found.engine;
  json["complete"] = found.complete();
  for (const auto& method : found.methods) {
    ordered_json entry = {{"id", method.id}, {"title", method.title}};
    entry["design"] = method.design == nullptr ? ordered_json() : ordered_json(method.design->name);
    if (method.design != nullptr) entry["parameters"] = method.parameters;
    entry["settings"] = method.settings;
    entry["final"] = method.final;
    json["methods"].push_back(entry);
  }
  for (const auto& pair : found.pairs) json["pairs"].push_back(pair_json(found, pair));
  json["paper"] = paper_json(contents);
  return json;
}

std::string evaluation_csv(const evaluation& found) {
  // Every column that some line has, in the order of the fullest one.
  std::vector<std::string> columns;
  std::vector<std::pair<std::string, ordered_json>> lines;
  for (const auto& pair : found.pairs) {
    for (std::size_t m = 0; m < pair.methods.size(); ++m) {
      ordered_json figures = result_json(pair.methods[m]);
      std::vector<std::string> names;
      for (const auto& [name, value] : figures.items()) names.push_back(name);
      if (names.size() > columns.size()) std::swap(names, columns);
      for (const auto& name : names) {
        if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
      }
      lines.emplace_back(
          fmt::format("{},{},{}", quoted(pair.entry.scene), quoted(found.methods[m].id), pair.entry.levels),
          std::move(figures));
    }
  }
  std::string csv = fmt::format("scene,method,levels{}{}\n", columns.empty() ? "" : ",", fmt::join(columns, ","));
  for (const auto& [begin, figures] : lines) {
    csv += begin;
    for (const auto& name : columns) {
      csv += ',';
      if (!figures.contains(name)) continue;
      csv += figures[name].is_string() ? quoted(figures[name].get<std::string>()) : figures[name].dump();
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace epiline::report
