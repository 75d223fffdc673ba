#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "eval/truth_masks.hpp"
#include "report/html.hpp"
#include "report/page_sections.hpp"
#include "report/page_style.hpp"

namespace epiline::report {
namespace {

/// The measures by which the summary compares methods, and their cells.
struct summary_measure {
  std::string_view caption;
  bool more_is_better;
  std::optional<double> (*value)(const eval::map_figures&);
  std::string (*text)(const eval::map_figures&);
};

std::optional<double> accuracy(const eval::map_figures& figures) {
  if (!figures.all || figures.all->defined == 0) return std::nullopt;
  return figures.all->accuracy();
}

std::optional<double> wrong_or_missing(const eval::map_figures& figures) {
  const auto& counts = figures.non_occluded ? figures.non_occluded : figures.all;
  if (!counts || counts->known == 0) return std::nullopt;
  return counts->bad_one_undefined_share();
}

constexpr summary_measure measures[] = {
    {"<b>Accuracy / coverage</b>, %: of the pixels given a disparity, how many are right within 1 pixel / how many "
     "pixels are given one. Highest accuracy marked; a method can buy accuracy with coverage.",
     true, accuracy,
     [](const eval::map_figures& figures) {
       return fmt::format("{:.1f} / {:.1f}", figures.all->accuracy(), figures.coverage());
     }},
    {"<b>Wrong or missing</b>, %: of the pixels that both cameras see, how many have no disparity or one off by more "
     "than 1 pixel. This counts both faults at once; lowest marked. (All pixels of known truth where there is no "
     "mask.)",
     false, wrong_or_missing,
     [](const eval::map_figures& figures) { return fmt::format("{:.1f}", *wrong_or_missing(figures)); }},
};

/// The final methods' results on a pair that was evaluated, by index into evaluation::methods.
const eval::map_figures* final_figures(const evaluation& found, const pair_result& pair, std::size_t method_index) {
  if (!pair.pair || !found.methods[method_index].final) return nullptr;
  const auto& result = pair.methods[method_index];
  return result.failure.empty() ? &result.figures : nullptr;
}

/// The index of the best method on that pair, none when nothing was measured.
std::optional<std::size_t> winner(const evaluation& found, const pair_result& pair, const summary_measure& measure) {
  std::optional<std::size_t> best;
  double best_value = 0;
  for (std::size_t m = 0; m < found.methods.size(); ++m) {
    const auto* figures = final_figures(found, pair, m);
    const auto value = figures == nullptr ? std::nullopt : measure.value(*figures);
    if (value && (!best || (measure.more_is_better ? *value > best_value : *value < best_value))) {
      best = m;
      best_value = *value;
    }
  }
  return best;
}

std::string summary_table(const evaluation& found, const summary_measure& measure) {
  std::string head = "<tr><th>Method</th>";
  std::vector<const pair_result*> pairs;
  for (const auto& pair : found.pairs) {
    if (!pair.pair) continue;
    pairs.push_back(&pair);
    head += fmt::format("<th><a href=\"#{}\">{}</a></th>", anchor_of(pair), escaped(title_of(pair)));
  }
  std::string body;
  for (std::size_t m = 0; m < found.methods.size(); ++m) {
    if (!found.methods[m].final) continue;
    body += "<tr>" + row_name(escaped(found.methods[m].title));
    for (const auto* pair : pairs) {
      const auto* figures = final_figures(found, *pair, m);
      const bool measured = figures != nullptr && measure.value(*figures).has_value();
      body += cell(measured ? measure.text(*figures) : std::string(no_value),
                   measured && winner(found, *pair, measure) == m ? "best" : "");
    }
    body += "</tr>\n";
  }
  return table(measure.caption, head + "</tr>\n", body);
}

/// "A on 4 of 6 (x, y); B on 2 of 6 (z)". Nobody wins on a scene of the project's own making.
std::string winners_text(const evaluation& found, const summary_measure& measure) {
  std::map<std::size_t, std::vector<std::string>> won;
  std::size_t measured = 0;
  for (const auto& pair : found.pairs) {
    if (const auto best = winner(found, pair, measure); best && !pair.synthetic) {
      won[*best].push_back(escaped(title_of(pair)));
      ++measured;
    }
  }
  std::vector<std::pair<std::size_t, std::vector<std::string>>> order(won.begin(), won.end());
  std::ranges::sort(order, [](const auto& a, const auto& b) {
    return a.second.size() != b.second.size() ? a.second.size() > b.second.size() : a.first < b.first;
  });
  std::vector<std::string> parts;
  for (const auto& [index, pairs] : order) {
    parts.push_back(fmt::format("<b>{}</b> on {} of {} ({})", escaped(found.methods[index].title), pairs.size(),
                                measured, fmt::join(pairs, ", ")));
  }
  return parts.empty() ? "nothing was measured on photographs" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string failures(const evaluation& found) {
  std::string items;
  for (const auto& pair : found.pairs) {
    if (!pair.failure.empty()) {
      items += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(title_of(pair)), escaped(pair.failure));
    }
    for (std::size_t m = 0; m < pair.methods.size(); ++m) {
      if (pair.methods[m].failure.empty()) continue;
      items += fmt::format("<li><b>{}</b>, {}: {}</li>\n", escaped(title_of(pair)), escaped(found.methods[m].title),
                           escaped(pair.methods[m].failure));
    }
  }
  if (items.empty()) return {};
  return fmt::format("<div class=\"alarm\"><p><b>Not everything could be evaluated:</b></p>\n<ul>\n{}</ul></div>\n",
                     items);
}

std::string navigation(const evaluation& found) {
  std::string items;
  for (const auto& pair : found.pairs) {
    items += fmt::format("<li><a href=\"#{}\">{}</a></li>", anchor_of(pair), escaped(title_of(pair)));
  }
  return fmt::format(
      "<nav><ul>{}<li><a href=\"#paper\">The paper's tables</a></li><li><a href=\"#words\">What the words "
      "mean</a></li><li><a href=\"#methods\">Methods and parameters</a></li></ul></nav>\n",
      items);
}

std::string summary(const evaluation& found) {
  const auto count = [&](bool synthetic) {
    return std::ranges::count_if(
        found.pairs, [&](const auto& pair) { return pair.pair.has_value() && pair.synthetic == synthetic; });
  };
  const auto photographed = count(false);
  std::string html = fmt::format(
      "<p>Two cameras side by side see every point at two places; how far apart, in pixels, is its <i>disparity</i>, "
      "and the larger it is the nearer is the point. A stereo method computes it for each pixel of the left image. "
      "This page shows how well the methods of this project do that, as the hardware does it bit for bit (engine "
      "<code>{}</code>), on {} pair{} of photographs whose true disparities are known{}, beside OpenCV's two matchers "
      "on the same pictures, with the same levels and under the same measures.</p>\n",
      escaped(found.engine), photographed, photographed == 1 ? "" : "s",
      count(true) == 0 ? "" : " (and a rendered one, which takes no part in who wins)");
  html += fmt::format("<ul>\n<li>Highest accuracy: {}.</li>\n<li>Fewest pixels wrong or missing: {}.</li>\n</ul>\n",
                      winners_text(found, measures[0]), winners_text(found, measures[1]));
  for (const auto& measure : measures) html += summary_table(found, measure);
  return html;
}

std::string words() {
  return fmt::format(
      "<h2 id=\"words\">What the words mean</h2>\n<dl>\n"
      "<dt>Levels</dt><dd>Disparities that are tried: 0 to levels - 1. Each pair states its own.</dd>\n"
      "<dt>Coverage</dt><dd>Pixels given a disparity / all pixels of the image. Within a region (non-occluded, near "
      "discontinuities): of that region's pixels whose truth is known.</dd>\n"
      "<dt>Accuracy</dt><dd>Of the pixels given a disparity whose truth is known and counts, the share with |d - "
      "truth| &le; 1 pixel.</dd>\n"
      "<dt>Bad 0.5, bad 1, bad 2</dt><dd>Of the same pixels, the share with |d - truth| above that many pixels. "
      "OpenCV's maps have fractions of a pixel, the hardware's have not, which bad 0.5 and the average error "
      "show.</dd>\n"
      "<dt>Average error</dt><dd>Of the same pixels, the mean of |d - truth|, in pixels.</dd>\n"
      "<dt>Bad 1 or undefined</dt><dd>Of all pixels whose truth is known and counts, the share that is bad by more "
      "than 1 or given no disparity: gaps are not forgiven.</dd>\n"
      "<dt>Truth that counts</dt><dd>Where the data set has a mask of evaluated pixels (mask_all), only those; unknown "
      "truth never counts.</dd>\n"
      "<dt>Non-occluded</dt><dd>Seen by both cameras: the data set's mask; else, where the truth of the right image is "
      "there, pixels whose match lies in the right image at a known truth that is not nearer by more than {:.0f} "
      "pixel; else there is no such figure, and the page says \"no mask\".</dd>\n"
      "<dt>Near discontinuities</dt><dd>The data set's mask; else pixels in a square of {} x {} around one whose truth "
      "differs from that of one of its eight neighbours by more than {:.0f} pixels. Non-occluded pixels only, where "
      "that is known.</dd>\n</dl>\n",
      eval::occlusion_threshold, eval::discontinuity_width, eval::discontinuity_width, eval::discontinuity_gap);
}

std::string methods_section(const report_contents& contents) {
  std::string body;
  for (const auto& method : contents.found.methods) {
    body += fmt::format("<tr>{}{}{}</tr>\n", row_name(escaped(method.title)),
                        cell(fmt::format("<code>{}</code>", escaped(method.id)), "text"),
                        cell(escaped(method.settings), "text wrap"));
  }
  return "<h2 id=\"methods\">Methods and parameters</h2>\n" +
         table(
             "Every method searches the levels of the pair; OpenCV's, which search a multiple of 16, the next such "
             "number. OpenCV's pictures are extended to the left by as many columns (their edge repeated), since it "
             "computes nothing for pixels without all candidates.",
             "<tr><th>Method</th><th class=\"text\">name in figures.json</th><th class=\"text "
             "wrap\">parameters</th></tr>\n",
             body) +
         fmt::format(
             "<p class=\"soft\">Epiline {}. Made by <code>{}</code>. The same figures, and more digits, are in <a "
             "href=\"figures.json\">figures.json</a> and <a href=\"figures.csv\">figures.csv</a>.</p>\n",
             escaped(contents.version), escaped(contents.command));
}

}  // namespace

std::string page_of(const report_contents& contents) {
  const auto& found = contents.found;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Epiline: how good the stereo methods "
      "are</title>\n<style>";
  html += page_style;
  html += "</style>\n</head>\n<body>\n<header>\n<h1>Epiline: how good the stereo methods are</h1>\n</header>\n<main>\n";
  html += failures(found) + summary(found) + navigation(found);
  for (const auto& pair : found.pairs) html += pair_section(found.methods, pair);
  html += paper_section(contents) + words() + methods_section(contents);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace epiline::report
