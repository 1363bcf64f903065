#include "studies/common/html_page.h"

#include "core/format.h"

namespace ifov::studies {

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  return out;
}

std::string html_page(std::string_view title, std::string_view body) {
  constexpr std::string_view kStyle = R"(
body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; margin: 1em 0; display: block; overflow-x: auto; }
td:first-child { min-width: 11em; }
th, td { border-bottom: 1px solid #ddd; padding: .25em .8em; text-align: left; vertical-align: top; }
td.n { text-align: right; white-space: nowrap; }
td.met { color: #00703c; font-weight: bold; }
td.missed { color: #b00020; font-weight: bold; }
figure { margin: 1.5em 0; } figcaption { font-size: 90%; color: #555; max-width: 50em; }
.row { display: flex; flex-wrap: wrap; gap: 1.2em; }
svg, img { max-width: 100%; height: auto; }
.row img { max-width: 31%; }
small { color: #777; }
)";
  return format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>{}</title><style>{}</style></head>\n"
      "<body>\n<h1>{}</h1>\n{}</body></html>\n",
      html_text(title), kStyle, html_text(title), body);
}

}  // namespace ifov::studies
