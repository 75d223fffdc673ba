#pragma once

#include <string_view>

namespace epiline::report {

/// The style sheet of the page: light and dark, wide and narrow.
inline constexpr std::string_view page_style = R"css(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1c2126; --soft: #59636e; --line: #d5dae0; --card: #f5f7f9;
  --best: #0b6b3a; --best-paper: #e3f4ea; --link: #0b5cad; --alarm: #8f1d1d; --alarm-paper: #fdeceb; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #14181c; --ink: #e4e8ec; --soft: #9aa5b1; --line: #343c45; --card: #1d2329; --best: #8fe0b0;
    --best-paper: #17382a; --link: #7db7ff; --alarm: #ffb4ab; --alarm-paper: #3a1b1b; }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 1rem 1rem 4rem; max-width: 72rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .5rem 0; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 3rem 0 .5rem; padding-top: .8rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.08rem; margin: 1.8rem 0 .4rem; }
p, ul, dl { max-width: 46rem; }
a { color: var(--link); }
.soft, figcaption, .caption { color: var(--soft); font-size: .88rem; }
code { font: .86em ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
nav ul { display: flex; flex-wrap: wrap; gap: .3rem 1rem; padding: 0; list-style: none; max-width: none; }
.scroll { overflow-x: auto; margin: 0 0 1rem; border: 1px solid var(--line); border-radius: .4rem; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; font-variant-numeric: tabular-nums; }
.caption { margin: 1rem 0 .3rem; max-width: 60rem; }
th, td { padding: .3rem .6rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; vertical-align: top; }
tbody tr:last-child > * { border-bottom: 0; }
th { font-weight: 600; }
thead th { background: var(--card); white-space: normal; vertical-align: bottom; }
th[scope=row], th[scope=rowgroup], td.text, th.text { text-align: left; }
th[scope=row], th[scope=rowgroup] { font-weight: 500; }
th.first { position: sticky; left: 0; background: var(--paper); border-right: 1px solid var(--line); }
thead th:first-child { text-align: left; }
th.group { text-align: center; border-left: 1px solid var(--line); }
td.starts, th.starts { border-left: 1px solid var(--line); }
td.wrap, th.wrap { white-space: normal; min-width: 14rem; }
td.best { color: var(--best); background: var(--best-paper); font-weight: 700; }
tr.final > th[scope=row] { font-weight: 700; }
tr.paper > td { color: var(--soft); font-style: italic; }
.alarm { border: 1px solid var(--alarm); background: var(--alarm-paper); color: var(--alarm); border-radius: .4rem;
  padding: .2rem .9rem; max-width: none; }
.scale { display: flex; flex-wrap: wrap; align-items: center; gap: .4rem 1.4rem; font-size: .85rem; color: var(--soft);
  margin: .6rem 0; }
.bar { display: inline-grid; grid-template-columns: auto 12rem auto; align-items: center; gap: .5rem; }
.bar i { height: .9rem; border-radius: .2rem; }
.key { display: inline-flex; align-items: center; gap: .4rem; }
.key i { width: 1rem; height: 1rem; border: 1px solid var(--soft); border-radius: .2rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 26rem), 1fr)); gap: 1rem; margin: .8rem 0; }
figure { margin: 0; padding: .5rem; background: var(--card); border: 1px solid var(--line); border-radius: .4rem; }
figure > div { display: grid; grid-template-columns: 1fr 1fr; gap: .4rem; }
figure img { width: 100%; height: auto; display: block; border-radius: .2rem; }
figcaption { padding: .4rem .1rem 0; }
figcaption b { color: var(--ink); }
dt { font-weight: 600; margin-top: .5rem; }
dd { margin-left: 1rem; }
@media (max-width: 40rem) {
  body { padding: .6rem .7rem 3rem; }
  h1 { font-size: 1.35rem; }
  h2 { font-size: 1.15rem; }
  table { font-size: .82rem; }
  th, td { padding: .28rem .45rem; }
  th.first { min-width: 8rem; max-width: 9rem; white-space: normal; }
}
@media print { figure, table { break-inside: avoid; } }
)css";

}  // namespace epiline::report
