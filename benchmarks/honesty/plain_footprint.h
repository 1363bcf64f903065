#pragma once

#include <vector>

#include "honesty/random_stream.h"
#include "io/document/sensor_document.h"
#include "sampling/field.h"

namespace ifov::benchmarks {

/// What a pixel sees, from the document alone: the sensitive square blurred by the whole PSF, which nothing cuts.
class PlainFootprint {
 public:
  /// Throws std::runtime_error for a PSF given as an image.
  explicit PlainFootprint(const io::SensorDocument& sensor);

  /// An offset from the pixel's centre, px. The two numbers in [0, 1) place it, for draws in strata; `random` gives
  /// what else is needed.
  sampling::FocalPoint draw(double u1, double u2, RandomStream& random) const;

  /// Of offsets, px^-2; not for an Airy pattern.
  double density(double dx_px, double dy_px) const;

  /// Beyond this offset along either axis the density is below 1e-8 of its highest; infinite for an Airy pattern.
  double reach_px() const { return reach_px_; }

 private:
  double profile(double x_px) const;       // the density is profile(x) profile(y)
  double distribution(double x_px) const;  // its integral from minus infinity
  double quantile(double u) const;

  double side_px_ = 1.0, sigma_px_ = 0.0, airy_q_px_ = 0.0, reach_px_ = 0.5;
  std::vector<double> quantiles_;  // at equal steps, to begin from
};

}  // namespace ifov::benchmarks
