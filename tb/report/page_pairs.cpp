#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/html.hpp"
#include "report/page_sections.hpp"
#include "report/pictures.hpp"

namespace epiline::report {
namespace {

using eval::accuracy_counts;
using eval::map_figures;

/// A column of a pair's table of figures.
struct figure_column {
  std::string_view group;
  std::string_view name;
  int decimals;
  bool more_is_better;
  std::function<std::optional<double>(const map_figures&)> value;
};

std::optional<double> share_of(const std::optional<accuracy_counts>& counts, double (accuracy_counts::*share)() const) {
  if (!counts || counts->known == 0) return std::nullopt;
  return ((*counts).*share)();
}

/// Where nothing is defined there is no accuracy to speak of.
std::optional<double> among_defined(const std::optional<accuracy_counts>& counts,
                                    double (accuracy_counts::*share)() const) {
  if (!counts || counts->defined == 0) return std::nullopt;
  return ((*counts).*share)();
}

const std::vector<figure_column>& columns() {
  using counts = accuracy_counts;
  constexpr std::string_view all = "All pixels of known truth";
  constexpr std::string_view seen = "Non-occluded";
  constexpr std::string_view edges = "Near discontinuities";
  static const std::vector<figure_column> table = {
      {all, "accuracy", 1, true, [](const auto& f) { return among_defined(f.all, &counts::accuracy); }},
      {all, "coverage", 1, true, [](const auto& f) { return std::optional(f.coverage()); }},
      {all, "bad 0.5", 1, false, [](const auto& f) { return among_defined(f.all, &counts::bad_half_share); }},
      {all, "bad 1", 1, false, [](const auto& f) { return among_defined(f.all, &counts::bad_one_share); }},
      {all, "bad 2", 1, false, [](const auto& f) { return among_defined(f.all, &counts::bad_two_share); }},
      {all, "average error, px", 2, false, [](const auto& f) { return among_defined(f.all, &counts::average_error); }},
      {all, "bad 1 or undefined", 1, false,
       [](const auto& f) { return share_of(f.all, &counts::bad_one_undefined_share); }},
      {seen, "accuracy", 1, true, [](const auto& f) { return among_defined(f.non_occluded, &counts::accuracy); }},
      {seen, "coverage", 1, true, [](const auto& f) { return share_of(f.non_occluded, &counts::coverage); }},
      {seen, "bad 1 or undefined", 1, false,
       [](const auto& f) { return share_of(f.non_occluded, &counts::bad_one_undefined_share); }},
      {edges, "accuracy", 1, true,
       [](const auto& f) { return among_defined(f.near_discontinuity, &counts::accuracy); }},
      {edges, "coverage", 1, true, [](const auto& f) { return share_of(f.near_discontinuity, &counts::coverage); }},
      {edges, "bad 1 or undefined", 1, false,
       [](const auto& f) { return share_of(f.near_discontinuity, &counts::bad_one_undefined_share); }},
  };
  return table;
}

std::string head_of_figures() {
  std::string groups = "<tr><th rowspan=\"2\">Method</th>";
  std::string names = "<tr>";
  const auto& table = columns();
  for (auto column = table.begin(); column != table.end(); ++column) {
    const bool starts = column == table.begin() || std::prev(column)->group != column->group;
    if (starts) {
      const auto width = std::ranges::count(table, column->group, &figure_column::group);
      groups += fmt::format("<th class=\"group\" colspan=\"{}\">{}, %</th>", width, column->group);
    }
    names += fmt::format("<th{}>{}</th>", starts ? " class=\"starts\"" : "", column->name);
  }
  return groups + "<th rowspan=\"2\" class=\"starts\">time, ms</th></tr>\n" + names + "</tr>\n";
}

std::string figures_table(const std::vector<method>& methods, const pair_result& pair) {
  const auto& table_columns = columns();
  std::vector<std::optional<double>> best(table_columns.size());
  for (std::size_t c = 0; c < table_columns.size(); ++c) {
    for (const auto& result : pair.methods) {
      if (!result.failure.empty()) continue;
      const auto value = table_columns[c].value(result.figures);
      if (value && (!best[c] || (table_columns[c].more_is_better ? *value > *best[c] : *value < *best[c]))) {
        best[c] = value;
      }
    }
  }
  std::string body;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto& result = pair.methods[m];
    body += fmt::format("<tr{}>{}", methods[m].final ? " class=\"final\"" : "", row_name(escaped(methods[m].title)));
    if (!result.failure.empty()) {
      body += fmt::format("<td class=\"text starts\" colspan=\"{}\">failed: {}</td></tr>\n", table_columns.size() + 1,
                          escaped(result.failure));
      continue;
    }
    for (std::size_t c = 0; c < table_columns.size(); ++c) {
      const auto value = table_columns[c].value(result.figures);
      std::string kind = c == 0 || table_columns[c - 1].group != table_columns[c].group ? "starts" : "";
      if (value && value == best[c]) kind += kind.empty() ? "best" : " best";
      body += cell(value ? number(*value, table_columns[c].decimals) : std::string(no_value), kind);
    }
    body += cell(number(1000 * result.seconds, 0), "starts") + "</tr>\n";
  }
  return table(
      "Shares in per cent; the best of each column is marked. Time: of this run, on this computer, in software.",
      head_of_figures(), body);
}

std::string image(const std::string& uri, const eval::rgb_image& size, const std::string& alternative) {
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">", uri, size.width, size.height,
                     escaped(alternative));
}

