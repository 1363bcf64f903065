#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/bsdf/sea/sea.h"
#include "materials/lobe_checks.h"
#include "radiometry/fresnel.h"
#include "radiometry/refractive_index.h"

namespace ifov::materials::test_sea {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;
using test::kDegree;

constexpr SlopeStatistics kStatistics[] = {SlopeStatistics::isotropic, SlopeStatistics::anisotropic,
                                           SlopeStatistics::skewed};

/// The surface alone: neither whitecaps nor light from below.
Sea bare(double wind, SlopeStatistics statistics, double wind_from_rad = 0.0, double below = 0.0) {
  return {{wind, statistics, wind_from_rad, 34.3, 0.0}, Spectrum::constant(below), Spectrum::constant(0.0)};
}

/// A sea in one wavelength.
class SeaAt {
 public:
  SeaAt(const Sea& sea, double um) : sea_(sea) {
    for (const Spectrum& spectrum : sea.spectra()) values_.push_back(static_cast<float>(spectrum.at(um)));
    for (const float& value : values_) rows_.push_back(&value);
  }
  double brdf(const BsdfEvent& event) const {
    float found = 0.0f;
    sea_.evaluate(event, rows_, 1, &found);
    return static_cast<double>(found);
  }

 private:
  const Sea& sea_;
  std::vector<float> values_;
  std::vector<const float*> rows_;
};

/// The view is at this zenith angle and azimuth clockwise from north, where x is east.
Vec3 from_north(double zenith_deg, double azimuth_deg) {
  return at(zenith_deg * kDegree, (90.0 - azimuth_deg) * kDegree);
}

std::complex<double> index_of_sea(double um) {
  return {sea_water_index(34.3).at(um), radiometry::refractive_index("water").k.at(um)};
}

double fresnel(std::complex<double> index, double cosine) {
  const auto r = radiometry::fresnel_reflection_amplitudes(index, cosine);
  return 0.5 * (std::norm(r.p) + std::norm(r.s));
}

TEST(Sea, SunGlintIsThatOfSixS) {
  // The code 6S, version 1.1, run without air: its reflectance of glint, for the Sun in the north. It has the skewed slopes without
  // shadows; its azimuth of the wind is where the wind goes to.
  struct Case {
    double wind, to_deg, sun_deg, view_deg, azimuth_deg, um, glint;
  };
  constexpr Case kCases[] = {{2, 0, 30, 30, 180, 0.55, 0.62081},   {2, 0, 30, 20, 180, 0.55, 0.27940},
                             {5, 0, 30, 20, 180, 0.85, 0.18633},   {5, 90, 30, 20, 180, 0.85, 0.17783},
                             {5, 180, 30, 20, 180, 0.85, 0.20384}, {5, 60, 30, 40, 150, 0.85, 0.07063},
                             {8, 0, 40, 20, 180, 0.55, 0.09269},   {8, 45, 40, 20, 160, 0.55, 0.07242},
                             {8, 135, 40, 30, 200, 0.55, 0.15416}, {8, 270, 20, 30, 120, 1.6, 0.04805},
                             {14, 0, 45, 10, 180, 0.85, 0.03195},  {14, 30, 30, 45, 180, 2.2, 0.10762},
                             {14, 200, 10, 30, 0, 0.85, 0.02134},  {5, 0, 0, 10, 0, 0.55, 0.15358},
                             {11, 120, 25, 35, 240, 0.65, 0.04048}};
  double turned_off = 0.0;
  for (const Case& c : kCases) {
    const auto glint = [&](double from_deg) {
      const Sea sea = bare(c.wind, SlopeStatistics::skewed, from_deg * kDegree);
      BsdfEvent event = test::view_of(from_north(c.view_deg, c.azimuth_deg));
      event.incoming = from_north(c.sun_deg, 0.0);
      return (1.0 - whitecap_share(c.wind)) * pi * test::brdf_at(sea, event, c.um);
    };
    EXPECT_NEAR(glint(c.to_deg + 180.0), c.glint, 0.01 * c.glint)
        << c.wind << " m/s to " << c.to_deg << " at " << c.view_deg;
    if (c.to_deg == 180.0) turned_off = std::abs(glint(c.to_deg) / c.glint - 1.0);
  }
  EXPECT_GT(turned_off, 0.05);  // the skewness the other way
  EXPECT_NEAR(whitecap_share(5.0) * whitecap_reflectance().at(0.55), 0.00019, 5e-6);
  EXPECT_NEAR(whitecap_share(11.0) * whitecap_reflectance().at(0.65), 0.00301, 5e-6);
}

/// Mean-square slope out of the glint as an image from above shows it, without what shadows hide: density of slopes = 4 cos out cos in cos^4
/// tilt f / F.
double slope_of_glint(const Sea& sea, double um) {
  constexpr int kSteps = 80;
  constexpr double kLast = 0.95;
  double whole = 0.0, square = 0.0;
  BsdfEvent event = test::view_of({0.0, 0.0, 1.0});
  const SeaAt at_um(sea, um);
  const std::complex<double> index = index_of_sea(um);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = kLast * (2.0 * (i + 0.5) / kSteps - 1.0), y = kLast * (2.0 * (j + 0.5) / kSteps - 1.0);
      const Vec3 facet = math::normalized({-x, -y, 1.0});
      event.incoming = 2.0 * facet.z * facet - event.outgoing;
      if (!(event.incoming.z > 0.02)) continue;
      const double density =
          4.0 * event.incoming.z * std::pow(facet.z, 4) * at_um.brdf(event) / fresnel(index, facet.z);
      whole += density;
      square += density * (x * x + y * y);
    }
  return square / whole;
}

