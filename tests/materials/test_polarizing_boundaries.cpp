// Mueller matrices of smooth boundaries, panes and films.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "materials/bsdf/boundary/film.h"
#include "materials/bsdf/boundary/slab.h"
#include "materials/bsdf/boundary/smooth.h"
#include "materials/bsdf/node_bsdf.h"
#include "radiometry/coherency.h"
#include "radiometry/fresnel.h"

namespace ifov::materials::test_polarizing_boundaries {
namespace {

using radiometry::MuellerMatrix;
using radiometry::Spectrum;
using radiometry::StokesVector;
using std::numbers::pi;

constexpr double kOneDegree = pi / 180.0;

Spectrum even(double value) { return Spectrum::constant(value); }

/// Of a delta in one wavelength, for light that leaves at an angle from the normal.
MuellerMatrix boundary_matrix(const Bsdf& bsdf, Side side, double angle, double um = 1.0) {
  std::vector<float> numbers;
  for (const auto& list : {bsdf.spectra(), bsdf.polarization_spectra()})
    for (const Spectrum& spectrum : list) numbers.push_back(static_cast<float>(spectrum.at(um)));
  std::vector<const float*> pointers;
  for (const float& number : numbers) pointers.push_back(&number);
  BsdfEvent event{{std::sin(angle), 0.0, std::cos(angle)}, {}, {0, 0, 1}, {}, side};
  event.incoming = bsdf.sample(event, 0.5, 0.5).incoming;
  float whole = 0.0f, column[4], values[16];
  bsdf.evaluate(event, pointers, 1, &whole);
  bsdf.evaluate_mueller(event, pointers, 1, {column, 1, false});
  bsdf.evaluate_mueller(event, pointers, 1, {values, 1, true});
  EXPECT_EQ(values[0], whole);
  std::array<double, 16> m{};
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_EQ(column[r], values[r]);
    for (std::size_t c = 0; c < 4; ++c) m[4 * r + c] = static_cast<double>(values[4 * c + r]);
  }
  return MuellerMatrix(m);
}

double degree(const MuellerMatrix& m) {
  return radiometry::degree_of_linear_polarization(m * StokesVector{1.0, 0.0, 0.0, 0.0});
}

void expect_near(const MuellerMatrix& found, const MuellerMatrix& exact, double within, double angle) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(found(r, c), exact(r, c), within) << r << c << " at " << angle;
}

TEST(PolarizingBoundaries, ReflectByFresnelsMatrices) {
  const auto glass = smooth::make(even(1.5), even(0.0), even(1.0), true);
  EXPECT_NEAR(degree(boundary_matrix(*glass, Side::reflected, 45.0 * kOneDegree)), 0.83148, 1e-5);
  EXPECT_GT(degree(boundary_matrix(*glass, Side::reflected, std::atan(1.5))), 0.9999);
  EXPECT_NEAR(std::atan(1.5) / kOneDegree, 56.310, 1e-3);
  // What is reflected swings across the plane of incidence, what is let through in it.
  EXPECT_LT(boundary_matrix(*glass, Side::reflected, 0.8)(1, 0), -0.01);
  EXPECT_GT(boundary_matrix(*glass, Side::transmitted, 0.8)(1, 0), 0.01);
  for (const double angle : {0.0, 0.2, 0.7, 1.1, 1.4, 1.55}) {
    expect_near(boundary_matrix(*glass, Side::reflected, angle),
                radiometry::fresnel_reflection(1.5, std::cos(angle)), 1e-5, angle);
    expect_near(boundary_matrix(*glass, Side::transmitted, angle),
                radiometry::fresnel_transmission(1.5, std::cos(angle)), 2e-5, angle);
    const std::complex<double> index(1.3, 5.0);
    const auto metal = smooth::make(even(1.3), even(5.0), even(1.0), false);
    expect_near(boundary_matrix(*metal, Side::reflected, angle),
                radiometry::fresnel_reflection(index, std::cos(angle)), 2e-5, angle);
  }
  // Planted fault: s and p taken for each other.
  EXPECT_GT(std::abs(boundary_matrix(*glass, Side::reflected, 0.8)(1, 0) +
                     radiometry::fresnel_reflection(1.5, std::cos(0.8))(1, 0)),
            0.05);
}

