#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sampling/pixel_footprint.h"
#include "sensor/airy_aperture.h"
#include "sensor/psf.h"

namespace ifov::sensor::test_psf {
namespace {

using std::numbers::pi;

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Modulation of a footprint along x at a frequency in cycles per pixel.
double mtf(const sampling::PixelFootprint& footprint, double frequency) {
  const double w = footprint.half_width_px();
  constexpr int kStrips = 4000;
  double sum = 0.0;
  for (int k = 0; k < kStrips; ++k) {
    const double x0 = -w + 2 * w * k / kStrips, x1 = -w + 2 * w * (k + 1) / kStrips;
    sum += footprint.integral(x0, -w, x1, w) * std::cos(pi * frequency * (x0 + x1));
  }
  return sum;
}

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); }

/// Diffraction-limited modulation of a circular aperture, cut-off frequency 1/q (Goodman, Introduction to
/// Fourier Optics, 6.4).
double diffraction_mtf(double frequency, double q_px) {
  const double s = frequency * q_px;
  return s >= 1.0 ? 0.0 : 2.0 / pi * (std::acos(s) - s * std::sqrt(1.0 - s * s));
}

/// Energy within a circle, from thin strips of the PSF.
double encircled(const Psf& psf, double radius_px) {
  constexpr int kStrips = 2000;
  double sum = 0.0;
  for (int k = 0; k < kStrips; ++k) {
    const double y0 = radius_px * (2.0 * k / kStrips - 1.0), y1 = radius_px * (2.0 * (k + 1) / kStrips - 1.0);
    const double y = 0.5 * (y0 + y1), x = std::sqrt(radius_px * radius_px - y * y);
    sum += psf.energy(-x, y0, x, y1);
  }
  return sum;
}

