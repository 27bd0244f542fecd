// SPDX-License-Identifier: MIT
#include "verifier/report/html_parts.h"

namespace threefold::report {

// Verdicts are told apart by word and symbol; their colours differ for colour-blind readers too (blue-green, vermilion,
// ochre). Pictures stand on a neutral grey.
const std::string_view page_style = R"css(
:root {
  --paper: #fbfaf7; --raised: #ffffff; --ink: #1d1c1a; --quiet: #66635d; --line: #dedad1; --mat: #e9e8e6;
  --holds: #0a6b5e; --fails: #b3261e; --undecided: #8a5a00; --band: #0a6b5e1f; --band-edge: #0a6b5e80; --link: #1f4f8f;
  --serif: "Iowan Old Style", "Palatino Linotype", Palatino, "URW Palladio L", "P052", Georgia, serif;
  --sans: system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", sans-serif;
  --mono: ui-monospace, "SF Mono", Menlo, Consolas, "Liberation Mono", monospace;
  color-scheme: light dark;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #161615; --raised: #1e1e1c; --ink: #ebe8e1; --quiet: #a19d94; --line: #383631; --mat: #2a2a29;
    --holds: #58c7b0; --fails: #ff8a7a; --undecided: #e3b04b; --band: #58c7b024; --band-edge: #58c7b080; --link: #9cc2ff;
  }
}
* { box-sizing: border-box; }
html { scroll-behavior: smooth; -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 var(--sans); overflow-wrap: break-word; }
body > header, main { max-width: 72rem; margin: 0 auto; padding: 0 1.5rem; }
h1, h2, .lead, .summary { font-family: var(--serif); }
h1 { font-size: clamp(2.1rem, 5.5vw, 3.9rem); line-height: 1.08; font-weight: 500; letter-spacing: -.015em; margin: 0; text-wrap: balance; }
h2 { font-size: clamp(1.4rem, 2.6vw, 1.9rem); line-height: 1.22; font-weight: 500; margin: 0 0 .8rem; text-wrap: balance; }
h3 { font-size: 1rem; font-weight: 600; margin: 2rem 0 .6rem; }
h4 { font-size: .95rem; margin: 1.1rem 0 .1rem; }
p { margin: 0 0 .7rem; max-width: 46rem; }
a { color: var(--link); text-decoration-thickness: 1px; text-underline-offset: .18em; }
code, pre { font: .86em/1.5 var(--mono); }
pre { background: var(--raised); border: 1px solid var(--line); padding: .7rem .9rem; margin: 0 0 .9rem; white-space: pre-wrap; overflow-wrap: anywhere; }
.hash { overflow-wrap: anywhere; }
.quiet { color: var(--quiet); font-size: .88rem; }
summary { cursor: pointer; }
:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }

.top { padding-top: 3.2rem !important; padding-bottom: 1.2rem !important; }
.origin { color: var(--quiet); font-size: .9rem; max-width: none; margin-bottom: 1.4rem; }
.top.holds .symbol { color: var(--holds); } .top.fails .symbol { color: var(--fails); } .top.undecided .symbol { color: var(--undecided); }
.lead { font-size: clamp(1.1rem, 1.8vw, 1.35rem); line-height: 1.45; margin-top: 1.1rem; max-width: 44rem; }
.fault { border-left: 4px solid var(--fails); padding-left: .8rem; font-weight: 600; }
.badge { display: inline-block; white-space: nowrap; font-weight: 600; font-size: .9rem; }
.badge .symbol { display: inline-block; width: 1.1em; text-align: center; font-weight: 700; }
.badge.holds { color: var(--holds); } .badge.fails { color: var(--fails); } .badge.undecided { color: var(--undecided); }

main > section, .claim { border-top: 1px solid var(--line); padding: 1.8rem 0 2.4rem; }
.witnesses { list-style: none; margin: 0; padding: 0; display: grid; gap: 1.2rem 2.4rem; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); }
.witnesses h3 { font-size: 1.05rem; margin: 0; letter-spacing: 0; }
.witnesses p { margin: .1rem 0; }
.witnesses b { font-weight: 600; color: var(--holds); }
.witnesses .absent { border-left: 3px solid var(--undecided); padding-left: .8rem; }
.witnesses .absent b { color: var(--undecided); }

