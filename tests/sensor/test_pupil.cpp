#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "sensor/mtf.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"
#include "sensor/pupil.h"
#include "sensor/zernike.h"

namespace ifov::sensor::test_pupil {
namespace {

using std::numbers::pi;

/// Wavelength times f-number is q pixels; f-number 10, wavelength 1 um.
Pupil open_pupil(double q_px, double obscuration = 0.0) {
  Pupil pupil;
  pupil.aperture = {1.0, 0.1, 1.0, 1e-5 / q_px, obscuration};
  return pupil;
}

Pupil with_waves(int noll, double rms_waves, double q_px = 1.0) {
  Pupil pupil = open_pupil(q_px);
  pupil.wavefront = {{noll, 0.0, rms_waves}};
  return pupil;
}

/// Noll (1976), table I.
TEST(Zernike, HasNollsNumbers) {
  const int n[] = {0, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5, 5, 6},
            m[] = {0, 1, 1, 0, 2, 2, 1, 1, 3, 3, 0, 2, 2, 4, 4, 1, 1, 3, 3, 5, 5, 0};
  for (int j = 1; j <= 22; ++j) {
    EXPECT_EQ(noll_order(j).n, n[j - 1]) << j;
    EXPECT_EQ(noll_order(j).m, m[j - 1]) << j;
    EXPECT_EQ(noll_order(j).sine, m[j - 1] > 0 && j % 2 == 1) << j;
  }
}

/// The same table's polynomials.
TEST(Zernike, AreThoseOfNollsTable) {
  for (const auto& [r, t] : {std::pair{0.3, 0.4}, {0.9, 2.5}, {1.0, -1.1}}) {
    const double x = r * std::cos(t), y = r * std::sin(t), r2 = r * r;
    const double expected[] = {1.0,
                               2.0 * r * std::cos(t),
                               2.0 * r * std::sin(t),
                               std::sqrt(3.0) * (2.0 * r2 - 1.0),
                               std::sqrt(6.0) * r2 * std::sin(2.0 * t),
                               std::sqrt(6.0) * r2 * std::cos(2.0 * t),
                               std::sqrt(8.0) * (3.0 * r2 * r - 2.0 * r) * std::sin(t),
                               std::sqrt(8.0) * (3.0 * r2 * r - 2.0 * r) * std::cos(t),
                               std::sqrt(8.0) * r2 * r * std::sin(3.0 * t),
                               std::sqrt(8.0) * r2 * r * std::cos(3.0 * t),
                               std::sqrt(5.0) * (6.0 * r2 * r2 - 6.0 * r2 + 1.0)};
    for (int j = 1; j <= 11; ++j) EXPECT_NEAR(zernike(j, x, y), expected[j - 1], 1e-13) << j;
  }
}

/// By a rule that is exact for them: midpoints around, Gauss's of 12 points over r^2, by Newton's method on Legendre's polynomial.
TEST(Zernike, AreOrthonormalOverTheDisc) {
  constexpr int kPoints = 12, kAround = 48;
  std::vector<std::pair<double, double>> gauss;  // in [0, 1], and weights that add up to 1
  for (int k = 0; k < kPoints; ++k) {
    double z = std::cos(pi * (k + 0.75) / (kPoints + 0.5)), slope = 0.0;
    for (int step = 0; step < 50; ++step) {
      double before = 0.0, here = 1.0;
      for (int l = 0; l < kPoints; ++l)
        before = std::exchange(here, ((2.0 * l + 1.0) * z * here - l * before) / (l + 1.0));
      slope = kPoints * (z * here - before) / (z * z - 1.0);
      z -= here / slope;
    }
    gauss.emplace_back(0.5 * (1.0 + z), 1.0 / ((1.0 - z * z) * slope * slope));
  }
  for (int i = 1; i <= kLastNoll; ++i)
    for (int j = 1; j <= i; ++j) {
      double sum = 0.0;
      for (const auto& [r2, weight] : gauss)
        for (int a = 0; a < kAround; ++a) {
          const double x = std::sqrt(r2) * std::cos(2.0 * pi * a / kAround),
                       y = std::sqrt(r2) * std::sin(2.0 * pi * a / kAround);
          sum += weight / kAround * zernike(i, x, y) * zernike(j, x, y);
        }
      EXPECT_NEAR(sum, i == j ? 1.0 : 0.0, 1e-10) << i << ' ' << j;
    }
}

double most_apart_from_airy(const Pupil& pupil, const AiryAperture& aperture) {
  const auto found = make_pupil_psf(pupil), airy = make_airy_psf(aperture);
  double most = 0.0;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.7, 0.0}, {0.0, -1.3}, {1.6, 1.1}, {-2.0, 1.0}})
    most = std::max(most, std::abs(found->energy(x - 0.25, y - 0.25, x + 0.25, y + 0.25) -
                                   airy->energy(x - 0.25, y - 0.25, x + 0.25, y + 0.25)));
  return most;
}