TEST(Footprint, PerfectOpticsLeaveTheSensitiveSquare) {
  const auto full = make_footprint(nullptr, 1.0), half = make_footprint(nullptr, 0.5);
  EXPECT_TRUE(full.uniform());
  EXPECT_DOUBLE_EQ(full.half_width_px(), 0.5);
  EXPECT_NEAR(half.half_width_px(), 0.5 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(half.density(0.1, 0.1), 2.0, 1e-12);
  EXPECT_THROW(make_footprint(nullptr, 0.0), InputError);
  EXPECT_THROW(make_footprint(nullptr, 16.01), InputError);
  EXPECT_NEAR(make_footprint(nullptr, 2.25).half_width_px(), 0.75, 1e-15) << "elements that overlap";
}

TEST(GaussianPsf, FootprintIsADifferenceOfErrorFunctions) {
  for (const double sigma : {0.2, 0.6, 1.5}) {
    const double cut = 6.0;  // far out: the closed form is of the uncut Gaussian
    const auto psf = make_gaussian_psf(sigma, cut);
    const auto footprint = make_footprint(psf.get(), 1.0);
    const auto axis = [&](double x) { return normal_cdf((x + 0.5) / sigma) - normal_cdf((x - 0.5) / sigma); };
    for (const double x : {0.0, 0.31, 0.77, 1.6})
      for (const double y : {0.0, -0.45, 1.1})
        EXPECT_NEAR(footprint.density(x, y), axis(x) * axis(y), 2e-3) << sigma << ' ' << x << ' ' << y;
    EXPECT_NEAR(footprint.integral(-9, -9, 9, 9), 1.0, 1e-7);
  }
}

TEST(GaussianPsf, PixelGetsTheKnownShareOfAPointAtItsCentre) {
  // The share of a point source that a full pixel takes: erf(1 / (2 sqrt 2 sigma))^2.
  const auto psf = make_gaussian_psf(0.6, 8.0);
  EXPECT_NEAR(psf->energy(-0.5, -0.5, 0.5, 0.5), std::pow(std::erf(0.5 / (std::numbers::sqrt2 * 0.6)), 2),
              1e-12);
}

TEST(GaussianPsf, CutKeepsTheEnergyThatItStates) {
  const auto psf = make_gaussian_psf(0.6);
  EXPECT_DOUBLE_EQ(psf->half_width_px(), 2.64);
  EXPECT_DOUBLE_EQ(psf->energy(-3.0, -3.0, 3.0, 3.0), 1.0);
  EXPECT_EQ(psf->energy(3.0, -5.0, 5.0, 5.0), 0.0);
  EXPECT_NEAR(psf->kept(), 1.0 - 2.1650e-5, 1e-9);  // erf(4.4 / sqrt 2)^2
  EXPECT_EQ(psf->description(),
            "Gaussian of sigma 0.6 px, cut at 2.64 px, which leaves out 0.0022 % of the energy");
}

TEST(GaussianPsf, ModulationIsGaussianTimesSinc) {
  const double sigma = 0.6;
  for (const double fill : {1.0, 0.6}) {
    const auto psf = make_gaussian_psf(sigma, 6.0);
    const auto footprint = make_footprint(psf.get(), fill);
    for (const double f : {0.1, 0.25, 0.5})
      EXPECT_NEAR(mtf(footprint, f),
                  std::exp(-2 * pi * pi * sigma * sigma * f * f) * sinc(f * std::sqrt(fill)), 2e-3)
          << f;
  }
}

constexpr AiryAperture kAperture{10.0, 0.02, 0.04, 20e-6};  // q = 10e-6 * 0.04 / (0.02 * 20e-6) = 1 px

TEST(AiryPsf, FirstDarkRingEncircles83_8Percent) {
  // Energies of the uncut pattern within the first three dark rings (Born & Wolf, table 8.2), times 1 / 0.99.
  const auto psf = make_airy_psf(kAperture, 0.99);
  EXPECT_NEAR(0.99 * encircled(*psf, 1.2197), 0.838, 5e-4);
  EXPECT_NEAR(0.99 * encircled(*psf, 2.2331), 0.910, 5e-4);
  EXPECT_NEAR(0.99 * encircled(*psf, 3.2383), 0.938, 5e-4);
}

TEST(AiryPsf, IsCutWhereItsEnergyIsReached) {
  // J0(2) = 0.2238907791, J1(2) = 0.5767248078 (Abramowitz & Stegun, table 9.1): E = 0.61726142 at r = 2 q /
  // pi.
  const auto psf = make_airy_psf(kAperture, 0.61726142);
  EXPECT_NEAR(psf->half_width_px(), 2.0 / pi, 1e-7);
  EXPECT_NEAR(encircled(*psf, 1.0), 1.0, 1e-9);
  EXPECT_EQ(
      psf->description(),
      "Airy pattern, first dark ring at 1.22 px, traced to 0.6366 px; the 38 % of the energy beyond are wings");
}

TEST(AiryPsf, ScalesWithWavelengthAndFocalRatio) {
  AiryAperture wide = kAperture;
  wide.wavelength_um *= 2.0;
  wide.pitch_m *= 0.5;
  EXPECT_NEAR(make_airy_psf(wide)->half_width_px(), 4.0 * make_airy_psf(kAperture)->half_width_px(), 1e-9);
}

TEST(AiryPsf, ModulationIsThatOfACircularAperture) {
  // Cutting the far wings lifts the curve near zero frequency by the share left out; 0.995 leaves 0.5 %.
  const auto psf = make_airy_psf(kAperture, 0.995);
  const auto footprint = make_footprint(psf.get(), 1.0);
  for (const double f : {0.1, 0.2, 0.4, 0.6})
    EXPECT_NEAR(mtf(footprint, f), diffraction_mtf(f, 1.0) * sinc(f), 0.008) << f;
  EXPECT_NEAR(mtf(footprint, 1.3), 0.0, 0.01);
}

/// Energy within a radius of the pattern of an annulus: the square of its pupil's Fourier transform, summed over circles (Mahajan, Optical
/// Imaging and Aberrations II, 1998, 2.3), by Simpson's rule.
double encircled_of_annulus(double obscuration, double v) {
  constexpr int kCircles = 400, kOfPupil = 200;
  const auto simpson = [](double from, double to, int n, const auto& f) {
    double sum = f(from) + f(to);
    for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * f(from + (to - from) * k / n);
    return sum * (to - from) / (3.0 * n);
  };
  const double open = 1.0 - obscuration * obscuration;
  return simpson(0.0, v, kCircles, [&](double at) {
    const double amplitude = simpson(obscuration, 1.0, kOfPupil,
                                     [&](double rho) { return std::cyl_bessel_j(0.0, at * rho) * rho; });
    return 2.0 / open * amplitude * amplitude * at;
  });
}

TEST(AiryPsf, EnergyBehindACoveredMiddleIsThatOfTheAnnulus) {
  EXPECT_NEAR(encircled_of_annulus(0.0, 3.8317), 0.838, 5e-4);  // Born & Wolf, table 8.2
  for (const double obscuration : {0.2, 0.5}) {
    AiryAperture aperture = kAperture;
    aperture.obscuration = obscuration;
    const auto psf = make_airy_psf(aperture, 0.9);
    for (const double radius_px : {0.5, 1.0, 1.6})
      EXPECT_NEAR(0.9 * encircled(*psf, radius_px), encircled_of_annulus(obscuration, pi * radius_px), 5e-4)
          << obscuration << " " << radius_px;
  }
}

TEST(KernelPsf, OneSampleIsItsSquare) {
  const auto psf = make_kernel_psf(1, 1, {5.0}, 2.0);  // half a pixel wide
  EXPECT_DOUBLE_EQ(psf->energy(-0.25, -0.25, 0.25, 0.25), 1.0);
  EXPECT_DOUBLE_EQ(psf->energy(0.0, -0.25, 0.25, 0.25), 0.5);
  // A square of side 0.5 over a square of side 1: a trapezoid along each axis.
  const auto footprint = make_footprint(psf.get(), 1.0);
  EXPECT_NEAR(footprint.half_width_px(), 0.75, 1e-12);
  EXPECT_NEAR(footprint.density(0.0, 0.0), 1.0, 2e-3);
  EXPECT_NEAR(footprint.density(0.5, 0.0), 0.5, 2e-2);
  EXPECT_NEAR(footprint.density(0.5, 0.5), 0.25, 2e-2);
}

TEST(KernelPsf, KeepsItsShiftAndItsAxes) {
  // Points are seen right of where they are and above: x = +1, y = -1 samples of 1/4 px. So a pixel sees what is left of it and below.
  const auto psf = make_kernel_psf(3, 3, {0, 0, 1, 0, 0, 0, 0, 0, 0}, 4.0);
  EXPECT_DOUBLE_EQ(psf->energy(-0.375, 0.125, -0.125, 0.375), 1.0);
  const auto footprint = make_footprint(psf.get(), 1.0);
  EXPECT_NEAR(footprint.integral(-2, -2, -0.25, 2), 0.5, 1e-3);
  EXPECT_NEAR(footprint.integral(-2, 0.25, 2, 2), 0.5, 1e-3);
}

TEST(KernelPsf, OfASampledGaussianAgreesWithTheGaussian) {
  constexpr int kSide = 65;
  constexpr double kPerPixel = 16.0, kSigma = 0.5;
  std::vector<double> values;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = (i - kSide / 2) / kPerPixel, y = (j - kSide / 2) / kPerPixel;
      values.push_back(std::exp(-(x * x + y * y) / (2 * kSigma * kSigma)));
    }
  const auto kernel = make_kernel_psf(kSide, kSide, values, kPerPixel),
             gaussian = make_gaussian_psf(kSigma, 4.0);
  const auto a = make_footprint(kernel.get(), 0.8), b = make_footprint(gaussian.get(), 0.8);
  for (const double x : {0.0, 0.4, 0.9}) EXPECT_NEAR(a.density(x, 0.2), b.density(x, 0.2), 3e-3);
}

TEST(KernelPsf, RefusesNonsense) {
  EXPECT_THROW(make_kernel_psf(2, 2, {1, 1, 1}, 1.0), InputError);
  EXPECT_THROW(make_kernel_psf(1, 1, {-1}, 1.0), InputError);
  EXPECT_THROW(make_kernel_psf(1, 1, {0}, 1.0), InputError);
  EXPECT_THROW(make_kernel_psf(1, 1, {1}, 0.0), InputError);
  EXPECT_THROW(make_gaussian_psf(-1.0), InputError);
  EXPECT_THROW(make_airy_psf({10.0, 0.0, 0.04, 20e-6}), InputError);
}

}  // namespace
}  // namespace ifov::sensor::test_psf