.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums lining-nums; }
th, td { text-align: left; padding: .5rem .9rem .5rem 0; vertical-align: middle; }
thead th { font-size: .8rem; font-weight: 500; color: var(--quiet); border-bottom: 1px solid var(--line); vertical-align: bottom; }
th:last-child, td:last-child { padding-right: 0; }
.guide { margin: 1.1rem 0 0; }
.matrix tbody th { font-weight: 400; width: 46%; }
.matrix tbody tr + tr { border-top: 1px solid var(--line); }

.claim header .name { margin-bottom: .3rem; color: var(--quiet); font-size: .9rem; }
.claim header .name .badge { font-size: 1.05rem; margin-right: .5rem; }
.summary { font-size: 1.12rem; line-height: 1.5; }
.blamed { color: var(--fails); }
.notes { margin: .2rem 0 0; padding-left: 1.1rem; max-width: 46rem; }
.notes li { margin-bottom: .3rem; }

.strip { display: grid; gap: .9rem; grid-template-columns: repeat(var(--n), minmax(0, 1fr)); margin-bottom: .9rem; max-width: calc(var(--n) * 24rem); }
figure { margin: 0; min-width: 0; }
figcaption { font-size: .88rem; color: var(--quiet); padding-top: .3rem; }
.picture { all: unset; box-sizing: border-box; display: block; position: relative; width: 100%; background: var(--mat); cursor: zoom-in; }
.picture:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
.picture img { display: block; width: 100%; height: auto; }
.picture.small img { image-rendering: pixelated; }
.experiment.pointed .picture::after { content: ""; position: absolute; inset: 0; pointer-events: none; mix-blend-mode: difference;
  background: linear-gradient(#fff, #fff) var(--x) 0 / 1px 100% no-repeat, linear-gradient(#fff, #fff) 0 var(--y) / 100% 1px no-repeat; opacity: .65; }

.frame { position: relative; max-width: max(7rem, calc(34rem * var(--shape))); } /* a tall picture fits a screen */
.marks { position: absolute; inset: 0; pointer-events: none; container-type: inline-size; }
.marks svg { position: absolute; inset: 0; width: 100%; height: 100%; overflow: hidden; }
.ink, .halo { fill: none; vector-effect: non-scaling-stroke; }
.halo { stroke: #000; stroke-opacity: .7; stroke-width: 3.6; } .ink { stroke-width: 1.6; } .ink.measured { stroke: #ffd23e; } .ink.expected { stroke: #6fe3ff; }
path.expected { stroke-dasharray: 6 4; }
.labels { position: absolute; inset: 0; overflow: hidden; font: 11px/1.35 var(--sans); }
.labels span { position: absolute; max-width: 60%; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; padding: 0 .35em; background: #000000b8; color: #ffd23e; transform: translate(6px, calc(-100% - 4px)); }
.labels .expected { color: #6fe3ff; } .labels .leftwards { transform: translate(calc(-100% - 6px), calc(-100% - 4px)); }
.labels .below { transform: translate(6px, 4px); } .labels .below.leftwards { transform: translate(calc(-100% - 6px), 4px); }
@container (max-width: 11rem) { .labels { display: none; } }
.legend { list-style: none; margin: -.4rem 0 .9rem; padding: 0; display: flex; flex-wrap: wrap; gap: .1rem 1.6rem; font-size: .84rem; color: var(--quiet); }
.legend svg { vertical-align: -.15em; margin-right: .3rem; background: #6b6b6b; border-radius: 2px; }

.flip { border-left: 3px solid var(--ink); padding-left: .8rem; margin: .2rem 0 .9rem; } .flip p { margin: 0; } .flip b { font-weight: 600; white-space: nowrap; }
.flip-table td { white-space: nowrap; } .flip-table th[scope=row] { width: 46%; } .flip-table th a { font-weight: 600; }
.part { margin-top: 2rem; padding-top: 1rem; border-top: 1px dotted var(--line); }
.preset { font-size: 1.15rem; margin: 0 0 .8rem; } .preset .quiet { font-weight: 400; margin: 0 .8rem 0 .2rem; }
.part > .summary { font-size: 1.05rem; }
.fold { border-top: 1px dotted var(--line); padding: .35rem 0; } .fold[open] { padding-bottom: .8rem; }
.fold > summary { padding: .15rem 0; } .fold > summary > h3, .fold > summary > h4 { display: inline; margin: 0 .5rem 0 0; font-size: 1rem; }
.fold[open] > summary { margin-bottom: .6rem; } header + .fold, .notes + .fold, .flip + .fold { margin-top: 1rem; }
.part h4, .fold h4 { font-size: 1rem; font-weight: 600; margin: 1.4rem 0 .6rem; }
.all-folds { margin: 1.2rem 0; } .all-folds button { font: .88rem/1.3 var(--sans); color: inherit; background: var(--raised); border: 1px solid var(--line); padding: .35rem .7rem; border-radius: 3px; cursor: pointer; }
.to-part { text-decoration: none; } .matrix td .quiet { display: block; }

.numbers { font-size: .92rem; }
.numbers .number { white-space: nowrap; }
.numbers th[scope=row] { font-weight: 500; }
.numbers th .quiet, .numbers td .quiet { display: block; font-weight: 400; }
.quantity th { padding-top: 1.5rem; padding-bottom: .25rem; font-size: 1rem; font-weight: 600; border-bottom: 1px solid var(--line); }
.quantity th span { color: var(--quiet); font-weight: 400; font-size: .88rem; margin-left: .5rem; }
.row + .row > tr:first-child > * { border-top: 1px solid var(--line); }
.numbers .row td, .numbers .row th { vertical-align: top; }
.intervals thead th:nth-child(1) { width: 21%; } .intervals thead th:nth-child(2), .intervals thead th:nth-child(4) { width: 9%; } .intervals thead th:nth-child(3) { width: 17%; }
.intervals thead th:nth-child(5) { width: 8%; } .intervals thead th:nth-child(7) { width: 9%; }
.drawing { min-width: 13rem; }
.why > td { padding: 0 0 .55rem; font-size: .83rem; color: var(--quiet); }
.why .advice { margin: 0 0 .15rem; color: var(--undecided); font-weight: 600; }
.why summary { width: fit-content; max-width: 100%; }
.why summary .label { white-space: nowrap; }
.budget { margin: .5rem 0 .4rem; padding-left: .9rem; border-left: 2px solid var(--line); display: grid; grid-template-columns: minmax(9rem, max-content) 1fr; gap: .25rem 1.2rem; color: var(--ink); }
.budget dt b { font-weight: 500; color: var(--quiet); white-space: nowrap; margin-left: .3rem; } .budget dd { margin: 0; max-width: 44rem; }
.renders thead th:first-child { width: 24%; }

.interval { display: block; width: 100%; max-width: 17.5rem; height: auto; overflow: visible; --c: var(--holds); }
.interval.fails { --c: var(--fails); } .interval.undecided { --c: var(--undecided); }
.interval .axis { stroke: var(--line); stroke-width: 1; }
.interval .band { fill: var(--band); } .interval .edge { stroke: var(--band-edge); stroke-width: 1.2; }
.interval .expected { stroke: var(--band-edge); stroke-width: 1.2; stroke-dasharray: 2.5 2.5; }
.interval .bar { fill: var(--c); fill-opacity: .62; } .interval .mean { stroke: var(--c); stroke-width: 2.4; }
.interval text { font: 11px var(--sans); fill: var(--quiet); } .interval .far { fill: var(--fails); }
.interval .arrow { fill: var(--c); }
.counts { display: block; width: 100%; max-width: 13rem; height: 6px; margin-top: .25rem; }
.counts .holds { fill: var(--holds); fill-opacity: .55; } .counts .undecided { fill: var(--undecided); } .counts .fails { fill: var(--fails); }
.time { display: block; width: 100%; max-width: 36rem; height: 10px; background: var(--line); } .time .renderers { fill: var(--quiet); }

.parameters { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: .15rem 2rem; margin: .4rem 0 1rem; font-size: .9rem; }
.parameters div { display: flex; justify-content: space-between; gap: 1rem; border-bottom: 1px dotted var(--line); }
.parameters dt { color: var(--quiet); } .parameters dd { margin: 0; text-align: right; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
.scenes { margin-top: 1.6rem; font-size: .95rem; } .why .parameters { color: var(--ink); margin-top: .5rem; } .why pre { margin-top: .5rem; color: var(--ink); }

#viewer { border: 0; padding: 0; margin: 0; width: 100vw; height: 100dvh; max-width: none; max-height: none; background: #2b2b2b; color: #eee; }
#viewer[open] { display: grid; grid-template-rows: auto minmax(0, 1fr) auto auto; }
#viewer .bar { display: flex; flex-wrap: wrap; justify-content: space-between; gap: .4rem; padding: .6rem; }
#viewer .tabs, #viewer .modes { display: flex; flex-wrap: wrap; gap: .3rem; }
#viewer button { font: .88rem/1.3 var(--sans); color: inherit; background: #3d3d3d; border: 1px solid transparent; padding: .42rem .7rem; border-radius: 3px; cursor: pointer; }
#viewer button:hover { background: #505050; } #viewer button[aria-pressed=true] { background: #eee; color: #111; }
#viewer kbd { font: .78em var(--mono); opacity: .65; margin: 0 .1rem; }
#viewer .stage { position: relative; display: grid; margin: 0 auto; overflow: hidden; touch-action: none; cursor: pointer; place-self: center; }
#viewer .stage img { grid-area: 1 / 1; display: block; width: 100%; height: 100%; image-rendering: pixelated; user-select: none; }
#viewer .over, #viewer .marks-over, #viewer .divider, #viewer input { display: none; }
#viewer .marks-under, #viewer .marks-over { grid-area: 1 / 1; position: relative; pointer-events: none; } #viewer.unmarked .marks { display: none; } #viewer .labels { font-size: 13px; }
#viewer.split .over, #viewer.split .marks-over { display: block; clip-path: inset(0 0 0 var(--split)); } #viewer.split .divider { display: block; position: absolute; inset: 0 auto 0 var(--split); width: 1px; background: #fff; mix-blend-mode: difference; }
#viewer.split input { display: block; width: min(40rem, 90vw); margin: 0 auto .7rem; }
#viewer .says { margin: 0; padding: .5rem; max-width: none; text-align: center; font-size: .88rem; color: #c8c8c8; }
#viewer :focus-visible { outline-color: #9cc2ff; }

@media screen and (max-width: 46rem) {
  body > header, main { padding: 0 1rem; }
  .top { padding-top: 1.6rem !important; }
  .strip { gap: .4rem; }
  .numbers thead, .matrix thead { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  .numbers, .numbers tbody, .matrix, .matrix tbody { display: block; }
  .numbers tr, .matrix tr { display: grid; grid-template-columns: 1fr 1fr; gap: 0 1rem; }
  .numbers th, .numbers td, .matrix th, .matrix td { display: block; width: auto; padding: .2rem 0; }
  .numbers td:empty { display: none; }
  .numbers td::before, .matrix td::before { content: attr(data-label); display: block; color: var(--quiet); font-size: .78rem; }
  .numbers td.verdict { grid-area: 1 / 2; justify-self: end; } .numbers td.verdict::before, .why > td::before, .drawing::before { display: none !important; }
  .numbers .number { white-space: normal; } .numbers .drawing, .numbers .why td, .quantity th, .matrix tbody th, .numbers.renders th, .flip-table th { grid-column: 1 / -1; } .flip-table th[scope=row] { width: auto; } .flip-table td { white-space: normal; }
  .drawing { min-width: 0; } .interval { max-width: 22rem; }
  .row, .matrix tr { padding: .5rem 0; } .row + .row { border-top: 1px solid var(--line); } .row + .row > tr:first-child > * { border-top: 0; }
  .budget { grid-template-columns: 1fr; } .budget dd { margin-bottom: .4rem; }
  .matrix tr { grid-template-columns: repeat(auto-fit, minmax(6.5rem, 1fr)); } .matrix tbody th { width: auto; } .parameters { grid-template-columns: 1fr; }
}
@media (prefers-reduced-motion: reduce) { html { scroll-behavior: auto; } }
@media print {
  :root { --paper: #fff; --raised: #fff; --ink: #000; --quiet: #444; --line: #bbb; --mat: #eee; --holds: #0a6b5e; --fails: #b3261e;
    --undecided: #8a5a00; --band: #0a6b5e1f; --band-edge: #0a6b5e80; --link: #000; color-scheme: light; }
  body { font-size: 10pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  body > header, main { max-width: none; padding: 0; }
  .numbers, .matrix, .numbers .badge, .matrix .badge { font-size: 8pt; } .numbers th, .numbers td { padding-right: .5rem; } .drawing { min-width: 9rem; } .scroll { overflow: visible; } .why > td { font-size: 7.5pt; }
  .claim, .record { break-before: page; } figure, .row, .quantity, h2, h3 { break-inside: avoid; } h2, h3, .quantity { break-after: avoid; }
  #viewer, .all-folds { display: none !important; }
}
)css";

} // namespace threefold::report
