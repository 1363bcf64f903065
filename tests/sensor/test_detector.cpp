#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "radiometry/channel.h"
#include "sensor/detector/detector.h"
#include "sensor/detector/element_light.h"
#include "sensor/detector/rule_07.h"

namespace ifov::sensor::test_detector {
namespace {

using radiometry::Channel;
using radiometry::Spectrum;

ElementOptics optics() { return {2.0, 0.4, 400e-12, 0.01}; }

TEST(ElementLight, OfATopHatIsItsIntegral) {
  const Channel channel = Channel::top_hat("a", 0.5, 0.7);
  const double found =
      electrons_per_radiance(optics(), channel, Spectrum::constant(0.8), Spectrum::constant(0.6));
  // Photons of a joule are wavelength / (h c), whose integral is that of the wavelength: (0.49 - 0.25) / 2 um2.
  const double photons = 1e-6 * 0.12 / (6.62607015e-34 * 299792458.0);
  const double solid_angle = std::numbers::pi * (1.0 - 0.16) / 16.0;
  EXPECT_NEAR(found / (0.8 * 0.6 * photons * 400e-12 * solid_angle * 0.01), 1.0, 1e-12);
}

TEST(ElementLight, FollowsSpectraWithinTheChannel) {
  const Channel channel = Channel::top_hat("a", 1.0, 2.0);
  const Spectrum half({1.0, 1.5, 1.5000001, 2.0}, {1.0, 1.0, 0.0, 0.0});
  const auto of = [&](const Spectrum& a, const Spectrum& b) {
    return electrons_per_radiance(optics(), channel, a, b);
  };
  const double all = of(Spectrum::constant(1.0), Spectrum::constant(1.0));
  EXPECT_NEAR(of(half, Spectrum::constant(1.0)) / all, (1.5 * 1.5 - 1.0) / 3.0, 1e-6);
  EXPECT_NEAR(of(Spectrum::constant(1.0), half) / all, (1.5 * 1.5 - 1.0) / 3.0, 1e-6);
}

/// The scale of a response is no matter; a single wavelength has no width.
TEST(ElementLight, TakesTheResponseForAFilter) {
  const Spectrum one = Spectrum::constant(1.0);
  const Channel low = Channel::tabulated("a", Spectrum({1.0, 2.0, 3.0}, {0.0, 0.1, 0.0}));
  const Channel high = Channel::tabulated("a", Spectrum({1.0, 2.0, 3.0}, {0.0, 7.0, 0.0}));
  EXPECT_NEAR(
      electrons_per_radiance(optics(), low, one, one) / electrons_per_radiance(optics(), high, one, one), 1.0,
      1e-12);
  EXPECT_EQ(electrons_per_radiance(optics(), Channel::monochromatic("a", 2.0), one, one), 0.0);
}

/// All photons of a blackbody: the integral of B / (h c / wavelength) over all wavelengths is 2 zeta(3) k^3 T^3 / (h^3 c^2), times 2 pi / pi.
TEST(ElementLight, OfWarmOpticsIsThatOfABlackbody) {
  const double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23, zeta_3 = 1.2020569031595942;
  const double kt = k * 300.0;
  const double photons = 4.0 * zeta_3 * kt * kt * kt / (h * h * h * c * c);
  const Channel channel = Channel::top_hat("all", 0.8, 3000.0);
  const double found =
      background_electrons(optics(), channel, Spectrum::constant(0.5), Spectrum::constant(1.0), 300.0);
  EXPECT_NEAR(found / (0.5 * photons * optics().throughput_m2_sr() * 0.01), 1.0, 1e-3);
}

TEST(Rule07, IsThePublishedRule) {
  // Worked out beside the program, by the equations of the paper and the constants of the SI.
  EXPECT_NEAR(rule_07_a_m2(10.0, 77.0) / 3.080308217613163e-2, 1.0, 1e-9);
  EXPECT_NEAR(rule_07_a_m2(2.5, 150.0) / 5.94343118708613e-9, 1.0, 1e-9);
}

TEST(Rule07, HasNoStepWhereItsFormChanges) {
  EXPECT_NEAR(rule_07_a_m2(4.6351364231, 120.0) / rule_07_a_m2(4.6351364232, 120.0), 1.0, 1e-3);
}

Detector camera() {
  Detector detector;
  detector.electrons_per_radiance = 500.0;
  detector.background = 1000.0;
  detector.dark = 200.0;
  detector.read_noise = 20.0;
  detector.full_well = 1e5;
  detector.bits = 12;
  detector.offset = 100.0;
  detector.gain = 25.0;
  return detector;
}

TEST(Detector, NoiseIsOfItsParts) {
  const Detector detector = camera();
  EXPECT_DOUBLE_EQ(detector.mean_electrons(10.0), 6200.0);
  EXPECT_DOUBLE_EQ(detector.variance(10.0), 6200.0 + 400.0 + 625.0 / 12.0);
  EXPECT_DOUBLE_EQ(detector.noise_w_m2_sr_um(10.0), std::sqrt(6600.0 + 625.0 / 12.0) / 500.0);
  EXPECT_DOUBLE_EQ(detector.radiance_w_m2_sr_um(6200.0), 10.0);
}

TEST(Detector, CountsAreRoundedAndBounded) {
  const Detector detector = camera();
  EXPECT_EQ(detector.count(0.0), 100.0);
  EXPECT_EQ(detector.count(12.4), 100.0);
  EXPECT_EQ(detector.count(12.6), 101.0);
  EXPECT_EQ(detector.count(-1e9), 0.0);
  EXPECT_EQ(detector.count(1e9), 4095.0);
  EXPECT_EQ(detector.count(NAN), 0.0);
  EXPECT_EQ(detector.signal_of_count(101.0), 25.0);
  EXPECT_EQ(detector.largest_signal(), 3995.0 * 25.0);
}

/// A record that leaves one out would draw another noise than the document.
TEST(Detector, AllFiguresHaveAName) {
  std::set<std::string> names;
  Detector all;
  for (const DetectorFigure& figure : detector_figures()) names.insert(figure.name), all.*figure.value = 7.0;
  EXPECT_EQ(names.size(), detector_figures().size());
  // Beside them the rows of vignetting, which records hold as a list.
  EXPECT_EQ(sizeof(Detector), names.size() * sizeof(double) + sizeof(all.vignette_rows));
  for (const DetectorFigure& figure : detector_figures()) EXPECT_EQ(all.*figure.value, 7.0);
}

}  // namespace
}  // namespace ifov::sensor::test_detector
