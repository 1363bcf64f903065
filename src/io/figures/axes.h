#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/figures/canvas.h"

namespace ifov::io {

/// One direction of a plot.
struct Axis {
  double first = 0.0, last = 1.0;
  bool logarithmic = false;
  /// Share of the way from first to last, 0 to 1 between them.
  double position(double value) const;
  /// Values with a number beside them: 1, 2 or 5 times a power of ten, or powers of ten alone on long logarithmic axes;
  /// about `most` of them.
  std::vector<double> ticks(int most) const;
};

/// Round wavelengths (um) between the ends, more of them where the axis is short; so many that their numbers find room in
/// `width`.
std::vector<double> wavelength_ticks(const Axis& axis, double width);

/// Digits that tell the ticks apart, without zeros at the end; powers of ten far from 1 as 10 and a raised
/// number.
std::string tick_label(double value, const Axis& axis);

/// A rectangle with axes that curves are drawn in.
struct Plot {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  Axis across, up;
  std::string label;              ///< of the upright axis
  std::string label_across = {};  ///< of the other, under its numbers; empty: none
  double to_x(double value) const { return x + width * across.position(value); }
  double to_y(double value) const { return y + height * (1.0 - up.position(value)); }
};

/// Grid, frame, labels and numbers; those of the horizontal axis only where `numbers_below`.
void draw_axes(Canvas& canvas, const Plot& plot, const std::vector<double>& ticks_across, bool numbers_below);

struct Curve {
  std::string name;
  Ink ink;
  bool dashed = false;
  std::vector<CanvasPoint>
      points;          ///< values, not places; 0 and less is left out where the axis is logarithmic
  double width = 1.3;  ///< of the line
};

/// The curves inside the plot.
void draw_lines(Canvas& canvas, const Plot& plot, const std::vector<Curve>& curves);
/// The same, and their names in a row above the plot's upper left corner.
void draw_curves(Canvas& canvas, const Plot& plot, const std::vector<Curve>& curves);

}  // namespace ifov::io
