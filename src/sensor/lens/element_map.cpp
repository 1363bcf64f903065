#include "sensor/lens/element_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ifov::sensor {
namespace {

using Place = Lens::Place;

Place plus(Place a, Place b, double times) { return {a.x + times * b.x, a.y + times * b.y}; }

/// Slopes at nodes that are `stride` apart in `values`: of the parabola through a node and both its neighbours, at the ends of that through
/// three.
void slopes_along(const std::vector<double>& knots, const std::vector<Place>& values, std::size_t first,
                  std::size_t stride, std::vector<Place>& slopes) {
  const std::size_t n = knots.size();
  const auto at = [&](std::size_t k) { return first + k * stride; };
  const auto secant = [&](std::size_t k) {
    const double h = knots[k + 1] - knots[k];
    const Place &a = values[at(k)], &b = values[at(k + 1)];
    return Place{(b.x - a.x) / h, (b.y - a.y) / h};
  };
  for (std::size_t k = 0; k < n; ++k) {
    if (n == 2) {
      slopes[at(k)] = secant(0);
      continue;
    }
    const std::size_t m = std::clamp<std::size_t>(k, 1, n - 2);
    const Place a = secant(m - 1), b = secant(m);
    const double h = knots[m] - knots[m - 1], g = knots[m + 1] - knots[m];
    const double bend = (knots[k] - knots[m]) * 2.0 / (g + h);  // second derivative times the step
    const Place middle{(a.x * g + b.x * h) / (g + h), (a.y * g + b.y * h) / (g + h)};
    slopes[at(k)] = plus(middle, {b.x - a.x, b.y - a.y}, bend);
  }
}

/// Which stretch a place is in, and Hermite's four weights there with their derivatives; beyond the ends of a straight line.
struct Stretch {
  std::size_t low = 0, high = 0;
  double value[4], slope[4];  // of the values and slopes at low and high
};

Stretch stretch_of(const std::vector<double>& knots, double place) {
  if (knots.size() == 1) return {0, 0, {1.0, place - knots[0], 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}};
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, place);
  const auto high = static_cast<std::size_t>(above - knots.begin()), low = high - 1;
  const double h = knots[high] - knots[low], t = (place - knots[low]) / h;
  if (t < 0.0) return {low, high, {1.0, t * h, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}};
  if (t > 1.0) return {low, high, {0.0, 0.0, 1.0, (t - 1.0) * h}, {0.0, 0.0, 0.0, 1.0}};
  const double s = 1.0 - t;
  return {low,
          high,
          {s * s * (1.0 + 2.0 * t), h * t * s * s, t * t * (3.0 - 2.0 * t), -h * t * t * s},
          {-6.0 * t * s / h, s * (1.0 - 3.0 * t), 6.0 * t * s / h, t * (3.0 * t - 2.0)}};
}

double determinant(const Place& by_x, const Place& by_y) { return by_x.x * by_y.y - by_x.y * by_y.x; }

}  // namespace

ElementMap::ElementMap(std::vector<double> x, std::vector<double> y, const std::vector<Place>& directions)
    : x_(std::move(x)),
      y_(std::move(y)),
      at_(directions),
      by_x_(at_.size()),
      by_y_(at_.size(), Place{0.0, 1.0}),
      by_both_(at_.size()) {
  const std::size_t columns = x_.size(), rows = y_.size();
  for (std::size_t j = 0; j < rows; ++j) slopes_along(x_, at_, j * columns, 1, by_x_);
  for (std::size_t i = 0; rows > 1 && i < columns; ++i) slopes_along(y_, at_, i, columns, by_y_);
  for (std::size_t j = 0; rows > 1 && j < rows; ++j) slopes_along(x_, by_y_, j * columns, 1, by_both_);
  middle_ = mapped({0.5 * (x_.front() + x_.back()), 0.5 * (y_.front() + y_.back())});
}

