#include "sampling/footprint_point.h"

#include <algorithm>

#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

FocalPoint footprint_point(const PixelFootprint& h, Point2 u) {
  const double w = h.half_width_px(), strip = w / 256.0;
  const auto invert = [&](double target, auto below) {
    double low = -w, high = w;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) < target ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const double x = invert(u.x * h.integral(-w, -w, w, w), [&](double t) { return h.integral(-w, -w, t, w); });
  const double a = std::clamp(x - strip, -w, w - strip), b = std::clamp(x + strip, -w + strip, w);
  const double y = invert(u.y * h.integral(a, -w, b, w), [&](double t) { return h.integral(a, -w, b, t); });
  return {x, y};
}

}  // namespace ifov::sampling
