#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::platform {

/// Cubic spline through points of several components: twice continuously differentiable, its third derivative continuous at the
/// second knot and the last but one ("not a knot": de Boor, A Practical Guide to Splines, chapter IV), so that it is a cubic where
/// four points lie on one, a parabola through three points and a straight line through two. Beyond its ends it goes on straight.
class CubicSpline {
 public:
  /// At least one knot, increasing; `values` are knots x components. One knot: constant.
  CubicSpline(std::vector<double> knots, std::vector<double> values);

  std::size_t components() const { return components_; }
  double first() const { return knots_.front(); }
  double last() const { return knots_.back(); }

  /// Value, and derivative where there is room for it, at t.
  void at(double t, std::span<double> value, std::span<double> slope = {}) const;

 private:
  double knot_slope(std::size_t knot, std::size_t component) const;

  std::size_t components_ = 0;
  std::vector<double> knots_, values_, bends_;  // bends: second derivatives, as values
};

}  // namespace ifov::platform