TEST(Sea, SlopesOutOfTheGlintAreThoseOfTheWind) {
  for (const double wind : {2.0, 5.0, 10.0, 15.0})
    for (const SlopeStatistics statistics : kStatistics) {
      const double wanted =
          statistics == SlopeStatistics::isotropic ? 0.003 + 0.00512 * wind : 0.003 + 0.00508 * wind;
      const double found = slope_of_glint(bare(wind, statistics), 0.55);
      EXPECT_NEAR(found, wanted, 0.02 * wanted) << wind << ' ' << static_cast<int>(statistics);
      // A wind that is 5 % off is seen.
      if (wind == 5.0) {
        EXPECT_GT(std::abs(slope_of_glint(bare(1.05 * wind, statistics), 0.55) - wanted), 0.02 * wanted);
      }
    }
}

TEST(Sea, SkewedSlopesHaveTheMomentsOfCoxAndMunk) {
  for (const double wind : {3.0, 8.0, 13.0}) {
    const SeaSlopes slopes(wind, SlopeStatistics::skewed);
    const double a = std::sqrt(slopes.variance_along()), c = std::sqrt(slopes.variance_across());
    constexpr int kSteps = 400;
    double whole = 0.0, mean = 0.0, square = 0.0, cube = 0.0, mixed = 0.0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double along = 12.0 * (i + 0.5) / kSteps - 6.0, across = 12.0 * (j + 0.5) / kSteps - 6.0;
        const Vec3 facet = math::normalized({-along * a, -across * c, 1.0});
        const double p = slopes.density(facet) * std::pow(facet.z, 4) * a * c * std::pow(12.0 / kSteps, 2);
        whole += p;
        mean += p * along;
        square += p * along * along;
        cube += p * along * along * along;
        mixed += p * across * across * along;
      }
    EXPECT_NEAR(whole, 1.0, 1e-4);
    EXPECT_NEAR(mean, 0.0, 4e-3);
    EXPECT_NEAR(square, 1.0, 0.01);
    EXPECT_NEAR(cube, 0.033 * wind - 0.04, 0.06 * 0.033 * wind + 0.01);
    EXPECT_NEAR(mixed, 0.0086 * wind - 0.01, 0.06 * 0.0086 * wind + 0.005);
    // What a view sees of the facets, added up.
    for (const Vec3 view : {from_north(75.0, 90.0), from_north(85.0, 270.0), from_north(80.0, 30.0)}) {
      double seen = 0.0;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double along = 12.0 * (i + 0.5) / kSteps - 6.0, across = 12.0 * (j + 0.5) / kSteps - 6.0;
          const Vec3 facet = math::normalized({-along * a, -across * c, 1.0});
          const double p = slopes.density(facet) * std::pow(facet.z, 3) * a * c * std::pow(12.0 / kSteps, 2);
          seen += p * std::max(0.0, math::dot(view, facet));
        }
      EXPECT_NEAR(slopes.projected_area(view), seen, 5e-3 * seen) << wind;
    }
  }
}

