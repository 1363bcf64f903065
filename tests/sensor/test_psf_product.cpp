#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "sampling/pixel_footprint.h"
#include "sensor/airy_aperture.h"
#include "sensor/optics/carrier_diffusion.h"
#include "sensor/optics/psf_product.h"
#include "sensor/psf.h"

namespace ifov::sensor::test_psf_product {
namespace {

using std::numbers::pi;

/// Modulation of a PSF within its cut along x, at a frequency in cycles per pixel.
double mtf(const Psf& psf, double frequency) {
  const double w = psf.half_width_px() + 1e-9;
  constexpr int kStrips = 8000;
  double sum = 0.0;
  for (int k = 0; k < kStrips; ++k) {
    const double x0 = -w + 2 * w * k / kStrips, x1 = -w + 2 * w * (k + 1) / kStrips;
    sum += psf.energy(x0, -w, x1, w) * std::cos(pi * frequency * (x0 + x1));
  }
  return sum;
}

double bell(double sigma, double f) { return std::exp(-2.0 * std::pow(pi * sigma * f, 2)); }

double open_aperture(double q, double f) {
  const double s = f * q;
  return s >= 1.0 ? 0.0 : 2.0 / pi * (std::acos(s) - s * std::sqrt(1.0 - s * s));
}

CarrierDiffusion from_behind(double layer_px) { return {layer_px, {}, 0.0, 0.0}; }
CarrierDiffusion from_the_front() { return {0.0, 2.0, 0.5, 0.8}; }

std::unique_ptr<Psf> airy(double q, double kept = 0.95) {
  return make_airy_psf({0.5, 1.0, 1.0, 0.5e-6 / q, 0.0}, kept);
}

PsfParts parts(std::vector<double> sigmas, std::vector<CarrierDiffusion> diffusion = {}) {
  PsfParts made;
  made.sigmas_px = std::move(sigmas);
  made.diffusion = std::move(diffusion);
  return made;
}

TEST(CarrierDiffusion, SolvesTheDiffusionEquationOfItsLayer) {
  // n'' = (1 / L^2 + (2 pi f)^2) n with n' = 0 at the back and n = 0 at the depletion, by steps: what arrives over what starts.
  for (const double length : {0.7, 3.0})
    for (const double f : {0.0, 0.1, 0.5}) {
      const double t = 1.3;
      const auto left = [&](double cycles) {
        // From the back: n = cosh(z / l), of which the flux at the front per flux that was put in at the back is 1 / cosh(t / l).
        const double k2 = 1.0 / (length * length) + std::pow(2 * pi * cycles, 2);
        constexpr int kSteps = 20000;
        const double h = t / kSteps;
        double n = 0.0, slope = 1.0;  // from the depletion backwards: n = 0, flux 1
        for (int k = 0; k < kSteps; ++k) {
          const double half = n + 0.5 * h * slope, half_slope = slope + 0.5 * h * k2 * n;
          n += h * half_slope, slope += h * k2 * half;
        }
        return 1.0 / slope;
      };
      const CarrierDiffusion layer{t, length, 0.0, 0.0};
      EXPECT_NEAR(layer.mtf(f), left(f) / left(0.0), 1e-6) << length << ' ' << f;
    }
  EXPECT_NEAR(from_behind(0.4).mtf(0.5), 1.0 / std::cosh(0.4 * pi), 1e-12);
}

TEST(CarrierDiffusion, OfLightFromTheFrontIsTheMeanOverDepths) {
  const CarrierDiffusion front = from_the_front();
  const auto collected = [&](double f) {
    const double l = 1.0 / std::sqrt(1.0 / (*front.length_px * *front.length_px) + std::pow(2 * pi * f, 2));
    double sum = 0.0;
    constexpr int kSteps = 200000;
    const double deepest = 40.0, h = deepest / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double z = (k + 0.5) * h, past = z - front.depletion_px;
      sum += h * front.absorption_per_px * std::exp(-front.absorption_per_px * z) *
             (past > 0.0 ? std::exp(-past / l) : 1.0);
    }
    return sum;
  };
  for (const double f : {0.05, 0.2, 0.5}) EXPECT_NEAR(front.mtf(f), collected(f) / collected(0.0), 1e-5) << f;
}

TEST(CarrierDiffusion, VarianceIsTheCurvatureOfItsModulation) {
  for (const CarrierDiffusion& one :
       {from_behind(0.5), CarrierDiffusion{0.9, 0.8, 0.0, 0.0}, from_the_front()}) {
    constexpr double kSmall = 1e-3;
    EXPECT_NEAR((1.0 - one.mtf(kSmall)) / (2.0 * pi * pi * kSmall * kSmall), one.variance_px2(),
                2e-3 * one.variance_px2());
  }
}

TEST(PsfProduct, ModulationsOfItsPartsAreMultiplied) {
  struct Case {
    PsfParts parts;
    std::vector<double> sigmas;
    std::vector<CarrierDiffusion> diffusion;
    double within;
  };
  std::vector<Case> cases;
  cases.push_back({parts({0.4}, {from_behind(0.3)}), {0.4}, {from_behind(0.3)}, 5e-4});
  cases.push_back({parts({}, {from_behind(0.5)}), {}, {from_behind(0.5)}, 5e-4});
  cases.push_back({parts({}, {from_the_front()}), {}, {from_the_front()}, 2e-3});
  cases.push_back({parts({0.2, 0.5}, {from_behind(0.2), from_the_front()}),
                   {0.2, 0.5},
                   {from_behind(0.2), from_the_front()},
                   1e-3});
  for (Case& one : cases) {
    const auto psf = make_product_psf(std::move(one.parts), 2.2e-5);
    EXPECT_GE(psf->kept(), 1.0 - 2.3e-5);
    for (const double f : {0.05, 0.2, 0.35, 0.5}) {
      double expected = 1.0;
      for (const double sigma : one.sigmas) expected *= bell(sigma, f);
      for (const CarrierDiffusion& diffusion : one.diffusion) expected *= diffusion.mtf(f);
      EXPECT_NEAR(mtf(*psf, f), expected, one.within) << psf->description() << f;
    }
  }
}

/// The whole PSF's, wings and all, over [-far, far]^2.
double whole_mtf(const Psf& psf, double frequency, double far) {
  constexpr double kStep = 1.0 / 32.0;
  const int most = static_cast<int>(far / kStep);
  double sum = psf.kept() * mtf(psf, frequency);
  for (int i = -most; i <= most; ++i) {
    double column = 0.0;
    for (int j = 1; j <= most; ++j) column += 2.0 * psf.cut_density(i * kStep, j * kStep, false);
    sum += kStep * kStep * (column + psf.cut_density(i * kStep, 0.0, false)) *
           std::cos(2 * pi * frequency * i * kStep);
  }
  return sum;
}

TEST(PsfProduct, WingsOfDiffractionAreConvolvedAsWell) {
  for (const auto& [q, sigma] : {std::pair{0.6, 0.4}, std::pair{1.2, 0.3}, std::pair{0.3, 1.0}}) {
    PsfParts all = parts({sigma});
    all.diffracted = airy(q);
    const auto psf = make_product_psf(std::move(all), 2.2e-5);
    EXPECT_TRUE(psf->has_wings());
    EXPECT_TRUE(psf->round());
    EXPECT_GE(psf->half_width_px(), airy(q)->half_width_px() - 0.1);
    for (const double f : {0.1, 0.3, 0.5})
      EXPECT_NEAR(whole_mtf(*psf, f, 24.0), open_aperture(q, f) * bell(sigma, f), 2e-3)
          << q << ' ' << sigma << ' ' << f;
    // As dense beyond its table as within, where rings are blurred.
    const double far = 40.0 * q + 20.0 * sigma;
    EXPECT_NEAR(psf->cut_density(far, 0.0, true), q / (pi * pi * pi * far * far * far),
                0.05 * q / (pi * pi * pi * far * far * far));
  }
}

TEST(PsfProduct, NarrowPartsLeaveDiffractionAsItIs) {
  PsfParts all = parts({0.005});
  all.diffracted = airy(0.8);
  const auto psf = make_product_psf(std::move(all), 2.2e-5);
  const auto alone = airy(0.8);
  EXPECT_NEAR(psf->kept(), alone->kept(), 2e-3);
  for (const double x : {0.0, 0.5, 1.0, 1.7})
    EXPECT_NEAR(psf->kept() * psf->energy(x - 0.2, -0.2, x + 0.2, 0.2),
                alone->kept() * alone->energy(x - 0.2, -0.2, x + 0.2, 0.2), 6e-4)
        << x;
}

TEST(PsfProduct, AKernelAsideMovesTheImage) {
  // Two points, a third of the light 1.5 px to the right of the middle: pixels look the other way.
  std::vector<double> values(11 * 11, 0.0);
  values[5 * 11 + 5] = 2.0, values[5 * 11 + 8] = 1.0;
  PsfParts all = parts({0.3});
  all.images.push_back(make_kernel_psf(11, 11, values, 2.0));
  const auto psf = make_product_psf(std::move(all), 1e-7);
  double mean = 0.0;
  for (int k = -80; k < 80; ++k) mean += (k + 0.5) / 16.0 * psf->energy(k / 16.0, -9.0, (k + 1) / 16.0, 9.0);
  EXPECT_NEAR(mean, -0.5, 1e-3);
  EXPECT_FALSE(psf->mirrored());
}

TEST(Crosstalk, NeighboursGetTheirShares) {
  const auto psf = with_crosstalk(nullptr, {0.02, 0.01, 0.005});
  const auto footprint = make_footprint(psf.get(), 1.0);
  constexpr double kWithin_px = 0.46;  // edges are as sharp as the table is fine
  const auto on = [&](double x, double y) {
    return footprint.integral(x - kWithin_px, y - kWithin_px, x + kWithin_px, y + kWithin_px) /
           (4 * kWithin_px * kWithin_px);
  };
  EXPECT_NEAR(on(0, 0), 0.92, 1e-3);
  EXPECT_NEAR(on(1, 0), 0.02, 1e-4);
  EXPECT_NEAR(on(0, -1), 0.01, 1e-4);
  EXPECT_NEAR(on(-1, 1), 0.005, 1e-4);
  const auto blurred = with_crosstalk(make_gaussian_psf(0.4, 8.0), {0.02, 0.01, 0.005});
  for (const double f : {0.1, 0.5}) {
    const double expected = bell(0.4, f) * (1.0 - (2 * 0.02 + 4 * 0.005) * (1.0 - std::cos(2 * pi * f)));
    EXPECT_NEAR(mtf(*blurred, f), expected, 1e-4);
    EXPECT_NEAR(expected, bell(0.4, f) * Crosstalk({0.02, 0.01, 0.005}).mtf(f), 1e-12);
  }
  EXPECT_THROW(with_crosstalk(nullptr, {0.3, 0.3, 0.0}), InputError);
}

TEST(PsfProduct, OfNothingIsRefused) { EXPECT_THROW(make_product_psf(PsfParts(), 1e-5), InputError); }

}  // namespace
}  // namespace ifov::sensor::test_psf_product