// Fresnel's rhomb: glass of 1.51 turns p against s by an eighth of a wave at 48 deg 37' and 54 deg 37' (Born and Wolf, section 1.5.4).
TEST(PolarizingBoundaries, TotalReflectionRetards) {
  const auto glass = smooth::make(even(1.51), even(0.0), even(1.0), true);
  const auto within = glass->behind();
  for (const double angle : {(48.0 + 37.0 / 60.0) * kOneDegree, (54.0 + 37.0 / 60.0) * kOneDegree}) {
    const MuellerMatrix once = boundary_matrix(*within, Side::reflected, angle);
    EXPECT_NEAR(once(0, 0), 1.0, 1e-6);
    EXPECT_NEAR(once(1, 0), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(std::atan2(once(2, 3), once(2, 2))), 45.0 * kOneDegree, 0.01 * kOneDegree);
    // Light at 45 degrees leaves circular after two of them.
    const StokesVector twice = once * (once * StokesVector{1.0, 0.0, 1.0, 0.0});
    EXPECT_NEAR(std::abs(twice.v), 1.0, 1e-5);
    EXPECT_NEAR(twice.u, 0.0, 1e-3);
    expect_near(once, radiometry::fresnel_reflection(1.0 / 1.51, std::cos(angle)), 1e-6, angle);
  }
  // Below the limit, as from outside at the angle of the ray beyond; across the limit nothing jumps.
  const double below = std::asin(std::sin(0.9) / 1.51), limit = std::asin(1.0 / 1.51);
  expect_near(boundary_matrix(*within, Side::reflected, below),
              radiometry::fresnel_reflection(1.0 / 1.51, std::cos(below)), 1e-5, below);
  expect_near(boundary_matrix(*within, Side::reflected, limit + 1e-9),
              radiometry::fresnel_reflection(1.0 / 1.51, std::cos(limit + 1e-9)), 1e-3, limit);
  EXPECT_NEAR(boundary_matrix(*within, Side::reflected, 1.2)(2, 3),
              -boundary_matrix(*within, Side::reflected, 1.2)(3, 2), 1e-7);
}

// Stokes (1862): m plates between which light goes to and fro let through (1 - R) / (1 + (2m - 1) R) of either polarization.
TEST(PolarizingBoundaries, PanesAreSumsOfEitherPolarization) {
  const auto pane = slab::make(even(1.52), even(0.0), 4e-3, even(1.0));
  for (const double angle : {0.0, 0.5, 0.9886, 1.3, 1.5}) {
    const MuellerMatrix r = radiometry::fresnel_reflection(1.52, std::cos(angle));
    const double p = r(0, 0) + r(0, 1), s = r(0, 0) - r(0, 1);
    const double tp = (1.0 - p) / (1.0 + p), ts = (1.0 - s) / (1.0 + s);
    const MuellerMatrix through = boundary_matrix(*pane, Side::transmitted, angle),
                        back = boundary_matrix(*pane, Side::reflected, angle);
    EXPECT_NEAR(degree(through), (tp - ts) / (tp + ts), 1e-5) << angle;
    EXPECT_NEAR(back(0, 1), -through(0, 1), 2e-5) << angle;
    // Of beam after beam r_p r_s and t_p t_s, which are real.
    EXPECT_NEAR(through(2, 2), (1.0 - p) * (1.0 - s) / (1.0 - p * s), 2e-5) << angle;
  }
  // What absorbs stands behind it: of a thick pane no more than its front's reflection comes back.
  const auto grey = slab::make(even(1.52), even(1e-4), 0.1, even(1.0));
  expect_near(boundary_matrix(*grey, Side::reflected, 0.9),
              radiometry::fresnel_reflection({1.52, 1e-4}, std::cos(0.9)), 2e-5, 0.9);
  EXPECT_NEAR(boundary_matrix(*grey, Side::transmitted, 0.9)(0, 0), 0.0, 1e-6);
}

