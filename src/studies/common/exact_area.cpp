#include "studies/common/exact_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ifov::studies {

namespace {

/// Integral of sqrt(r^2 - t^2) over t from 0 to x.
double half_segment(double x, double r) {
  x = std::clamp(x, -r, r);
  return 0.5 * (x * std::sqrt(std::max(0.0, r * r - x * x)) + r * r * std::asin(x / r));
}

/// Area of the disc about the origin where X < x and Y < y: the integral over X of how much of the chord at X
/// lies below y.
double corner_area(double x, double y, double r) {
  const double right = std::clamp(x, -r, r);
  if (y <= -r || right <= -r) return 0.0;
  const auto whole_chords = [r](double from, double to) {
    return to > from ? 2.0 * (half_segment(to, r) - half_segment(from, r)) : 0.0;
  };
  if (y >= r) return whole_chords(-r, right);
  // Chords reach across y only for |X| < a; beyond, they lie below it (y > 0) or above it.
  const double a = std::sqrt(r * r - y * y);
  double sum = 0.0;
  if (const double to = std::min(right, a); to > -a)
    sum += y * (to + a) + half_segment(to, r) - half_segment(-a, r);
  if (y > 0.0) sum += whole_chords(-r, std::min(right, -a)) + whole_chords(a, right);
  return sum;
}

}  // namespace

double area_in_rectangle(const Disc& disc, double x0, double y0, double x1, double y1) {
  const auto corner = [&](double x, double y) {
    return corner_area(x - disc.x_px, y - disc.y_px, disc.radius_px);
  };
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

Outline clip_half_plane(const Outline& outline, double a, double b, double c) {
  Outline kept;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const sampling::FocalPoint p = outline[k], q = outline[(k + 1) % outline.size()];
    const double at_p = a * p.x_px + b * p.y_px - c, at_q = a * q.x_px + b * q.y_px - c;
    if (at_p <= 0.0) kept.push_back(p);
    if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0)) {
      const double t = at_p / (at_p - at_q);
      kept.push_back({p.x_px + t * (q.x_px - p.x_px), p.y_px + t * (q.y_px - p.y_px)});
    }
  }
  return kept;
}

double area(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const sampling::FocalPoint p = outline[k], q = outline[(k + 1) % outline.size()];
    twice += p.x_px * q.y_px - q.x_px * p.y_px;
  }
  return 0.5 * std::abs(twice);
}

double area_in_rectangle(const Outline& outline, double x0, double y0, double x1, double y1) {
  Outline kept = clip_half_plane(outline, -1.0, 0.0, -x0);
  kept = clip_half_plane(kept, 1.0, 0.0, x1);
  kept = clip_half_plane(kept, 0.0, -1.0, -y0);
  return area(clip_half_plane(kept, 0.0, 1.0, y1));
}

Outline oblong(double x, double y, double length, double width, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Outline corners;
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    corners.push_back({x + u * length * c - v * width * s, y + u * length * s + v * width * c});
  return corners;
}

}  // namespace ifov::studies
