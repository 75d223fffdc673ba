#include "report/html.hpp"

#include <fmt/format.h>

namespace epiline::report {

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string table(std::string_view caption, std::string_view head, std::string_view body) {
  return fmt::format(
      "<p class=\"caption\">{}</p>\n<div class=\"scroll\" tabindex=\"0\">\n<table>\n<thead>\n{}</thead>\n<tbody>\n{}"
      "</tbody>\n</table>\n</div>\n",
      caption, head, body);
}

std::string cell(std::string_view contents, std::string_view kind) {
  return kind.empty() ? fmt::format("<td>{}</td>", contents) : fmt::format("<td class=\"{}\">{}</td>", kind, contents);
}

std::string row_name(std::string_view contents) {
  return fmt::format("<th scope=\"row\" class=\"first\">{}</th>", contents);
}

std::string group_name(std::string_view contents, std::size_t rows) {
  return fmt::format("<th scope=\"rowgroup\" class=\"first\" rowspan=\"{}\">{}</th>", rows, contents);
}

std::string number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const std::size_t end = text.find('.') == std::string::npos ? text.size() : text.find('.');
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  for (std::size_t at = end; at > first + 3;) {
    at -= 3;
    text.insert(at, "&#8239;");
  }
  return text;
}

}  // namespace epiline::report