/// Emissivity of the facets that a view sees, each by Fresnel's equations, as Masuda et al. 1988 add it up: light that goes from
/// one to another counts as if it were lost.
double emissivity_of_facets(const SeaSlopes& slopes, Vec3 view, double um) {
  constexpr int kSteps = 150;
  const std::complex<double> index = index_of_sea(um);
  double whole = 0.0, emitted = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 facet = math::normalized(
          {-1.2 * (2.0 * (i + 0.5) / kSteps - 1.0), -1.2 * (2.0 * (j + 0.5) / kSteps - 1.0), 1.0});
      const double cosine = math::dot(view, facet);
      if (!(cosine > 0.0)) continue;
      const double seen = slopes.gaussian().density(facet) * std::pow(facet.z, 3) * cosine;
      whole += seen;
      emitted += seen * (1.0 - fresnel(index, cosine));
    }
  return emitted / whole;
}

TEST(Sea, EmitsInTheThermalWindowAsItsFacetsDo) {
  for (const double um : {8.5, 10.5, 12.0})
    for (const double wind : {2.0, 10.0}) {
      const Sea sea = bare(wind, SlopeStatistics::isotropic);
      const double nadir = 1.0 - test::hemispherical_at(sea, 1.0, um),
                   slanting = 1.0 - test::hemispherical_at(sea, 0.5, um);
      EXPECT_NEAR(nadir, emissivity_of_facets(sea.slopes(), {0, 0, 1}, um), 5e-4) << um << ' ' << wind;
      // Facets emit on each other besides, and more is seen of those that face the view.
      const double facets = emissivity_of_facets(sea.slopes(), at(60.0 * kDegree, 0.0), um);
      EXPECT_GT(slanting, facets - 1e-3) << um << ' ' << wind;
      EXPECT_LT(slanting, facets + 0.012) << um << ' ' << wind;
    }
}

TEST(Sea, UnderAWhiteWaterAllComesBack) {
  // What passes at the mean: T(1)^2 / T_mean from below sends back all that the surface lets through.
  for (const double wind : {8.0}) {
    const Sea surface = bare(wind, SlopeStatistics::isotropic);
    constexpr int kAngles = 400;
    double mean = 0.0;
    std::vector<double> cosines, passed;
    for (int k = 0; k <= 24; ++k) {
      cosines.push_back(std::pow(std::max(1e-3, k / 24.0), 2));
      passed.push_back(1.0 - test::hemispherical_at(surface, cosines.back(), 0.55));
    }
    for (int k = 0; k < kAngles; ++k) {
      const double cosine = (k + 0.5) / kAngles;
      std::size_t i = 1;
      while (cosines[i] < cosine) ++i;
      const double s = (cosine - cosines[i - 1]) / (cosines[i] - cosines[i - 1]);
      mean += 2.0 * cosine * (passed[i - 1] + s * (passed[i] - passed[i - 1])) / kAngles;
    }
    const double white = passed.back() * passed.back() / mean;
    const Sea sea = bare(wind, SlopeStatistics::isotropic, 0.0, white);
    for (const double cosine : {1.0, 0.6, 0.3, 0.1})
      EXPECT_NEAR(test::hemispherical_at(sea, cosine, 0.55), 1.0, 2e-3) << wind << ' ' << cosine;
    EXPECT_LT(test::hemispherical_at(bare(wind, SlopeStatistics::isotropic, 0.0, 0.5 * white), 0.6, 0.55),
              0.6);
  }
}

TEST(Sea, NothingComesBackTwice) {
  for (const double wind : {2.0, 20.0})
    for (const SlopeStatistics statistics : {SlopeStatistics::isotropic, SlopeStatistics::skewed}) {
      const Sea sea = bare(wind, statistics);
      for (const double um : {0.55, 2.9})
        for (const double zenith : {0.0, 80.0, 89.0})
          for (const double azimuth : {0.0, 180.0}) {
            const double found = test::reflectance_towards(sea, from_north(zenith, azimuth), 16, um);
            EXPECT_GT(found, 0.0);
            EXPECT_LT(found, 0.75) << wind << ' ' << zenith << ' ' << azimuth;
          }
    }
}

TEST(Sea, LightFromBelowIsAsStatedFromStraightAbove) {
  const Sea sea({6.0, SlopeStatistics::isotropic, 0.0, 35.0, 0.2}, Spectrum::constant(0.03),
                Spectrum::constant(0.5)),
      dark({6.0, SlopeStatistics::isotropic, 0.0, 35.0, 0.2}, Spectrum::constant(0.0),
           Spectrum::constant(0.5)),
      glint({6.0, SlopeStatistics::isotropic, 0.0, 35.0, 0.2}, Spectrum::constant(0.0),
            Spectrum::constant(0.0));
  BsdfEvent event = test::view_of({0.0, 0.0, 1.0});
  event.incoming = {0.0, 0.0, 1.0};
  const double um = 0.55;
  EXPECT_NEAR(pi * (test::brdf_at(sea, event, um) - test::brdf_at(dark, event, um)), 0.8 * 0.03, 1e-5);
  EXPECT_NEAR(pi * (test::brdf_at(dark, event, um) - test::brdf_at(glint, event, um)), 0.2 * 0.5, 1e-5);
}

