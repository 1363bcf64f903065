#pragma once

#include <vector>

#include "sampling/random.h"

namespace ifov::sensor {

class Psf;

/// What the cut of a PSF leaves out, as shares of a pixel's whole response that fall on cells of the focal plane around
/// it: wings that are too wide to be traced and too faint to need it. Cells are of three sizes, coarser farther out; all
/// lie on grids that the image's corner begins, so that neighbouring pixels and tiles share them:
///
/// | level | cells        | of which pixels                                               |
/// |-------|--------------|---------------------------------------------------------------|
/// | 0     | half a pixel | blocks of 4 px, the pixel's own and two to each side          |
/// | 1     | 4 px         | blocks of 16 px, likewise, without what level 0 covers        |
/// | 2     | 16 px        | blocks of 64 px, likewise, without what level 1 covers        |
///
/// What lies farther out, 128 px and more, is `rest`.
class PsfWings {
 public:
  static constexpr int kNear = 4, kMiddle = 16, kFar = 64;  ///< sides of the levels' blocks, px
  static constexpr int kBlocks = 2;                         ///< of them to each side

  /// Of a square that `fill_factor` leaves of a pixel. `shift_px`: from the pixel's centre to the middle of its response.
  PsfWings(const Psf& psf, double fill_factor, sampling::Point2 shift_px = {});
  /// Of a rectangle.
  PsfWings(const Psf& psf, sampling::Point2 sides_px, sampling::Point2 shift_px);

  double kept() const { return kept_; }
  /// Share on the half-pixel cell number (2 dx + 0 or 1, 2 dy + 0 or 1), dx and dy being whole pixels from the
  /// pixel; |dx|, |dy| < 12.
  double half_cell(int column, int row) const {
    return near_[static_cast<std::size_t>((row + kHalfCells / 2) * kHalfCells + column + kHalfCells / 2)];
  }
  /// Share on the pixels [x0, x0 + side) x [y0, y0 + side) counted from the pixel; side 4 or 16, within 192 px.
  double square(int x0, int y0, int side) const;

  struct Density {
    double per_px2;
    double half_width;  ///< of what tables leave open
  };
  /// Share per px^2 at a place that lies so far from the pixel's centre.
  Density density(double dx_px, double dy_px) const;

 private:
  static constexpr int kHalfCells = 48;   // along a side of level 0's table
  static constexpr int kReach = 192;      // px, of what squares are summed from
  static constexpr int kPointSteps = 16;  // of the table of densities near the pixel, along a pixel
  static constexpr int kPoints = kHalfCells / 2 * kPointSteps + 1;  // along its side
  double summed(int x, int y) const {
    return summed_[static_cast<std::size_t>(y) * (2 * kReach + 1) + static_cast<std::size_t>(x)];
  }

  static constexpr double kRadialFrom_px = 8.0, kRadialTo_px = 192.0;
  struct Radial {
    double density = 0.0, once = 0.0, twice = 0.0;  // integrated over the radius
  };
  void tabulate_radius(const Psf& psf);
  double twice_integrated(double r_px) const;

  Density between_pixels(double dx_px, double dy_px) const;

  double kept_;
  sampling::Point2 sides_;
  bool round_;
  sampling::Point2 shift_;
  double radial_step_px_ = 0.0;
  std::vector<Radial> radial_;
  std::vector<double> near_;    // by half cell
  std::vector<double> points_;  // densities, by sixteenth of a pixel
  std::vector<double> summed_;  // over pixels, summed areas
};

}  // namespace ifov::sensor
