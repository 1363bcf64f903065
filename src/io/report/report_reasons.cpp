#include "io/report/report_reasons.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/format.h"
#include "io/quantities/quality_classes.h"
#include "io/report/report_data.h"
#include "io/report/report_words.h"

namespace ifov::io {
namespace {

std::string swatch(std::size_t quality_class) {
  const Rgb c = class_colours()[quality_class];
  return format("<i class=\"swatch\" style=\"background:rgb({},{},{})\"></i>", c.r, c.g, c.b);
}

std::string legend_row(std::size_t quality_class, std::string_view words, std::uint64_t pixels) {
  return format("<tr><td>{}{}</td><td>{}</td><td>{}</td></tr>", swatch(quality_class),
                escape_html(class_name(quality_class)), escape_html(words), count(pixels));
}

}  // namespace

std::string reasons_section(const RunRecord& record) {
  const auto& s = record.statistics;
  std::vector<std::size_t> order(s.reasons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return s.reasons[a] > s.reasons[b]; });
  std::string html =
      "<section><h2>Why pixels are not converged</h2><div class=\"two\"><div class=\"stage\"><canvas id=\"map-reasons\" "
      "style=\"cursor:default\"></canvas></div><div><table class=\"legend\"><thead><tr><th>Reason</th><th>Meaning</th>"
      "<th>Pixels</th></tr></thead><tbody>";
  html += legend_row(0, "every interval is within its limit, and nothing speaks against it", s.converged);
  for (const std::size_t r : order)
    if (s.reasons[r] > 0)
      html += legend_row(r + 1, sampling::words_of(static_cast<sampling::Reason>(r)), s.reasons[r]);
  return html +
         "</tbody></table><p class=\"soft\">A pixel may have several reasons; the map shows the gravest.</p></div></div>"
         "</section>\n";
}

void write_reasons(JsonWriter& json) {
  const auto colour = [](std::size_t quality_class) {
    const Rgb c = class_colours()[quality_class];
    return std::array<int, 3>{c.r, c.g, c.b};
  };
  json.list("reasons", [&] {
    for (std::size_t r = 0; r < sampling::kReasonNames.size(); ++r)
      json.object([&] {
        json.member("name", sampling::kReasonNames[r]);
        json.member("words", sampling::words_of(static_cast<sampling::Reason>(r)));
        json.member("colour", colour(r + 1));
      });
  });
  std::vector<int> gravity;
  for (const sampling::Reason reason : sampling::reasons_by_gravity())
    gravity.push_back(static_cast<int>(reason));
  json.member("gravity", gravity);
  json.member("convergedColour", colour(0));
}

}  // namespace ifov::io
