#pragma once

#include <memory>

namespace ifov::sensor {

class Psf;

/// Light that optics scatter widely: a share of all of it, as the density a / (2 pi (r^2 + a^2)^(3/2)), of which 1 - a / sqrt(r^2 + a^2) lies within
/// r; across an edge it is Cauchy's a / (pi (x^2 + a^2)), and its modulation exp(-2 pi a v).
struct Halo {
  double share = 0.0;
  double radius_px = 0.0;  ///< that half of it lies within: a sqrt 3

  double scale_px() const;
  double mtf(double cycles_px) const;
};

/// What is left by a PSF (null: perfect optics), which is traced as before, and the halo, which is wings.
std::unique_ptr<Psf> with_halo(std::unique_ptr<const Psf> psf, const Halo& halo);

}  // namespace ifov::sensor
