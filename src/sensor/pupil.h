#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sensor/airy_aperture.h"

namespace ifov::sensor {

class Psf;

/// An aperture with what stands in it and the wavefront behind it. Directions are those of the image: x right, y down; a wavefront
/// that rises to the right (Noll's number 2) moves the image to the right.
struct Pupil {
  AiryAperture aperture;
  int spiders = 0;                ///< vanes from the middle to the rim, evenly around
  double spider_width = 0.0;      ///< over the aperture's diameter
  double spider_angle_rad = 0.0;  ///< of the first, from x to y
  double defocus_m = 0.0;         ///< of the detector from the focus, along the axis
  struct Coefficient {
    int noll = 0;
    double rms_m = 0.0,
           rms_waves = 0.0;  ///< over the whole disc, as a length and in wavelengths: their sum counts
  };
  std::vector<Coefficient> wavefront;

  double q_px() const;  ///< wavelength times f-number, in pixels
  /// Whether light passes at this place of the unit disc.
  bool passes(double x, double y) const;
  bool is_flat() const { return wavefront.empty() && defocus_m == 0.0; }
  /// In wavelengths.
  double wavefront_waves(double x, double y) const;
};

/// Noll's numbers that wavefronts may have.
inline constexpr int kFirstNoll = 2, kLastNoll = 66;

/// ifov::InputError where figures are out of range, or the wavefront is steeper than what is computed holds.
void check_pupil(const Pupil& pupil);

/// Intensity in the middle over that without a wavefront.
double strehl_ratio(const Pupil& pupil);

/// Modulation transfer function along x at a frequency in cycles a pixel: the pupil's own overlap, shifted (Hopkins 1955).
double pupil_mtf(const Pupil& pupil, double cycles_px);

/// Diffraction with a wavefront, from the pupil by Fourier transform, as a pixel responds: a point's image turned by 180 deg. Cut at the radius that encircles the given share of the energy, what
/// lies beyond is PsfWings'.
std::unique_ptr<Psf> make_pupil_psf(const Pupil& pupil, double encircled_energy = 0.95);

/// Amplitudes in cells of the pupil, row by row: shares of cells that are open with their phases.
struct PupilCells {
  std::size_t across = 0;
  std::vector<std::complex<double>> amplitude;
  double open = 0.0;  ///< area, in cells
};
/// Cells of a side in radii of the pupil, about its middle. `means`: over a cell that is open the wavefront may turn the phase, and its
/// amplitude is the mean; else that of its middle.
PupilCells pupil_cells(const Pupil& pupil, std::size_t across, double side, bool means);

}  // namespace ifov::sensor
