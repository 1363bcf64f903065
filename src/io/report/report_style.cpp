#include "io/report/report_page.h"

namespace ifov::io {

const char* const kReportStyle = R"css(
:root{--ink:#16202c;--soft:#5b6875;--line:#dde3e8;--accent:#0b6b7d;--paper:#fff;--wash:#f5f7f8;--warn:#a8440c}
*{box-sizing:border-box}
body{margin:0;background:var(--wash);color:var(--ink);font:15px/1.5 "Source Sans 3","Segoe UI","Helvetica Neue",Arial,sans-serif}
main{max-width:1180px;margin:0 auto;padding:34px 28px 60px}
h1{font-size:28px;line-height:1.2;margin:0 0 4px;font-weight:650;letter-spacing:-.01em}
h2{font-size:17px;margin:0 0 12px;font-weight:650}
.meta{color:var(--soft);margin:0 0 22px}
section{background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:20px 22px;margin:0 0 18px}
.two{display:grid;grid-template-columns:1fr 1fr;gap:18px}
.two>section{margin:0}
.two+section,.two+.two{margin-top:18px}
.statement p{margin:0 0 6px;font-size:16px}
.statement .soft{font-size:14px}
.soft{color:var(--soft)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(130px,1fr));gap:0;border:1px solid var(--line);border-radius:8px;background:var(--paper);margin:0 0 18px;overflow:hidden}
.tiles div{padding:13px 18px;border-right:1px solid var(--line)}
.tiles div:last-child{border-right:0}
.tiles b{display:block;font-size:22px;font-weight:600;font-variant-numeric:tabular-nums;white-space:nowrap}
.tiles span{color:var(--soft);font-size:13px}
.viewer{display:grid;grid-template-columns:minmax(0,1.08fr) minmax(0,1fr);gap:30px}
.stage{position:relative;line-height:0;background:#eceff1}
.stage canvas{width:100%;image-rendering:pixelated;cursor:crosshair}
.stage svg{position:absolute;inset:0;width:100%;height:100%;pointer-events:none}
.controls{display:flex;flex-wrap:wrap;gap:10px 16px;align-items:center;margin:0 0 12px}
.controls input[type=range]{flex:1;min-width:140px;accent-color:var(--accent)}
.tabs{display:inline-flex;border:1px solid var(--line);border-radius:6px;overflow:hidden}
.tabs button{border:0;background:var(--paper);padding:5px 12px;font:inherit;font-size:14px;cursor:pointer;border-right:1px solid var(--line);color:var(--ink)}
.tabs button:last-child{border-right:0}
.tabs button[aria-pressed=true]{background:var(--accent);color:#fff}
.tabs button:focus-visible,input:focus-visible{outline:2px solid var(--accent);outline-offset:1px}
.bar{display:block;width:100%;margin-top:8px}
svg text{font:12px "Source Sans 3","Segoe UI","Helvetica Neue",Arial,sans-serif;fill:var(--soft)}
svg .axis{stroke:#9aa6b1;fill:none}
svg .grid{stroke:#e8edf0}
svg .curve{stroke:var(--accent);fill:none;stroke-width:1.6}
svg .error{stroke:var(--accent);stroke-width:1;opacity:.75}
svg .dot{fill:var(--accent)}
svg .hist{fill:var(--accent)}
svg .limit{stroke:var(--warn);stroke-dasharray:4 3}
svg .limit-text{fill:var(--warn)}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:5px 10px;border-bottom:1px solid var(--line)}
th{font-weight:600;color:var(--soft);vertical-align:bottom}
th:first-child,td:first-child{text-align:left}
tbody tr:last-child td{border-bottom:0}
.scroll{overflow:auto;max-height:430px}
.scroll thead th{position:sticky;top:0;background:var(--paper)}
.files td{overflow-wrap:anywhere}
.files td:last-child{font:12px ui-monospace,Menlo,Consolas,monospace;color:var(--soft)}
.files td:nth-child(2){text-align:left}
pre{overflow:auto;background:var(--wash);border:1px solid var(--line);border-radius:6px;padding:14px;font:13px/1.45 ui-monospace,Menlo,Consolas,monospace;max-height:520px}
details summary{cursor:pointer;font-weight:650;font-size:17px}
details[open] summary{margin-bottom:12px}
.swatch{display:inline-block;width:13px;height:13px;border-radius:3px;margin-right:8px;vertical-align:-1px}
.legend td:nth-child(2),.legend th:nth-child(2){text-align:left}
.legend td:first-child{white-space:nowrap}
.note{border-left:3px solid var(--warn);padding:2px 0 2px 12px;margin:8px 0 0;color:var(--ink)}
figure{margin:0}
figcaption{color:var(--soft);font-size:13px;margin-top:6px}
@media(max-width:820px){.two,.viewer{grid-template-columns:1fr}main{padding:20px 14px}}
@media print{body{background:#fff}section,.tiles{break-inside:avoid}.controls{display:none}}
)css";

}  // namespace ifov::io
