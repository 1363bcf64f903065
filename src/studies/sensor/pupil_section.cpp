#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>

#include "core/format.h"
#include "sensor/psf.h"
#include "sensor/pupil.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr double kWaves = 0.12, kPi = std::numbers::pi;

/// An open aperture of one pixel's wavelength times f-number.
sensor::Pupil aberrated(int noll, double waves) {
  sensor::Pupil pupil;
  pupil.aperture = {1.0, 0.1, 1.0, 1e-5, 0.0};
  pupil.wavefront = {{noll, 0.0, waves}};
  return pupil;
}

/// The pupil's integral at a place of the image, by midpoints, in units of the peak of a flat wavefront.
double by_quadrature(const sensor::Pupil& pupil, double x_q, double y_q) {
  constexpr int kAround = 256, kOut = 200;
  std::complex<double> sum;
  for (int k = 0; k < kOut; ++k)
    for (int a = 0; a < kAround; ++a) {
      const double r = std::sqrt((k + 0.5) / kOut), t = 2.0 * kPi * (a + 0.5) / kAround;
      const double x = r * std::cos(t), y = r * std::sin(t);
      sum += std::polar(1.0 / (kOut * kAround),
                        2.0 * kPi * pupil.wavefront_waves(x, y) - kPi * (x * x_q + y * y_q));
    }
  return std::norm(sum);
}

}  // namespace

double pupil_points_off(int noll, double sign) {
  const sensor::Pupil pupil = aberrated(noll, kWaves);
  const auto psf = sensor::make_pupil_psf(aberrated(noll, sign * kWaves));
  constexpr double kHalf = 1.0 / 32.0;  // of a sample of the PSF
  constexpr int kPoints = 12;
  double most = 0.0;
  for (int k = -1; k < kPoints; ++k) {
    const double angle = 2.0 * kPi * k / kPoints, out = k < 0 ? 0.0 : 14.4;
    const double x = std::round(out * std::cos(angle)) / 16.0, y = std::round(out * std::sin(angle)) / 16.0;
    const double density =
        psf->energy(x - kHalf, y - kHalf, x + kHalf, y + kHalf) / (4.0 * kHalf * kHalf) * psf->kept();
    most = std::max(most, std::abs(density / (0.25 * kPi) - by_quadrature(pupil, -x, -y)));
  }
  return most / by_quadrature(pupil, 0.0, 0.0);
}

ReportSection pupil_section(const SectionOptions&) {
  ReportSection section;
  section.title = "Wavefronts";
  section.text =
      "The PSF of an open aperture with 0.12 waves (RMS) of one of Zernike's polynomials, by Noll's numbers: its middle and a circle of twelve points 0.9 "
      "lambda N about it, against the pupil's integral by 51,200 midpoints.";
  for (int noll = 4; noll <= 11; ++noll)
    section.figures.at_most(format("zernike_{}", noll), pupil_points_off(noll, 1.0), 0.01, "",
                            format("Noll's number {}: largest difference over the peak", noll));
  return section;
}

}  // namespace ifov::studies