TEST(Sea, SamplesFollowTheDensity) {
  const double least = 1e-3 / 12.0;
  for (const double wind : {2.0, 14.0})
    for (const SlopeStatistics statistics : {SlopeStatistics::anisotropic, SlopeStatistics::skewed}) {
      const Sea sea({wind, statistics, 0.5, 35.0, std::nullopt}, Spectrum::constant(0.02),
                    whitecap_reflectance());
      const double width = sea.lobe_slopes().least;
      for (const Vec3 out : {at(0.0, 0.0), at(0.8, 0.5), at(1.45, 2.0)})
        EXPECT_GT(test::samples_against_density(sea, out, width, width, 40000), least)
            << wind << ' ' << out.z;
    }
}

TEST(Sea, IsReciprocalAndInvertsItsWarp) {
  for (const double wind : {2.0, 14.0})
    for (const SlopeStatistics statistics : kStatistics) {
      const Sea sea({wind, statistics, 0.7, 35.0, std::nullopt}, Spectrum::constant(0.02),
                    whitecap_reflectance());
      for (const double out : {0.0, 0.5, 1.3, 1.55})
        for (const double in : {0.2, 0.5, 1.4}) {
          BsdfEvent event = test::view_of(at(out, 0.3));
          event.incoming = at(in, 2.5);
          const double there = test::brdf_at(sea, event, 0.55);
          std::swap(event.outgoing, event.incoming);
          EXPECT_NEAR(test::brdf_at(sea, event, 0.55), there, 4e-7 * there);  // float
        }
      for (const double out : {0.3, 1.2, 1.5})
        for (int i = 0; i < 20; ++i)
          for (int j = 0; j < 20; ++j) {
            BsdfEvent event = test::view_of(at(out, 0.4));
            const BsdfSample sample = sea.sample(event, (i + 0.5) / 20, (j + 0.5) / 20);
            if (!(sample.weight > 0.0)) continue;
            event.incoming = sample.incoming;
            const UnitSquarePoint u = sea.invert(event);
            EXPECT_LT(math::length(sea.sample(event, u.u1, u.u2).incoming - sample.incoming), 1e-10);
            EXPECT_LT(sample.weight * sea.grey(event), 3.0);
          }
    }
}

TEST(Sea, LooksForItsHighlights) {
  // Slopes of 0.13 at 2 m/s: narrower than what highlights are sought of.
  EXPECT_TRUE(has_narrow_lobe(bare(2.0, SlopeStatistics::anisotropic)));
  BsdfEvent event = test::view_of(at(0.5, 0.0));
  event.incoming = at(0.5, pi);
  EXPECT_GT(bare(5.0, SlopeStatistics::anisotropic, 0.0, 0.02).lobe_share(event), 0.9);
  event.incoming = at(1.3, 0.0);
  EXPECT_LT(bare(5.0, SlopeStatistics::anisotropic, 0.0, 0.02).lobe_share(event), 1e-6);
}

TEST(Sea, SaysWhereItIsNotValid) {
  std::vector<std::string> said;
  const auto make = [&](double wind) {
    const BsdfInputs inputs{
        Spectrum::constant(0.0),
        {{"wind", wind}, {"wind_from", 0.0}, {"slopes", std::string("skewed")}, {"salinity", 35.0}},
        [&](const std::string& text) { said.push_back(text); }};
    return Sea::kModel.make(inputs);
  };
  make(14.0);
  EXPECT_TRUE(said.empty());
  make(20.0);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(
      said[0],
      "a wind of 20 m/s is above the 14 m/s up to which Cox and Munk (1954) measured the slopes of the sea");
  try {
    make(0.5);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "a wind of 0.5 m/s is below 1.6 m/s: the slopes that it leaves throw light on other surfaces that is not "
        "sought; calm water is {\"smooth\": {\"index\": \"water\", \"over\": \"absorber\"}}");
  }
}

}  // namespace
}  // namespace ifov::materials::test_sea
