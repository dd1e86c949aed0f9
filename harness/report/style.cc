#include "harness/report/style.h"

namespace aisle {

const char* const kStyleSheet = R"css(:root {
  color-scheme: light dark;
  --page: #fbfbfa; --card: #ffffff; --ink: #1c2024; --soft: #626b74; --rule: #dde1e5;
  --good: #14713d; --good-page: #e3f4e9; --bad: #b3261e; --bad-page: #fbe6e4;
  --warn: #8a5a00; --movers: #d5504a; --truth: #7b858f;
  --c0: #d1571b; --c1: #1668b8; --c2: #2a8a4a; --c3: #8a4fc2; --c4: #b0367f; --c5: #7a6a00;
  --b0: #4c78a8; --b1: #72b7b2; --b2: #e3a857; --b3: #b279a2; --b4: #9aa5ae; --b5: #6f9e5a;
  --b6: #d0807a; --b7: #8f8bd0;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14171a; --card: #1c2024; --ink: #e6e9ec; --soft: #98a2ac; --rule: #333a41;
    --good: #6fd595; --good-page: #15301f; --bad: #ff8f85; --bad-page: #3a1a18;
    --warn: #f0b85a; --movers: #e0706a; --truth: #8d98a3;
    --c0: #ff9a5c; --c1: #6cb6ff; --c2: #6fd595; --c3: #c79bff; --c4: #ff86c3; --c5: #e0cf5a;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; max-width: 1680px; padding: 28px 32px 60px; background: var(--page);
  color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif;
}
h1 { font-size: 26px; margin: 0 0 2px; letter-spacing: -0.01em; }
h2 { font-size: 20px; margin: 38px 0 8px; letter-spacing: -0.01em; }
h3 { font-size: 15px; margin: 24px 0 6px; }
p { margin: 6px 0; max-width: 78ch; }
a { color: var(--c1); }
.soft { color: var(--soft); }
.small { font-size: 13px; max-width: 120ch; }
.verdict {
  border-left: 6px solid var(--rule); background: var(--card); padding: 14px 18px; margin: 18px 0;
  border-radius: 4px;
}
.verdict.passed { border-color: var(--good); background: var(--good-page); }
.verdict.failed { border-color: var(--bad); background: var(--bad-page); }
.verdict strong { font-size: 19px; }
.verdict ul { margin: 8px 0 0; padding-left: 20px; }
.verdict a { color: inherit; }
.pass { color: var(--good); font-weight: 600; }
.fail { color: var(--bad); font-weight: 600; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; background: var(--card); margin: 8px 0;
  min-width: min(100%, 1000px); }
th, td { padding: 6px 10px; border-bottom: 1px solid var(--rule); text-align: right; }
th { font-weight: 600; color: var(--soft); font-size: 13px; vertical-align: bottom; }
th:first-child, td:first-child, .left { text-align: left; }
td { font-variant-numeric: tabular-nums; white-space: nowrap; }
td.wrap { white-space: normal; text-align: left; }
tr:hover td { background: color-mix(in srgb, var(--c1) 7%, transparent); }
td.best { font-weight: 700; }
tr.printed td { color: var(--soft); font-style: italic; border-bottom-color: transparent; }
tr.spread td { color: var(--soft); font-size: 12px; white-space: normal;
  border-bottom-color: transparent; }
