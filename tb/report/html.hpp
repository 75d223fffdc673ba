#pragma once
// Small pieces of HTML.

#include <string>
#include <string_view>

namespace epiline::report {

/// Text as it stands in HTML, in attributes too.
[[nodiscard]] std::string escaped(std::string_view text);

/// A table in a box that scrolls sideways when it is wider than the screen, below its caption, which does not scroll.
/// `caption`, `head` and `body` are HTML; the last two are rows.
[[nodiscard]] std::string table(std::string_view caption, std::string_view head, std::string_view body);

/// A cell of text or a number; `kind` is its class, or nothing.
[[nodiscard]] std::string cell(std::string_view contents, std::string_view kind = "");

/// The cell that names a row.
[[nodiscard]] std::string row_name(std::string_view contents);

/// The cell that names several rows.
[[nodiscard]] std::string group_name(std::string_view contents, std::size_t rows);

/// A number with that many decimals, thousands apart by thin spaces.
[[nodiscard]] std::string number(double value, int decimals);

inline constexpr std::string_view no_value = "&ndash;";

}  // namespace epiline::report