/// Without a wavefront it is Airy's, which is worked out from Bessel functions.
TEST(PupilPsf, OfAFlatWavefrontIsAirys) {
  for (const double e : {0.0, 0.35}) {
    const Pupil pupil = open_pupil(1.0, e);
    EXPECT_LT(most_apart_from_airy(pupil, pupil.aperture), 3e-4) << e;
    AiryAperture other = pupil.aperture;
    other.diameter_m *= 1.02;
    EXPECT_GT(most_apart_from_airy(pupil, other), 3e-3) << "two per cent more of an aperture are seen";
    const auto found = make_pupil_psf(pupil), airy = make_airy_psf(pupil.aperture);
    EXPECT_NEAR(found->half_width_px() / airy->half_width_px(), 1.0, 0.03) << e;
    EXPECT_NEAR(found->kept(), 0.95, 2e-3);
  }
}

/// Wings: their mean over rings as the aperture's, within and beyond what is sampled.
TEST(PupilPsf, HasTheWingsOfItsAperture) {
  for (const double e : {0.0, 0.35}) {
    const Pupil pupil = open_pupil(1.0, e);
    const auto found = make_pupil_psf(pupil), airy = make_airy_psf(pupil.aperture);
    for (const double r : {8.0, 15.0, 23.0, 40.0, 120.0}) {
      double own = 0.0, theirs = 0.0;  // over a few rings, by which Airy's formula oscillates
      for (int k = 0; k < 64; ++k) {
        own += found->cut_density(r + k / 16.0, 0.0, true);
        theirs += airy->cut_density(r + k / 16.0, 0.0, true);
      }
      EXPECT_NEAR(own / theirs, 1.0, 0.1) << r << ' ' << e;
    }
    const double own = found->cut_density(9.31, 3.2, false), theirs = airy->cut_density(9.31, 3.2, false);
    EXPECT_NEAR(own, theirs, 0.2 * airy->cut_density(9.31, 3.2, true)) << e;
  }
}

/// In the middle, of a path W at the rim: (sin(pi W) / pi W)^2 (Born and Wolf 8.8.2), whichever way the defocus is told.
TEST(PupilPsf, DefocusTakesFromTheMiddleWhatItMust) {
  for (const double rim_waves : {0.1, 0.25, 0.5, 0.8, 1.3}) {
    const double expected = std::pow(std::sin(pi * rim_waves) / (pi * rim_waves), 2);
    EXPECT_NEAR(strehl_ratio(with_waves(4, rim_waves / (2.0 * std::sqrt(3.0)))), expected, 5e-4) << rim_waves;
    Pupil moved = open_pupil(1.0);
    moved.defocus_m = rim_waves * 8.0 * 100.0 * 1e-6;  // f-number 10
    EXPECT_NEAR(strehl_ratio(moved), expected, 5e-4) << rim_waves;
  }
}

/// exp(-(2 pi sigma)^2) of small wavefronts (Marechal; Mahajan 1982).
TEST(PupilPsf, SmallWavefrontsCostWhatMarechalSays) {
  for (int noll = 4; noll <= 22; ++noll) {
    const double sigma = 0.04, expected = std::exp(-std::pow(2.0 * pi * sigma, 2));
    EXPECT_NEAR(strehl_ratio(with_waves(noll, sigma)), expected, 1.5e-3) << noll;
    EXPECT_LT(strehl_ratio(with_waves(noll, 1.1 * sigma)), expected - 5e-3) << noll;
  }
}

/// A path as a length counts by the wavelength.
TEST(PupilPsf, LengthsAreMoreWavesWhereTheWavelengthIsShort) {
  Pupil pupil = open_pupil(1.0);
  pupil.wavefront = {{6, 100e-9, 0.0}};
  EXPECT_NEAR(pupil.wavefront_waves(1.0, 0.0), 0.1 * std::sqrt(6.0), 1e-12);
  pupil.aperture.wavelength_um = 0.5;
  EXPECT_NEAR(pupil.wavefront_waves(1.0, 0.0), 0.2 * std::sqrt(6.0), 1e-12);
}