table.dense td:nth-child(2), table.dense td:nth-child(3) { text-align: left; }
table.dense th, table.dense td { padding: 2px 8px; font-size: 12.5px; }
.chip { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 7px; }
.chip.c0 { background: var(--c0); } .chip.c1 { background: var(--c1); }
.chip.c2 { background: var(--c2); } .chip.c3 { background: var(--c3); }
.chip.c4 { background: var(--c4); } .chip.c5 { background: var(--c5); }
.chip.red { background: #ff463c; } .chip.cyan { background: #28dcf0; }
.chip.green { background: #5adc6e; } .chip.grey { background: #aaaaaa; }
.chip.yellow { background: #ffdc1e; } .chip.blue { background: #50aaff; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 700px), 1fr));
  gap: 12px; align-items: start; }
.charts figure { max-width: 1000px; } .charts > figure { margin: 0; } .charts > div > figure { margin: 0 0 12px; }
figure { margin: 10px 0; background: var(--card); border: 1px solid var(--rule); border-radius: 4px;
  padding: 12px 12px 8px; }
figcaption { color: var(--soft); font-size: 13px; margin-top: 6px; }
svg { display: block; width: 100%; height: auto; }
svg text { font: 12px system-ui, "DejaVu Sans", sans-serif; fill: var(--soft); }
svg .axis { font-size: 12px; fill: var(--ink); }
svg .legend { font-size: 13px; fill: var(--ink); }
svg .middle { text-anchor: middle; }
svg .end { text-anchor: end; }
svg .inbar { fill: #101418; font-size: 11px; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg .line { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
svg .truth { fill: none; stroke: var(--truth); stroke-width: 2.4; stroke-dasharray: 6 4; }
svg .start { fill: var(--truth); }
svg path { vector-effect: non-scaling-stroke; }
svg .movers { fill: var(--movers); opacity: 0.65; }
svg .texture { fill: var(--b0); opacity: 0.5; }
svg .s0 { stroke: var(--ink); } svg .s1 { stroke: var(--b0); } svg .s2 { stroke: var(--b2); }
svg .box { fill: none; stroke-width: 1.2; opacity: 0.8; }
svg .c0 { stroke: var(--c0); } svg .c1 { stroke: var(--c1); } svg .c2 { stroke: var(--c2); }
svg .c3 { stroke: var(--c3); } svg .c4 { stroke: var(--c4); } svg .c5 { stroke: var(--c5); }
svg .dot { opacity: 0.75; }
svg .d0 { fill: var(--c0); } svg .d1 { fill: var(--c1); } svg .d2 { fill: var(--c2); }
svg .d3 { fill: var(--c3); } svg .d4 { fill: var(--c4); } svg .d5 { fill: var(--c5); }
svg .b0 { fill: var(--b0); } svg .b1 { fill: var(--b1); } svg .b2 { fill: var(--b2); }
svg .b3 { fill: var(--b3); } svg .b4 { fill: var(--b4); } svg .b5 { fill: var(--b5); }
svg .b6 { fill: var(--b6); } svg .b7 { fill: var(--b7); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(330px, 1fr)); gap: 8px; }
.pictures img { width: 100%; height: auto; display: block; border-radius: 3px; }
.sheets { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 760px), 1fr));
  gap: 10px; }
.sheets figure { margin: 0; padding: 8px; }
.sheets img { width: 100%; height: auto; display: block; }
code, pre { font: 13px/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
pre { background: var(--card); border: 1px solid var(--rule); border-radius: 4px; padding: 8px 12px;
  overflow-x: auto; margin: 6px 0; }
.flaky { color: var(--warn); font-weight: 600; }
th.sortable { cursor: pointer; }
th.sortable:hover { color: var(--ink); }
th[aria-sort=ascending]::after { content: " ▴"; } th[aria-sort=descending]::after { content: " ▾"; }
table.grouped th, table.grouped td { padding: 5px 6px; font-size: 13px; }
th.group { text-align: center; border-left: 1px solid var(--rule); color: var(--ink); }
table.grouped .first, table.by1 td:nth-child(n+2), table.by3 td:nth-child(3n+2),
table.by4 td:nth-child(4n+2) { border-left: 1px solid var(--rule); }
table.grouped th:first-child:not([rowspan]) { text-align: right; }
input.filter { font: inherit; font-size: 13px; padding: 4px 9px; border: 1px solid var(--rule);
  border-radius: 4px; background: var(--card); color: var(--ink); }
.readout { min-height: 1.5em; font-variant-numeric: tabular-nums; white-space: pre-wrap; }
svg .panel { fill: none; pointer-events: all; }
svg .cursor { stroke: var(--soft); stroke-width: 1; pointer-events: none; }
canvas { display: block; width: 100%; height: 340px; touch-action: none; cursor: grab; }
details { margin: 8px 0; }
summary { cursor: pointer; color: var(--soft); }
footer { margin-top: 44px; color: var(--soft); font-size: 13px; border-top: 1px solid var(--rule);
  padding-top: 10px; }
)css";

}  // namespace aisle