std::string figure(const std::string& pictures, const std::string& caption) {
  return fmt::format("<figure><div>{}</div><figcaption>{}</figcaption></figure>\n", pictures, caption);
}

std::string colour_scale(int levels) {
  constexpr int stops = 24;
  std::string gradient;
  for (const auto& colour : eval::disparity_colours(stops)) gradient += "," + hexadecimal(colour);
  std::string html = fmt::format(
      "<div class=\"scale\"><span class=\"bar\"><span>0 (far)</span><i style=\"background:linear-gradient(to "
      "right{})\"></i><span>{} (near) pixels of disparity</span></span><span class=\"key\"><i "
      "style=\"background:#000\"></i>none given</span></div>\n<div class=\"scale\">",
      gradient, levels - 1);
  for (const auto& look : error_looks()) {
    html += fmt::format("<span class=\"key\"><i style=\"background:{}\"></i>{}</span>", hexadecimal(look.colour),
                        look.meaning);
  }
  return html + "</div>\n";
}

std::string caption_of(const map_figures& figures) {
  if (!figures.all || figures.all->defined == 0) return fmt::format("coverage {:.1f} %", figures.coverage());
  return fmt::format("accuracy {:.1f} %, coverage {:.1f} %", figures.all->accuracy(), figures.coverage());
}

std::string pictures_of(const std::vector<method>& methods, const pair_result& result) {
  const auto& pair = *result.pair;
  const std::string title = title_of(result);
  std::string inputs = image(photograph_uri(pair.left), pair.left, title + ", left image");
  if (pair.truth) {
    inputs += image(map_uri(pair.truth->disparity, pair.entry.levels), pair.left, title + ", true disparities");
  }
  std::string html = figure(inputs, pair.truth ? "<b>Left image</b> and <b>truth</b>" : "<b>Left image</b>");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto& found = result.methods[m];
    if (!methods[m].pictured || !found.failure.empty()) continue;
    std::string pictures =
        image(map_uri(found.map, pair.entry.levels), pair.left, methods[m].title + ", disparity map of " + title);
    if (pair.truth) {
      pictures += image(error_uri(found.map, *pair.truth), pair.left, methods[m].title + ", errors on " + title);
    }
    html += figure(pictures, fmt::format("<b>{}</b><br>{}", escaped(methods[m].title), caption_of(found.figures)));
  }
  return "<div class=\"pictures\">\n" + html + "</div>\n";
}

std::string facts_of(const pair_result& result) {
  const auto& pair = *result.pair;
  std::string facts = fmt::format("{}{}{} x {} pixels, {} levels (0 to {})", escaped(pair.entry.family),
                                  pair.entry.family.empty() ? "" : ". ", pair.left.width, pair.left.height,
                                  pair.entry.levels, pair.entry.levels - 1);
  if (pair.truth && !result.methods.empty()) {
    const auto any = std::ranges::find(result.methods, std::string(), &method_result::failure);
    if (any != result.methods.end() && any->figures.all) {
      facts +=
          fmt::format("; the truth is known and counts at {:.1f} % of the pixels",
                      100.0 * static_cast<double>(any->figures.all->known) / static_cast<double>(any->figures.pixels));
    }
    facts +=
        fmt::format(". Mask of non-occluded pixels: {}. Near discontinuities: {}.",
                    pair.non_occluded_source.empty() ? "no mask, and no truth of the right image to derive one from"
                                                     : escaped(pair.non_occluded_source),
                    escaped(pair.near_discontinuity_source));
  }
  for (const auto& note : pair.notes) facts += " <b>Note:</b> " + escaped(note) + ".";
  return fmt::format("<p class=\"soft\">{}</p>\n", facts);
}

}  // namespace

std::string anchor_of(const pair_result& pair) {
  std::string anchor = "pair-";
  for (const char c : pair.entry.scene) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    anchor += plain ? std::string(1, c) : fmt::format("_{:02x}", static_cast<unsigned char>(c));
  }
  return anchor;
}

std::string title_of(const pair_result& pair) {
  std::string title = pair.entry.scene;
  if (title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
  std::ranges::replace(title, '_', ' ');
  return title + (pair.synthetic ? " (synthetic)" : "");
}

std::string pair_section(const std::vector<method>& methods, const pair_result& pair) {
  const std::string heading = fmt::format("<h2 id=\"{}\">{}</h2>\n", anchor_of(pair), escaped(title_of(pair)));
  if (!pair.pair) {
    return heading + fmt::format("<div class=\"alarm\"><p>Not evaluated: {}</p></div>\n", escaped(pair.failure));
  }
  return heading + facts_of(pair) + colour_scale(pair.entry.levels) + pictures_of(methods, pair) +
         figures_table(methods, pair);
}

}  // namespace epiline::report