/// Hopkins (1955), The frequency response of a defocused optical system, Proceedings of the Royal Society A 231: a series of Bessel
/// functions, at s of the cutoff and with a path of W wavelengths at the rim.
double hopkins(double s, double w) {
  const double t = 2.0 * s, a = 4.0 * pi * w * t, beta = std::acos(0.5 * t);
  const auto j = [a](int k) { return std::cyl_bessel_j(static_cast<double>(k), a); };
  double even = beta * j(1), odd = 0.0;
  for (int k = 1; k <= 30; ++k)
    even += (k % 2 == 1 ? 1.0 : -1.0) * std::sin(2.0 * k * beta) / (2.0 * k) * (j(2 * k - 1) - j(2 * k + 1));
  for (int k = 0; k <= 30; ++k)
    odd += (k % 2 == 0 ? 1.0 : -1.0) * std::sin((2.0 * k + 1.0) * beta) / (2.0 * k + 1.0) *
           (j(2 * k) - j(2 * k + 2));
  return 4.0 / (pi * a) * (std::cos(0.5 * a * t) * even - std::sin(0.5 * a * t) * odd);
}

TEST(PupilMtf, OfDefocusIsHopkinss) {
  for (const double w : {0.15, 0.4, 0.8})
    for (const double s : {0.1, 0.25, 0.5, 0.75}) {
      const double found = pupil_mtf(with_waves(4, w / (2.0 * std::sqrt(3.0))), s);
      EXPECT_NEAR(found, std::abs(hopkins(s, w)), 2e-3) << w << ' ' << s;
    }
  EXPECT_GT(
      std::abs(pupil_mtf(with_waves(4, 0.8 / (2.0 * std::sqrt(3.0))), 0.25) - std::abs(hopkins(0.25, 0.75))),
      5e-3);
}

TEST(PupilMtf, OfAFlatWavefrontIsTheApertures) {
  for (const double e : {0.0, 0.35})
    for (const double cycles : {0.0, 0.1, 0.5, 0.9, 1.2})
      EXPECT_NEAR(pupil_mtf(open_pupil(1.0, e), cycles), cycles < 1.0 ? diffraction_mtf(1.0, e, cycles) : 0.0,
                  1.5e-3)
          << e << ' ' << cycles;
}

/// Density at a place of the image, in units of the peak of a flat wavefront: the pupil's integral, by midpoints.
double by_quadrature(const Pupil& pupil, double x_q, double y_q) {
  constexpr int kAround = 256, kOut = 200;
  std::complex<double> sum;
  for (int k = 0; k < kOut; ++k)
    for (int a = 0; a < kAround; ++a) {
      const double r = std::sqrt((k + 0.5) / kOut), t = 2.0 * pi * (a + 0.5) / kAround, x = r * std::cos(t),
                   y = r * std::sin(t);
      sum += std::polar(1.0 / (kOut * kAround),
                        2.0 * pi * pupil.wavefront_waves(x, y) - pi * (x * x_q + y * y_q));
    }
  return std::norm(sum);
}

/// A circle of points and the middle, through Noll's 4 to 11, within 1 % of the peak; `sign`: a planted fault.
double most_off_the_pupils_integral(int noll, double sign) {
  const Pupil pupil = with_waves(noll, 0.12);
  const auto psf = make_pupil_psf(with_waves(noll, sign * 0.12));
  constexpr double kHalf = 1.0 / 32.0;  // of a cell
  double most = 0.0;
  for (int k = -1; k < 12; ++k) {
    const double x = k < 0 ? 0.0 : std::round(16.0 * 0.9 * std::cos(2.0 * pi * k / 12)) / 16.0,
                 y = k < 0 ? 0.0 : std::round(16.0 * 0.9 * std::sin(2.0 * pi * k / 12)) / 16.0;
    const double density = psf->energy(x - kHalf, y - kHalf, x + kHalf, y + kHalf) * 256.0 * psf->kept();
    most = std::max(most, std::abs(density / (0.25 * pi) - by_quadrature(pupil, -x, -y)));
  }
  return most / by_quadrature(pupil, 0.0, 0.0);
}

TEST(PupilPsf, IsThePupilsIntegral) {
  for (int noll = 4; noll <= 11; ++noll) EXPECT_LT(most_off_the_pupils_integral(noll, 1.0), 0.01) << noll;
  for (const int noll : {7, 8, 9, 10})
    EXPECT_GT(most_off_the_pupils_integral(noll, -1.0), 0.05) << "turned around";
}

