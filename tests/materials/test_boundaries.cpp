// Smooth boundaries, panes and films against Fresnel's equations, geometric series and the closed forms of thin films.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.h"
#include "materials/bsdf/boundary/delta_boundary.h"
#include "materials/bsdf/boundary/film.h"
#include "materials/bsdf/boundary/slab.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/lobe_checks.h"
#include "radiometry/fresnel.h"

namespace ifov::materials::test_boundaries {
namespace {

using radiometry::Spectrum;
using std::numbers::pi;

Spectrum one(double value) { return Spectrum::constant(value); }

/// Share of a boundary at a wavelength, of light at an angle from its normal.
double share(const Bsdf& bsdf, Side side, double angle, double um = 1.0) {
  BsdfEvent event{{std::sin(angle), 0.0, std::cos(angle)}, {}, {0, 0, 1}, {}, side};
  event.incoming = bsdf.sample(event, 0.5, 0.5).incoming;
  return test::brdf_at(bsdf, event, um);
}
double reflected(const Bsdf& bsdf, double angle, double um = 1.0) {
  return share(bsdf, Side::reflected, angle, um);
}
double transmitted(const Bsdf& bsdf, double angle, double um = 1.0) {
  return share(bsdf, Side::transmitted, angle, um);
}

/// Reflectances of a dielectric by the sines and tangents of Fresnel's own form.
struct FresnelForm {
  double s, p;
  FresnelForm(double n, double a) {
    const double b = std::asin(std::sin(a) / n);
    const double rs = std::sin(a - b) / std::sin(a + b), rp = std::tan(a - b) / std::tan(a + b);
    s = rs * rs, p = rp * rp;
  }
};

TEST(Boundaries, SmoothReflectsAsFresnelSays) {
  const auto glass = smooth::make(one(1.5), one(0.0), one(1.0), true);
  EXPECT_NEAR(reflected(*glass, 0.0), 0.04, 1e-6);
  const FresnelForm at45(1.5, pi / 4.0);
  EXPECT_NEAR(reflected(*glass, pi / 4.0), 0.5 * (at45.s + at45.p), 5e-5);
  EXPECT_NEAR(0.5 * (at45.s + at45.p), 0.0502399, 1e-7);
  for (const double angle : {0.0, 0.3, 0.8, 1.2, 1.5})
    EXPECT_NEAR(reflected(*glass, angle) + transmitted(*glass, angle), 1.0, 1e-6) << angle;
  const auto metal = smooth::make(one(2.0), one(3.0), one(1.0), false);
  EXPECT_NEAR(reflected(*metal, 0.0), (1.0 + 9.0) / (9.0 + 9.0), 1e-6);
  EXPECT_FALSE(metal->may_transmit());
}

TEST(Boundaries, FromWithinTheSameLightIsReflected) {
  const auto glass = smooth::make(one(1.5), one(0.0), one(1.0), true);
  const auto within = glass->behind();
  ASSERT_NE(within, nullptr);
  for (const double angle : {0.1, 0.7, 1.3}) {
    const double inside = std::asin(std::sin(angle) / 1.5);
    EXPECT_NEAR(transmitted(*within, inside), transmitted(*glass, angle), 1e-6) << angle;
    // The one direction leads to the other and back.
    BsdfEvent out{{std::sin(angle), 0.0, std::cos(angle)}, {}, {0, 0, 1}, {}, Side::transmitted};
    const math::Vec3 in = glass->sample(out, 0.5, 0.5).incoming;
    EXPECT_NEAR(std::hypot(in.x, in.y), std::sin(inside), 1e-12);
    BsdfEvent back{in, {}, {0, 0, -1}, {}, Side::transmitted};
    EXPECT_NEAR(math::length(within->sample(back, 0.5, 0.5).incoming - out.outgoing), 0.0, 1e-12);
  }
  const double total = std::asin(1.0 / 1.5) + 0.01;
  EXPECT_NEAR(reflected(*within, total), 1.0, 1e-6);
  EXPECT_EQ(transmitted(*within, total), 0.0);
  BsdfEvent beyond{{std::sin(total), 0.0, std::cos(total)}, {}, {0, 0, 1}, {}, Side::transmitted};
  EXPECT_EQ(within->sample(beyond, 0.5, 0.5).weight, 0.0);
}

TEST(Boundaries, MediumAbsorbsAsItsIndexSays) {
  const auto water = smooth::make(one(1.33), one(1e-6), one(1.0), true);
  ASSERT_NE(water->absorption(), nullptr);
  EXPECT_NEAR(water->absorption()->at(0.5), 4.0 * pi * 1e-6 / 0.5e-6, 1e-3 * 25.13);
  EXPECT_EQ(smooth::make(one(1.5), one(0.0), one(1.0), true)->absorption(), nullptr);
}

/// The light of a pane added up one reflection after the other.
struct AddedUp {
  double r = 0.0, t = 0.0;
  AddedUp(double n, double k, double thickness_um, double um, double angle) {
    const double b = std::asin(std::sin(angle) / n);
    const double once = std::exp(-4.0 * pi * k * thickness_um / (um * std::cos(b)));
    const FresnelForm face(n, std::max(angle, 1e-9));
    for (const double f : {face.s, face.p}) {
      r += 0.5 * f;
      double inside = (1.0 - f) * once;
      for (int crossing = 0; crossing < 60; ++crossing) {
        (crossing % 2 == 0 ? t : r) += 0.5 * inside * (1.0 - f);
        inside *= f * once;
      }
    }
  }
};

TEST(Boundaries, SlabIsItsGeometricSeries) {
  // An absorption so weak that the angle within is that of n alone.
  const auto pane = slab::make(one(1.52), one(2e-6), 6e-3, one(1.0));
  for (const double angle : {0.0, 0.5, pi / 4.0, 1.2}) {
    const AddedUp sum(1.52, 2e-6, 6e3, 0.7, angle);
    EXPECT_NEAR(reflected(*pane, angle, 0.7), sum.r, 2e-4) << angle;
    EXPECT_NEAR(transmitted(*pane, angle, 0.7), sum.t, 2e-4) << angle;
    EXPECT_NEAR(1.0 - reflected(*pane, angle, 0.7) - transmitted(*pane, angle, 0.7), 1.0 - sum.r - sum.t,
                3e-4);
  }
  const auto clear = slab::make(one(1.5), one(0.0), 4e-3, one(1.0));
  EXPECT_NEAR(reflected(*clear, 0.0), 2.0 * 0.04 / 1.04, 1e-5);  // 2 r / (1 + r)
  EXPECT_NEAR(reflected(*clear, 0.9) + transmitted(*clear, 0.9), 1.0, 1e-5);
  EXPECT_EQ(clear->passage(), Passage::straight);
}

TEST(Boundaries, QuarterWaveFilmReflectsLeast) {
  constexpr double kFilm = 1.38, kGlass = 1.52, kGreen_um = 0.55;
  const auto coated = film::make({one(kFilm), one(0.0), 1e-6 * kGreen_um / (4.0 * kFilm)}, one(kGlass),
                                 one(0.0), {}, one(1.0));
  const double least = std::pow((kGlass - kFilm * kFilm) / (kGlass + kFilm * kFilm), 2);
  EXPECT_NEAR(reflected(*coated, 0.0, kGreen_um), least, 2e-4);
  EXPECT_GT(reflected(*coated, 0.0, 0.8), least + 1e-3);
  EXPECT_GT(reflected(*coated, 0.0, 0.4), least + 1e-3);
  // Of half a wave it is as if it were not there.
  EXPECT_NEAR(reflected(*coated, 0.0, 0.5 * kGreen_um), std::pow((kGlass - 1.0) / (kGlass + 1.0), 2), 3e-4);
}

TEST(Boundaries, FilmOfNothingIsTheSlabAndOfGlassItsFace) {
  const auto pane = slab::make(one(1.5), one(1e-6), 4e-3, one(1.0));
  const auto bare = film::make({one(1.5), one(0.0), 1e-9}, one(1.5), one(1e-6), 4e-3, one(1.0));
  for (const double angle : {0.0, 0.6, 1.1}) {
    EXPECT_NEAR(reflected(*bare, angle), reflected(*pane, angle), 3e-4) << angle;
    EXPECT_NEAR(transmitted(*bare, angle), transmitted(*pane, angle), 3e-4) << angle;
  }
}

TEST(Boundaries, CoatedPaneLetsThroughTheSameBothWays) {
  // Silver, 10 nm: both sides reflect differently, and what goes through is the same (reciprocity).
  const auto front = film::make({one(0.15), one(4.0), 1e-8}, one(1.5), one(0.0), 4e-3, one(1.0));
  const auto back = front->behind();
  ASSERT_NE(back, nullptr);
  for (const double angle : {0.0, 0.7, 1.2}) {
    EXPECT_NEAR(transmitted(*front, angle, 0.6), transmitted(*back, angle, 0.6), 2e-4) << angle;
    EXPECT_GT(std::abs(reflected(*front, angle, 0.6) - reflected(*back, angle, 0.6)), 1e-3) << angle;
    EXPECT_LT(reflected(*front, angle, 0.6) + transmitted(*front, angle, 0.6), 1.0);
    EXPECT_LT(reflected(*back, angle, 0.6) + transmitted(*back, angle, 0.6), 1.0);
  }
}

TEST(Boundaries, AmplitudesTellTheirShares) {
  // |t|^2 by the ratio of the waves' cross-sections and indices is what |r|^2 leaves (Born and Wolf, 1.5.3).
  for (const double cosine : {1.0, 0.6, 0.2}) {
    const auto r = radiometry::fresnel_reflection_amplitudes(1.5, cosine);
    const auto t = radiometry::fresnel_transmission_amplitudes(1.5, cosine);
    const double ratio = std::sqrt(1.5 * 1.5 - 1.0 + cosine * cosine) / cosine;
    EXPECT_NEAR(std::norm(r.p) + ratio * std::norm(t.p), 1.0, 1e-12);
    EXPECT_NEAR(std::norm(r.s) + ratio * std::norm(t.s), 1.0, 1e-12);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const auto film = radiometry::film_shares({1.0, {1.8, 0.0}, 1.5, 0.3}, sine);
    EXPECT_NEAR(film.reflected_p + film.transmitted_p, 1.0, 1e-12);
    EXPECT_NEAR(film.reflected_s + film.transmitted_s, 1.0, 1e-12);
    // Without a film the amplitudes are those of the boundary.
    const auto none = radiometry::film_reflection_amplitudes({1.0, 1.5, 1.5, 0.0}, sine);
    EXPECT_NEAR(std::abs(none.p - r.p), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(none.s - r.s), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace ifov::materials::test_boundaries
