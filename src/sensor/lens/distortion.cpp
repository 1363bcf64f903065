#include "sensor/lens/distortion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace ifov::sensor {
namespace {

double determinant(const std::array<double, 4>& by) { return by[0] * by[3] - by[1] * by[2]; }

}  // namespace

Distortion::Distortion(const Terms& terms, double far) : terms_(terms), none_(terms.none()) {
  if (!std::isfinite(terms.k1 + terms.k2 + terms.k3 + terms.p1 + terms.p2))
    throw InputError("a lens distortion with terms that are not finite");
  if (none_) return;
  // Areas vanish at a fold; all around, as far as twice what matters may be seen under.
  constexpr int kSteps = 2000, kAround = 48;
  constexpr double kLeast = 0.02, kFarther = 4.0;
  const double farthest = kFarther * std::max(far, 1e-6) * std::numbers::sqrt2;
  for (int k = 1; k <= kSteps; ++k) {
    const double r = farthest * k / kSteps;
    for (int a = 0; a < kAround; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / kAround;
      const std::array<double, 4> by = by_terms({r * std::cos(angle), r * std::sin(angle)}).by;
      // Along the radius it must rise, too: a turn by half a circle keeps the sign of areas.
      const double outwards = by[0] * std::cos(angle) * std::cos(angle) +
                              by[3] * std::sin(angle) * std::sin(angle) +
                              (by[1] + by[2]) * std::sin(angle) * std::cos(angle);
      if (determinant(by) < kLeast || outwards < kLeast) return;
    }
    fold_ = r;
  }
}

Distortion::Mapped Distortion::by_terms(Place d) const {
  const auto [k1, k2, k3, p1, p2] = terms_;
  const double x = d.x, y = d.y, s = x * x + y * y;
  const double radial = 1.0 + s * (k1 + s * (k2 + s * k3));
  const double slope = 2.0 * (k1 + s * (2.0 * k2 + s * 3.0 * k3));  // of `radial`, over x by x
  return {
      {x * radial + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
       y * radial + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y},
      {radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y,
       x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y, radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x}};
}

Distortion::Mapped Distortion::mapped(Place d) const {
  const double r = std::hypot(d.x, d.y);
  if (r <= fold_) return by_terms(d);
  const Place rim{d.x * fold_ / r, d.y * fold_ / r};
  Mapped there = by_terms(rim);
  const double dx = d.x - rim.x, dy = d.y - rim.y;
  there.image.x += there.by[0] * dx + there.by[1] * dy;
  there.image.y += there.by[2] * dx + there.by[3] * dy;
  return there;
}

Distortion::Place Distortion::image_of(Place direction) const {
  return none_ ? direction : mapped(direction).image;
}

Distortion::Place Distortion::direction_of(Place image) const {
  if (none_) return image;
  constexpr int kMost = 100;
  constexpr double kResidue = 1e-15;
  Place at = image;
  const auto off = [&](const Place& p) { return std::hypot(p.x - image.x, p.y - image.y); };
  Mapped here = mapped(at);
  for (int k = 0; k < kMost && off(here.image) > kResidue; ++k) {
    const double ex = image.x - here.image.x, ey = image.y - here.image.y, det = determinant(here.by);
    Place step{(here.by[3] * ex - here.by[1] * ey) / det, (here.by[0] * ey - here.by[2] * ex) / det};
    // Half the step where the whole one leads further off.
    bool nearer = false;
    for (int halved = 0; halved < 30 && !nearer; ++halved) {
      const Place next{at.x + step.x, at.y + step.y};
      const Mapped there = mapped(next);
      nearer = off(there.image) < off(here.image);
      if (nearer) at = next, here = there;
      step = {0.5 * step.x, 0.5 * step.y};
    }
    if (!nearer) break;  // to rounding
  }
  return at;
}

double Distortion::scale(Place direction) const {
  return none_ ? 1.0 : std::abs(determinant(mapped(direction).by));
}

bool Distortion::holds(Place image) const {
  if (none_) return true;
  const Place direction = direction_of(image);
  return std::hypot(direction.x, direction.y) <= fold_;
}

}  // namespace ifov::sensor