/// The image goes where the wavefront leans, by 4 q for each wave of Noll's 2 or 3; a pixel responds to what lies on the other side.
TEST(PupilPsf, TiltsMoveTheImage) {
  const auto right = make_pupil_psf(with_waves(2, 0.5)), down = make_pupil_psf(with_waves(3, 0.5));
  EXPECT_GT(right->energy(-2.5, -0.5, -1.5, 0.5), 0.4);
  EXPECT_NEAR(right->energy(-2.5, -0.5, -1.5, 0.5), right->energy(-2.5, -0.5, -2.0, 0.5) * 2.0, 0.01);
  EXPECT_GT(down->energy(-0.5, -2.5, 0.5, -1.5), 0.4);
}

/// Vanes spread light across themselves: a vertical pair along x.
TEST(PupilPsf, VanesSpreadLightAcrossThemselves) {
  Pupil pupil = open_pupil(1.0, 0.2);
  pupil.spiders = 2, pupil.spider_width = 0.04, pupil.spider_angle_rad = 0.5 * pi;
  const auto psf = make_pupil_psf(pupil);
  double along = 0.0, across = 0.0;
  for (int k = 0; k < 128; ++k) {
    across += psf->cut_density(9.0 + k / 16.0, 0.0, false);
    along += psf->cut_density(0.0, 9.0 + k / 16.0, false);
  }
  EXPECT_GT(across, 2.0 * along);
}

/// As far as the image is sampled, what a small hot thing sends a pixel has the vanes' spikes, and stands within what is said of it; rings all around would not.
TEST(PupilPsf, SpikesReachAsFarAsSamples) {
  Pupil pupil = open_pupil(1.0, 0.2);
  pupil.spiders = 2, pupil.spider_width = 0.04, pupil.spider_angle_rad = 0.5 * pi;
  const auto psf = make_pupil_psf(pupil);
  const PsfWings wings(*psf, 1.0);
  int rings_off = 0, places = 0;
  for (const double r : {13.0, 15.4, 17.7, 20.2, 22.0})
    for (const double angle : {0.0, 0.02, 0.25 * pi, 0.5 * pi, pi}) {
      const double x = r * std::cos(angle), y = r * std::sin(angle);
      double direct = 0.0;
      constexpr int kAcross = 48;
      for (int j = 0; j < kAcross; ++j)
        for (int i = 0; i < kAcross; ++i)
          direct += psf->cut_density(x + (i + 0.5) / kAcross - 0.5, y + (j + 0.5) / kAcross - 0.5, false) /
                    (kAcross * kAcross);
      const PsfWings::Density told = wings.density(x, y);
      EXPECT_NEAR(told.per_px2, direct, told.half_width) << r << " " << angle;
      rings_off += std::abs(psf->cut_density(x, y, true) - direct) > 0.5 * direct;
      ++places;
    }
  EXPECT_GT(wings.density(20.0, 0.0).per_px2, 3.0 * wings.density(0.0, 20.0).per_px2);
  EXPECT_GT(2 * rings_off, places) << "the mean all around";
}

/// Energy is neither made nor lost: of squares around, the table's share of all and the wings'.
TEST(PupilPsf, WingsHoldWhatTheCutLeavesOut) {
  const auto psf = make_pupil_psf(with_waves(8, 0.1));
  const double from = psf->half_width_px() + 0.5;
  double rings = 0.0;  // beyond a radius, by the rings' means
  for (double r = from; r < 4000.0; r += 0.01 * r)
    rings += psf->cut_density(1.005 * r, 0.0, true) * 2.0 * pi * 1.005 * r * 0.01 * r;
  EXPECT_NEAR(rings, 1.0 - psf->kept(), 0.15 * (1.0 - psf->kept()));
}

TEST(PupilPsf, RefusesWhatItCannotDo) {
  EXPECT_THROW(make_pupil_psf(with_waves(1, 0.1)), InputError);
  EXPECT_THROW(make_pupil_psf(with_waves(67, 0.1)), InputError);
  EXPECT_THROW(make_pupil_psf(with_waves(4, 40.0)), InputError);
  EXPECT_THROW(make_pupil_psf(with_waves(4, 4.0), 0.995), InputError);
  Pupil wide = open_pupil(1.0);
  wide.spiders = 4, wide.spider_width = 0.6;
  EXPECT_THROW(make_pupil_psf(wide), InputError);
}

}  // namespace
}  // namespace ifov::sensor::test_pupil
