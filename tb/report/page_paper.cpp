#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.hpp"
#include "report/page_sections.hpp"
#include "report/paper.hpp"

namespace epiline::report {
namespace {

/// Our figures of that method on that scene, or null.
const eval::map_figures* figures_of(const evaluation& found, std::string_view scene, std::string_view method_id) {
  const auto pair = std::ranges::find_if(
      found.pairs, [&](const pair_result& each) { return each.entry.scene == scene && each.pair.has_value(); });
  const auto which = std::ranges::find(found.methods, method_id, &method::id);
  if (pair == found.pairs.end() || which == found.methods.end()) return nullptr;
  const auto& result = pair->methods[static_cast<std::size_t>(which - found.methods.begin())];
  return result.failure.empty() && result.figures.all ? &result.figures : nullptr;
}

std::string accuracy_and_coverage(double accuracy, double coverage) {
  return fmt::format("{:.1f} / {:.1f}", accuracy, coverage);
}

std::string accuracy_table(const evaluation& found) {
  std::string head = "<tr><th>Row of the paper</th><th class=\"text\">whose figures</th>";
  for (const auto& scene : printed_scenes()) {
    const auto pair = std::ranges::find_if(
        found.pairs, [&](const pair_result& each) { return each.synthetic && each.entry.scene == scene.scene; });
    head += fmt::format(
        "<th>{}{}</th>", scene.title,
        pair == found.pairs.end() ? "" : fmt::format("<br><a href=\"#{}\">ours: synthetic</a>", anchor_of(*pair)));
  }
  head += "</tr>\n";
  std::string body;
  for (const auto& row : printed_rows()) {
    body += fmt::format("<tr class=\"paper\">{}<td class=\"text\">paper prints</td>",
                        group_name(escaped(row.title), 1 + 2 * row.ours.size()));
    for (const auto& printed : row.cells) {
      body += cell(!printed            ? std::string(no_value)
                   : printed->coverage ? fmt::format("{} / {}", printed->accuracy, *printed->coverage)
                                       : fmt::format("{} / {}", printed->accuracy, no_value));
    }
    body += "</tr>\n";
    for (const auto& ours : row.ours) {
      std::string all;
      std::string seen;
      for (const auto& scene : printed_scenes()) {
        const auto* figures = figures_of(found, scene.scene, ours.method);
        all += cell(figures == nullptr ? std::string(no_value)
                                       : accuracy_and_coverage(figures->all->accuracy(), figures->coverage()));
        seen += cell(figures == nullptr || !figures->non_occluded
                         ? std::string(no_value)
                         : accuracy_and_coverage(figures->non_occluded->accuracy(), figures->non_occluded->coverage()));
      }
      body += fmt::format(
          "<tr><td class=\"text\">{0}, all pixels</td>{1}</tr>\n<tr><td class=\"text\">{0}, "
          "non-occluded</td>{2}</tr>\n",
          ours.title, all, seen);
    }
  }
  return table("Accuracy / coverage in per cent", head, body);
}

std::string accuracy_note(const evaluation& found) {
  std::string seen_share = "85.3 %";
  if (const auto* cones = figures_of(found, "cones", "color_fuzzy-fis"); cones != nullptr && cones->non_occluded) {
    seen_share = fmt::format(
        "{:.1f} %", 100.0 * static_cast<double>(cones->non_occluded->known) / static_cast<double>(cones->pixels));
  }
  return fmt::format(
      "<p><b>How to read this honestly.</b> The paper does not define its two measures. Under the definition used here "
      "(all pixels of known truth) its 99 / 93 on Cones cannot be true: the right camera sees only {} of that image's "
      "pixels at all, so a map that covers 93 % must guess the rest. On non-occluded pixels such figures come within "
      "reach, so both are printed. Nor does the paper give its thresholds, window sizes and rules; ours were chosen by "
      "measuring. Its own pair Corridor is not publicly stored with its truth any more: where the column Corridor has "
      "figures of ours, they are of a synthetic corridor with exact truth (see the pairs above), not of that "
      "picture.</p>\n",
      seen_share);
}

const design_timing* timing_of(const report_contents& contents, std::string_view design) {
  const auto found = contents.timing.find(design);
  return found == contents.timing.end() ? nullptr : &found->second;
}

std::string size_text(frame_size size) { return fmt::format("{} x {}", size.width, size.height); }

constexpr std::string_view how_to_time =
    "not measured: run <code>scripts/frame_rates.py -o timing.json</code>, then evaluate again with <code>--timing "
    "timing.json</code>";

std::string frame_rate_table(const report_contents& contents) {
  std::string head = "<tr><th>Frames/s, 80 levels</th><th class=\"text\">whose figures</th>";
  for (const auto& size : printed_sizes()) head += fmt::format("<th>{}</th>", size_text(size));
  head += "<th class=\"text wrap\">logic, clock</th></tr>\n";
  std::string body;
  for (const auto& speed : printed_speeds()) {
    const auto* timing = timing_of(contents, speed.design);
    body += fmt::format("<tr class=\"paper\">{}<td class=\"text\">paper prints</td>",
                        group_name(speed.title, timing == nullptr ? 2 : 3));
    for (const double frames : speed.frames) body += cell(number(frames, 0));
    body += cell(escaped(speed.resources), "text wrap") + "</tr>\n";
    const auto columns = printed_sizes().size() + 1;
    if (timing == nullptr) {
      body += fmt::format("<tr><td class=\"text\">ours</td><td class=\"text\" colspan=\"{}\">{}</td></tr>\n", columns,
                          how_to_time);
      continue;
    }
    std::string rates;
    std::string clocks;
    for (const auto& size : printed_sizes()) {
      const auto frames = timing->frames_a_second(size);
      rates += cell(frames ? number(*frames, 0) : std::string(no_value));
      const auto count = timing->cycles(size);
      clocks += cell(count ? number(*count, 0) : std::string(no_value));
    }
    body +=
        fmt::format("<tr><td class=\"text\">ours</td>{}{}</tr>\n", rates,
                    cell(fmt::format("{:.1f} MHz: {}", timing->megahertz, escaped(timing->clock_source)), "text wrap"));
    body += fmt::format("<tr><td class=\"text\">ours, clocks a frame</td>{}{}</tr>\n", clocks,
                        cell(escaped(timing->cycles_source), "text wrap"));
  }
  return table(
      "Frames a second against image size. A dash: a size that this build's line memories do not hold, or that was not "
      "run.",
      head, body);
}

std::string law_text(const power_law& law) {
  const int power = static_cast<int>(std::floor(std::log10(law.factor)));
  return fmt::format("{:.3g} &middot; 10<sup>{}</sup> &middot; (w&sup2;)<sup>{:.3f}</sup>",
                     law.factor / std::pow(10, power), power, law.exponent);
}

std::string line_table(const report_contents& contents) {
  std::string body;
  for (const auto& speed : printed_speeds()) {
    std::vector<rate_point> printed;
    std::vector<rate_point> ours;
    const auto* timing = timing_of(contents, speed.design);
    for (std::size_t s = 0; s < speed.frames.size(); ++s) {
      const auto size = printed_sizes()[s];
      const double pixels = static_cast<double>(size.width) * size.height;
      printed.push_back({pixels, speed.frames[s]});
      const auto frames = timing == nullptr ? std::nullopt : timing->frames_a_second(size);
      if (frames) ours.push_back({pixels, *frames});
    }
    body += fmt::format("<tr>{}{}{}{}</tr>\n", row_name(speed.title), cell(law_text(speed.line)),
                        cell(law_text(fitted_power_law(printed))),
                        ours.size() < 2 ? cell(how_to_time, "text wrap") : cell(law_text(fitted_power_law(ours))));
  }
  return table(
      "Frames a second as a power of the pixels, w = width of a square image. Fits: least squares of logarithms "
      "(Eigen).",
      "<tr><th>Method</th><th>paper prints</th><th>fit of the paper's five rates</th><th>fit of ours</th></tr>\n",
      body);
}

std::string time_table(const report_contents& contents) {
  std::string body;
  for (const auto& speed : printed_speeds()) {
    const auto* timing = timing_of(contents, speed.design);
    for (const auto& time : speed.times) {
      const auto frames = timing == nullptr ? std::nullopt : timing->frames_a_second(time.size);
      body += fmt::format("<tr>{}{}{}{}</tr>\n", row_name(speed.title),
                          cell(fmt::format("{} ({})", time.title, size_text(time.size)), "text"),
                          cell(fmt::format("{:.2f}", time.milliseconds)),
                          frames ? cell(fmt::format("{:.2f}", 1000 / *frames)) : cell(how_to_time, "text wrap"));
    }
  }
  return table(
      "Milliseconds a pair. Ours: clocks a frame over the clock of the table above; the hardware always searches its "
      "80 levels at once, so fewer levels take no less time.",
      "<tr><th>Method</th><th class=\"text\">pair</th><th>paper prints</th><th>ours</th></tr>\n", body);
}

std::string membership_table() {
  std::string body;
  for (const auto& printed : printed_membership_errors()) {
    const double error = membership_error(printed.bits);
    body += fmt::format("<tr>{}{}{}{}</tr>\n", row_name(fmt::format("N = {}", printed.bits)),
                        cell(fmt::format("{:.3f}", printed.error)), cell(fmt::format("{:.5f}", error)),
                        cell(fmt::format("{:.3f}", std::floor(error * 1000) / 1000)));
  }
  return table(
      "Largest error of membership degrees digitised with N bits: truncation, floor(&mu; &middot; 2<sup>N</sup>) / "
      "2<sup>N</sup>, of a Gaussian with &sigma; = 18.75 at 0, 1, ..., 127",
      "<tr><th>Bits</th><th>paper prints</th><th>computed</th><th>to three decimals, cut</th></tr>\n", body);
}

}  // namespace

std::string paper_section(const report_contents& contents) {
  return "<h2 id=\"paper\">The paper's tables</h2>\n"
         "<p>C. Georgoulas, I. Andreadis: <i>Real-Time Stereo Vision Techniques</i>. What it prints is in grey "
         "italics; below it stands what this project measures or computes.</p>\n"
         "<h3 id=\"paper-accuracy\">Accuracy and coverage of the methods</h3>\n" +
         accuracy_table(contents.found) + accuracy_note(contents.found) +
         "<h3 id=\"paper-rates\">Frame rate and image size</h3>\n" + frame_rate_table(contents) +
         "<h3 id=\"paper-lines\">Regression lines</h3>\n" + line_table(contents) +
         "<h3 id=\"paper-times\">Time a pair</h3>\n" + time_table(contents) +
         "<h3 id=\"paper-membership\">Digitisation of membership degrees</h3>\n" + membership_table();
}

}  // namespace epiline::report
