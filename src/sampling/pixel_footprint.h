#pragma once

#include <vector>

namespace ifov::sampling {

/// The response of one pixel over the focal plane (PSF convolved with the detector's sensitive area), as a density
/// h(dx, dy) in 1/px^2 about the pixel's centre, with integral 1 and support |dx|, |dy| <= half_width_px.
class PixelFootprint {
 public:
  /// A uniform square of the given side (1: the whole pixel; less: a fill factor of side^2).
  static PixelFootprint box(double side_px);

  /// Values of h at the centres of n x n equal cells over the square of the given half width (n = cells_per_side),
  /// row by row, y downwards; normalised here. Negative values are an error.
  static PixelFootprint tabulated(double half_width_px, int cells_per_side, std::vector<double> values);

  double half_width_px() const { return half_width_; }
  bool uniform() const { return cells_ == 0; }
  /// Uniform over the whole pixel and nothing else.
  bool whole_pixel() const { return uniform() && half_width_px() == 0.5; }

  /// h(dx, dy), bilinear between cell centres; 0 outside.
  double density(double dx_px, double dy_px) const;

  /// Integral of h over the rectangle [x0, x1] x [y0, y1] (about the pixel's centre), of what density() says.
  double integral(double x0_px, double y0_px, double x1_px, double y1_px) const;

 private:
  PixelFootprint() = default;
  double half_width_ = 0.5;
  int cells_ = 0;                // cells per side; 0 for a box
  std::vector<double> density_;  // h at cell centres
  std::vector<double> summed_;   // summed-area table, (cells_ + 1)^2
};

}  // namespace ifov::sampling
