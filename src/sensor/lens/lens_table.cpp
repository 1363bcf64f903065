#include "sensor/lens/lens_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ifov::sensor {

LensTable::LensTable(const std::vector<Row>& rows) : radii_{0.0}, displaced_{0.0} {
  for (const Row& row : rows) radii_.push_back(row.radius), displaced_.push_back(row.displaced);
  const std::size_t n = radii_.size();
  const auto secant = [&](std::size_t k) {
    return (displaced_[k + 1] - displaced_[k]) / (radii_[k + 1] - radii_[k]);
  };
  // Over the axis it goes on as it came from the other side: an odd function, straight there.
  slopes_.assign(n, secant(0));
  for (std::size_t k = 1; k < n; ++k) {
    if (k + 1 == n) {
      // Of the parabola through the last three, where that rises.
      const double last = secant(k - 1);
      const double before = k > 1 ? secant(k - 2) : last;
      const double h = radii_[k] - radii_[k - 1], g = k > 1 ? radii_[k - 1] - radii_[k - 2] : h;
      slopes_[k] = std::clamp(last + (last - before) * h / (h + g), 0.1 * last, 3.0 * last);
      continue;
    }
    const double a = secant(k - 1), b = secant(k);
    const double h = radii_[k] - radii_[k - 1], g = radii_[k + 1] - radii_[k];
    // The parabola's, but not so steep that a cubic would overshoot.
    slopes_[k] = std::min((a * g + b * h) / (g + h), 3.0 * std::min(a, b));
  }
}

LensTable::Along LensTable::along(double radius) const {
  if (radius >= radii_.back())
    return {displaced_.back() + slopes_.back() * (radius - radii_.back()), slopes_.back()};
  const auto above = std::upper_bound(radii_.begin(), radii_.end(), radius);
  const auto k = static_cast<std::size_t>(above - radii_.begin()) - 1;
  const double h = radii_[k + 1] - radii_[k], t = (radius - radii_[k]) / h;
  const double rise = displaced_[k + 1] - displaced_[k], a = h * slopes_[k], b = h * slopes_[k + 1];
  // Hermite's cubic, as a polynomial of t.
  const double c2 = 3.0 * rise - 2.0 * a - b, c3 = a + b - 2.0 * rise;
  return {displaced_[k] + t * (a + t * (c2 + t * c3)), (a + t * (2.0 * c2 + 3.0 * t * c3)) / h};
}

Lens::Place LensTable::image_of(Place direction) const {
  const double r = std::hypot(direction.x, direction.y);
  const double times = r > 0.0 ? along(r).displaced / r : slopes_.front();
  return {direction.x * times, direction.y * times};
}

Lens::Place LensTable::direction_of(Place image) const {
  const double wanted = std::hypot(image.x, image.y);
  if (!(wanted > 0.0)) return {};
  double low = 0.0, high = radii_.back();
  if (wanted >= displaced_.back()) {
    low = high = radii_.back() + (wanted - displaced_.back()) / slopes_.back();
  } else {
    const auto above = std::upper_bound(displaced_.begin(), displaced_.end(), wanted);
    const auto k = static_cast<std::size_t>(above - displaced_.begin());
    low = radii_[k - 1], high = radii_[k];
  }
  double r = 0.5 * (low + high);
  constexpr int kMost = 60;
  constexpr double kResidue = 1e-16;
  for (int k = 0; k < kMost && low < high; ++k) {
    const Along here = along(r);
    const double off = here.displaced - wanted;
    if (std::abs(off) <= kResidue) break;
    (off > 0.0 ? high : low) = r;
    // Newton's step, bisection where it leaves the bracket.
    const double next = here.slope > 0.0 ? r - off / here.slope : low - 1.0;
    const double to = next > low && next < high ? next : 0.5 * (low + high);
    if (to == r) break;
    r = to;
  }
  return {image.x * r / wanted, image.y * r / wanted};
}

double LensTable::scale(Place direction) const {
  const double r = std::hypot(direction.x, direction.y);
  const Along at = along(r);
  return at.slope * (r > 0.0 ? at.displaced / r : at.slope);
}

}  // namespace ifov::sensor
