#pragma once

#include <memory>
#include <span>
#include <vector>

namespace ifov::sampling {

struct Point2;

/// The response of one pixel over the focal plane (PSF convolved with the detector's sensitive area), as a density
/// h(dx, dy) in 1/px^2 about the pixel's centre, with integral 1 and support |dx|, |dy| <= half_width_px.
class PixelFootprint {
 public:
  struct Values;  // of tables and products
  /// A uniform square of the given side (1: the whole pixel; less: a fill factor of side^2).
  static PixelFootprint box(double side_px);

  /// Values of h at the centres of n x n equal cells over the square of the given half width (n = cells_per_side),
  /// row by row, y downwards; normalised here. Negative values are an error.
  static PixelFootprint tabulated(double half_width_px, int cells_per_side, std::vector<double> values);

  /// The product of densities along x and y, by values at the centres of equal cells, any number; normalised here. `cell_px`: as of a table.
  static PixelFootprint product(double half_width_px, double cell_px, std::vector<double> across,
                                std::vector<double> along);

  /// A stretch of a density along y (or x), straight from `from` to `to`; nothing below y0 or above y1.
  struct Piece {
    double y0 = 0.0, y1 = 0.0, from = 0.0, to = 0.0;
    double at(double y) const { return from + (to - from) * (y - y0) / (y1 - y0); }
  };

  /// Uniform over `side_px` along x times pieces along y, which follow each other upwards without overlap; normalised here.
  static PixelFootprint striped(double side_px, std::vector<Piece> pieces);
  /// The same turned: pieces along x, uniform along y.
  static PixelFootprint striped_along_x(double side_px, std::vector<Piece> pieces);

  double half_width_px() const { return half_width_; }
  /// Of striped(), along x, where it is uniform; of striped_along_x() along y. Along the pieces the half width holds.
  double half_width_across_px() const { return pieces_.empty() ? half_width_ : half_width_across_; }
  bool along_x() const { return along_x_; }
  bool uniform() const { return cell_ == 0.0 && pieces_.empty(); }
  /// Of striped(), the density along y (of striped_along_x() along x); integrals over polygons are exact piece by piece. Else empty.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Side of a table's cells, px, over which the density is smooth; 0 of a box and of pieces.
  double cell_px() const { return cell_; }
  /// Uniform over the whole pixel and nothing else.
  bool whole_pixel() const { return uniform() && half_width_px() == 0.5; }

  /// h(dx, dy), bilinear between cell centres; 0 outside. densities(): at many places, of a footprint that stands `at` one.
  double density(double dx_px, double dy_px) const;
  void densities(std::span<const double> x, std::span<const double> y, Point2 at, std::span<double> to) const;

  /// Integral of h over the rectangle [x0, x1] x [y0, y1] (about the pixel's centre), of what density() says.
  double integral(double x0_px, double y0_px, double x1_px, double y1_px) const;

 private:
  PixelFootprint() = default;
  double half_width_ = 0.5, half_width_across_ = 0.5, cell_ = 0.0;
  bool along_x_ = false;
  std::vector<Piece> pieces_;             // their integral 1; empty for others
  std::shared_ptr<const Values> values_;  // null of a box and of pieces
};

}  // namespace ifov::sampling
