#include "io/figures/colour_scale.h"

#include <algorithm>
#include <cmath>

namespace ifov::io {

Rgb colour_at(const ColourMap& colours, double share) {
  return colours[static_cast<std::size_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)))];
}

void draw_colour_scale(Canvas& canvas, const ColourMap& colours, const Axis& scale, double x, double y,
                       double height) {
  constexpr double kBarWidth = 16.0;
  for (int k = 0; k < 256; ++k) {
    const Rgb c = colours[static_cast<std::size_t>(k)];
    canvas.fill_rectangle(x, y + height * (255 - k) / 256.0, kBarWidth, height / 256.0 + 0.6,
                          {c.r / 255.0, c.g / 255.0, c.b / 255.0});
  }
  for (const double tick : scale.ticks(5)) {
    const double at = y + height * (1.0 - scale.position(tick));
    canvas.fill_rectangle(x + kBarWidth, at - 0.5, 5.0, 1.0, kBlackInk);
    canvas.text({x + kBarWidth + 8.0, at + 4.5}, tick_label(tick, scale), 12.0);
  }
}

}  // namespace ifov::io