// A film of no thickness is none; one of half a wave between the same media neither; and amplitudes of one that is neither add up as
// Airy's sum has them, summed here term by term.
TEST(PolarizingBoundaries, FilmsAddUpWaves) {
  const double angle = 0.9, um = 0.6, thickness_um = 0.137;
  const std::complex<double> n_film(1.38, 0.0), n_below(3.9, 0.02);
  const auto coated = film::make({even(1.38), even(0.0), thickness_um * 1e-6}, even(3.9), even(0.02),
                                 std::nullopt, even(1.0));
  const double sine = std::sin(angle);
  const auto first = radiometry::fresnel_reflection_amplitudes(n_film, std::cos(angle));
  const std::complex<double> cosine = std::sqrt(1.0 - sine * sine / (n_film * n_film));
  const auto second = radiometry::fresnel_reflection_amplitudes(n_below / n_film, cosine.real());
  const std::complex<double> turn =
      std::exp(std::complex<double>(0.0, 4.0 * pi * thickness_um / um) * n_film * cosine);
  const auto sum = [&](std::complex<double> a, std::complex<double> b) {
    std::complex<double> all = a, wave = (1.0 - a * a) * b * turn;
    for (int k = 0; k < 60; ++k, wave *= -a * b * turn) all += wave;
    return all;
  };
  const std::complex<double> p = sum(first.p, second.p), s = sum(first.s, second.s), both = p * std::conj(s);
  const MuellerMatrix found = boundary_matrix(*coated, Side::reflected, angle, um);
  EXPECT_NEAR(found(0, 0), 0.5 * (std::norm(p) + std::norm(s)), 3e-4);
  EXPECT_NEAR(found(0, 1) / found(0, 0), (std::norm(p) - std::norm(s)) / (std::norm(p) + std::norm(s)), 2e-3);
  EXPECT_NEAR(found(2, 2), both.real(), 5e-4);
  EXPECT_NEAR(found(2, 3), both.imag(), 5e-4);
  EXPECT_GT(std::abs(both.imag()), 0.005) << "nothing was tested";
}

TEST(PolarizingBoundaries, HaveMatricesThatCanBeAndEmitWhatIsLeft) {
  const std::vector<radiometry::Channel> channel = {radiometry::Channel::monochromatic("c", 10.0)};
  const auto nodes = radiometry::SpectralNodes::build(channel, Spectrum(), {});
  const auto glass = smooth::make(even(1.5), even(0.0), even(1.0), true);
  const std::shared_ptr<const Bsdf> all[] = {
      glass,
      glass->behind(),
      smooth::make(even(2.0), even(3.0), even(0.9), false),
      slab::make(even(1.5), even(1e-4), 3e-3, even(0.8)),
      film::make({even(2.1), even(0.01), 3e-7}, even(1.5), even(0.0), 4e-3, even(1.0)),
      film::make({even(2.1), even(0.01), 3e-7}, even(1.5), even(0.0), 4e-3, even(1.0))->behind()};
  for (const auto& bsdf : all) {
    const NodeBsdf own(bsdf, nodes, true);
    std::vector<float> i(64), q(64), work(64);
    for (const double angle : {0.0, 0.4, 0.9, 1.3, 1.5}) {
      own.emissivity(std::cos(angle), i.data(), work.data());
      ASSERT_TRUE(own.polarized_emission(std::cos(angle), q.data()));
      // In a room of one temperature nothing is polarized: Kirchhoff.
      double sum_i = static_cast<double>(i[0]), sum_q = static_cast<double>(q[0]);
      for (const Side side : {Side::reflected, Side::transmitted}) {
        if (side == Side::transmitted && !bsdf->may_transmit()) continue;
        const MuellerMatrix m = boundary_matrix(*bsdf, side, angle, 10.0);
        EXPECT_GE(test::coherency_eigenvalues(m)[0], -1e-5 * m(0, 0)) << angle;
        sum_i += m(0, 0), sum_q += m(1, 0);
      }
      EXPECT_NEAR(sum_i, 1.0, 2e-6) << angle;
      EXPECT_NEAR(sum_q, 0.0, 2e-6) << angle;
    }
  }
}

}  // namespace
}  // namespace ifov::materials::test_polarizing_boundaries
