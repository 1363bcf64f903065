#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ifov::sensor {

class Psf;
struct CarrierDiffusion;

/// What a point goes through on its way into a pixel, one after the other: their modulations are multiplied, their PSFs convolved.
struct PsfParts {
  std::unique_ptr<const Psf> diffracted;           ///< of an aperture, with wings; null: none
  std::vector<std::unique_ptr<const Psf>> images;  ///< kernels, known as energies alone
  std::vector<double> sigmas_px;                   ///< of Gaussians
  std::vector<CarrierDiffusion> diffusion;

  PsfParts();
  PsfParts(PsfParts&&) noexcept;
  ~PsfParts();
};

/// The PSF of all parts, at least one of them. Where one is diffracted it is cut as far out as that and the others reach, in quadrature,
/// and what lies beyond are wings; else where no more than `left_out` of its energy lies beyond.
std::unique_ptr<Psf> make_product_psf(PsfParts parts, double left_out);

/// What elements pass to their neighbours, as shares of what falls on them: to each of those beside, above and below, and at the corners.
struct Crosstalk {
  double beside = 0.0, above = 0.0, corner = 0.0;
  /// Along x, at cycles a pixel.
  double mtf(double cycles_px) const;
};

/// A null PSF is perfect optics.
std::unique_ptr<Psf> with_crosstalk(std::unique_ptr<const Psf> psf, const Crosstalk& crosstalk);

}  // namespace ifov::sensor
