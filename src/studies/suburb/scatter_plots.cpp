#include "studies/suburb/scatter_plots.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/format.h"
#include "io/json/json_writer.h"
#include "io/report/report_data.h"
#include "studies/common/html_page.h"
#include "studies/suburb/scatter_plot_script.h"

namespace ifov::studies {

namespace {

constexpr std::size_t kAxes = kScatterPlotAxes;
constexpr double kCodes = 65535.0;

/// One scale for all axes of a transform would squeeze the weaker ones to a line: each axis has its own, the
/// same in every panel.
struct Scale {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
};

std::vector<Scale> scales_of(const std::vector<ScatterPlotImage>& images,
                             std::vector<float> ScatterPlotImage::*scores) {
  std::vector<Scale> scales(kAxes);
  // Single rays scatter so far that they would squeeze the mixtures of the others.
  for (std::size_t i = images.size() > 1 ? 1 : 0; i < images.size(); ++i)
    for (std::size_t k = 0; k < (images[i].*scores).size(); ++k) {
      Scale& s = scales[k % kAxes];
      s.low = std::min(s.low, (images[i].*scores)[k]);
      s.high = std::max(s.high, (images[i].*scores)[k]);
    }
  return scales;
}

std::string block(const std::string& id, std::string_view bytes) {
  return format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, io::base64(bytes));
}

/// Little-endian 16 bit codes.
std::string codes_of(const std::vector<float>& scores, const std::vector<Scale>& scales) {
  std::string out(2 * scores.size(), '\0');
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const Scale& s = scales[k % kAxes];
    const double share = s.high > s.low ? double(scores[k] - s.low) / double(s.high - s.low) : 0.5;
    const std::uint32_t code = static_cast<std::uint32_t>(std::lround(kCodes * std::clamp(share, 0.0, 1.0)));
    out[2 * k] = static_cast<char>(code & 255u);
    out[2 * k + 1] = static_cast<char>(code >> 8);
  }
  return out;
}

/// For the script; no text in it ends the element that holds it.
std::string meta_of(const std::vector<ScatterPlotImage>& images, const std::vector<std::string>& materials) {
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  std::vector<std::string> names;
  for (const ScatterPlotImage& image : images) names.push_back(image.name);
  json.object([&] {
    json.member("axes", kScatterPlotAxes);
    json.member("images", names);
    json.member("materials", materials);
  });
  std::string out;
  for (const char c : json.written()) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

std::string axis_choice(int axis) {
  std::string out = format("<select id=\"scatter-axis-{}\">", axis);
  for (int k = 0; k < kScatterPlotAxes; ++k)
    out += format("<option value=\"{}\"{}>component {}</option>", k, k == axis ? " selected" : "", k + 1);
  return out + "</select>\n";
}

}  // namespace

std::string scatter_plots(const std::vector<ScatterPlotImage>& images,
                          const std::vector<std::string>& materials) {
  std::string out =
      "<style>.scatter { display: grid; grid-template-columns: repeat(4, 1fr); gap: .6em; }\n"
      ".scatter figure { margin: 0; } .scatter canvas { width: 100%; border: 1px solid #ccc; touch-action: none; cursor: "
      "grab; }\n#scatter-legend span { display: inline-block; margin-right: 1em; } #scatter-legend i { display: "
      "inline-block; width: .8em; height: .8em; margin-right: .3em; }\n</style>\n<p>";
  out +=
      "<select id=\"scatter-transform\"><option value=\"principal\">principal components</option><option "
      "value=\"noise_fraction\">minimum noise fraction</option></select>\n";
  for (int axis = 0; axis < 3; ++axis) out += axis_choice(axis);
  out +=
      "<select id=\"scatter-colour\"><option value=\"density\">by density</option><option value=\"material\">by "
      "dominant material</option></select>\n<label>last panel <select id=\"scatter-last\"></select></label>\n"
      "<button id=\"scatter-spin\">turn</button> <button id=\"scatter-front\">front</button></p>\n"
      "<div class=\"scatter\">";
  for (int panel = 0; panel < 4; ++panel)
    out += "<figure><canvas></canvas><figcaption></figcaption></figure>";
  out += "</div>\n<p id=\"scatter-legend\" hidden></p>\n";
  out += format("<script type=\"application/json\" id=\"scatter-meta\">{}</script>\n",
                meta_of(images, materials));
  const std::vector<Scale> principal = scales_of(images, &ScatterPlotImage::principal);
  const std::vector<Scale> noise_fraction = scales_of(images, &ScatterPlotImage::noise_fraction);
  for (std::size_t k = 0; k < images.size(); ++k) {
    out += block(format("scatter-{}-principal", k), codes_of(images[k].principal, principal));
    out += block(format("scatter-{}-noise_fraction", k), codes_of(images[k].noise_fraction, noise_fraction));
    out += block(format("scatter-{}-dominant", k),
                 {reinterpret_cast<const char*>(images[k].dominant.data()), images[k].dominant.size()});
  }
  return out + format("<script>{}</script>\n", kScatterPlotScript);
}

}  // namespace ifov::studies