ElementMap::Mapped ElementMap::mapped(Place image) const {
  const Stretch x = stretch_of(x_, image.x), y = stretch_of(y_, image.y);
  Mapped sum;
  for (int b = 0; b < 2; ++b) {
    const std::size_t row = (b == 0 ? y.low : y.high) * x_.size();
    const double v0 = y.value[2 * b], v1 = y.value[2 * b + 1], s0 = y.slope[2 * b], s1 = y.slope[2 * b + 1];
    if (v0 == 0.0 && v1 == 0.0 && s0 == 0.0 && s1 == 0.0) continue;
    for (int a = 0; a < 2; ++a) {
      const std::size_t node = row + (a == 0 ? x.low : x.high);
      const double u0 = x.value[2 * a], u1 = x.value[2 * a + 1], r0 = x.slope[2 * a], r1 = x.slope[2 * a + 1];
      const Place &f = at_[node], &fx = by_x_[node], &fy = by_y_[node], &fxy = by_both_[node];
      const auto add = [&](Place& to, double p0, double p1, double q0, double q1) {
        to = plus(plus(plus(plus(to, f, p0 * q0), fx, p1 * q0), fy, p0 * q1), fxy, p1 * q1);
      };
      add(sum.direction, u0, u1, v0, v1);
      add(sum.by_x, r0, r1, v0, v1);
      add(sum.by_y, u0, u1, s0, s1);
    }
  }
  return sum;
}

Lens::Place ElementMap::direction_of(Place image) const { return mapped(image).direction; }

Lens::Place ElementMap::image_of(Place direction) const {
  constexpr int kMost = 100;
  constexpr double kResidue = 1e-15;
  const auto step_from = [&](const Mapped& from) {
    const double ex = direction.x - from.direction.x, ey = direction.y - from.direction.y,
                 det = determinant(from.by_x, from.by_y);
    return Place{(from.by_y.y * ex - from.by_y.x * ey) / det, (from.by_x.x * ey - from.by_x.y * ex) / det};
  };
  const auto off = [&](const Mapped& from) {
    return std::hypot(from.direction.x - direction.x, from.direction.y - direction.y);
  };
  const Place guess = step_from(middle_);
  Place at{0.5 * (x_.front() + x_.back()) + guess.x, 0.5 * (y_.front() + y_.back()) + guess.y};
  Mapped here = mapped(at);
  for (int k = 0; k < kMost && off(here) > kResidue; ++k) {
    Place step = step_from(here);
    bool nearer = false;
    for (int halved = 0; halved < 30 && !nearer; ++halved) {
      const Place next{at.x + step.x, at.y + step.y};
      const Mapped there = mapped(next);
      nearer = off(there) < off(here);
      if (nearer) at = next, here = there;
      step = {0.5 * step.x, 0.5 * step.y};
    }
    if (!nearer) break;  // to rounding
  }
  return at;
}

double ElementMap::area(Place image) const {
  const Mapped at = mapped(image);
  return determinant(at.by_x, at.by_y);
}

double ElementMap::stretch(Place image) const { return mapped(image).by_x.x; }

double ElementMap::scale(Place direction) const { return 1.0 / std::abs(area(image_of(direction))); }

std::optional<std::size_t> ElementMap::first_fold() const {
  constexpr int kSteps = 4;
  constexpr double kLeast = 0.02;  // of what it is in the middle
  const double usual = determinant(middle_.by_x, middle_.by_y);
  const std::size_t columns = x_.size(), rows = y_.size();
  for (std::size_t j = 0; j < std::max<std::size_t>(rows - 1, 1); ++j)
    for (std::size_t i = 0; i + 1 < columns; ++i)
      for (int b = 0; b <= (rows > 1 ? kSteps : 0); ++b)
        for (int a = 0; a <= kSteps; ++a) {
          const double u = static_cast<double>(a) / kSteps, v = static_cast<double>(b) / kSteps;
          const Mapped at =
              mapped({x_[i] + u * (x_[i + 1] - x_[i]), rows > 1 ? y_[j] + v * (y_[j + 1] - y_[j]) : y_[0]});
          if (!(determinant(at.by_x, at.by_y) > kLeast * std::abs(usual)) || !(at.by_x.x > 0.0) ||
              !(at.by_y.y > 0.0))
            return j * columns + i;
        }
  return std::nullopt;
}

}  // namespace ifov::sensor
