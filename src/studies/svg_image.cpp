#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/format.h"
#include "io/products/colour_map.h"
#include "io/report/report_data.h"
#include "studies/figures.h"
#include "studies/html_page.h"
#include "studies/svg_plot.h"

namespace ifov::studies {

namespace {

/// A Windows bitmap, 8 bits a pixel with a palette: the simplest picture that browsers show.
std::string bitmap(const ImagePanel& panel) {
  const io::ColourMap& colours = panel.heat ? io::heat_colours() : io::sequential_colours();
  const std::uint32_t row_bytes = (static_cast<std::uint32_t>(panel.width) + 3u) / 4u * 4u;
  const std::uint32_t pixel_bytes = row_bytes * static_cast<std::uint32_t>(panel.height);
  std::string out = "BM";
  const auto put = [&out](std::uint32_t value, int bytes) {
    for (int b = 0; b < bytes; ++b) out += static_cast<char>(value >> (8 * b) & 255u);
  };
  constexpr std::uint32_t kHeader = 14 + 40 + 1024;
  for (std::uint32_t v : {kHeader + pixel_bytes, 0u, kHeader, 40u}) put(v, 4);
  put(static_cast<std::uint32_t>(panel.width), 4);
  put(static_cast<std::uint32_t>(panel.height), 4);
  put(1, 2);
  put(8, 2);
  for (std::uint32_t v : {0u, pixel_bytes, 2835u, 2835u, 256u, 0u}) put(v, 4);
  for (const io::Rgb& c : colours) put(static_cast<std::uint32_t>(c.b | c.g << 8 | c.r << 16), 4);
  for (int j = panel.height - 1; j >= 0; --j) {
    for (int i = 0; i < panel.width; ++i) {
      const double share = (panel.values[static_cast<std::size_t>(j * panel.width + i)] - panel.low) /
                           (panel.high - panel.low);
      out += static_cast<char>(std::isfinite(share) ? std::lround(255.0 * std::clamp(share, 0.0, 1.0)) : 0);
    }
    out.append(row_bytes - static_cast<std::uint32_t>(panel.width), '\0');
  }
  return out;
}

}  // namespace

std::string svg_image(const ImagePanel& panel) {
  const int scale = std::max(1, 256 / std::max(panel.width, panel.height));
  const int w = panel.width * scale, h = panel.height * scale;
  const io::ColourMap& colours = panel.heat ? io::heat_colours() : io::sequential_colours();
  std::string bar;
  for (int k = 0; k < 16; ++k) {
    const io::Rgb c = colours[static_cast<std::size_t>(k * 17)];
    bar += format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"10\" fill=\"rgb({},{},{})\"/>",
                  k * w / 16.0, h + 28, w / 16.0 + 0.5, c.r, c.g, c.b);
  }
  return format(
      "<svg viewBox=\"0 0 {} {}\" width=\"{}\" font-family=\"sans-serif\" font-size=\"12\" "
      "role=\"img\"><title>{}</title>"
      "<text x=\"0\" y=\"14\">{}</text><image x=\"0\" y=\"22\" width=\"{}\" height=\"{}\" "
      "style=\"image-rendering:pixelated\" href=\"data:image/bmp;base64,{}\"/>{}"
      "<text x=\"0\" y=\"{}\">{}</text><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{} {}</text></svg>\n",
      w, h + 56, w, html_text(panel.title), html_text(panel.title), w, h, io::base64(bitmap(panel)), bar, h + 52,
      number_text(panel.low), w, h + 52, number_text(panel.high), html_text(panel.unit));
}

}  // namespace ifov::studies
