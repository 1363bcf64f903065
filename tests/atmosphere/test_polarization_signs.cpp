// The solver's Q and U are those of radiometry::StokesVector, from the field of a dipole itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/column_maker.h"
#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/scattering/sky_ring.h"

namespace ifov::atmosphere::test_polarization_signs {
namespace {

using math::Vec3;
using test::kDegree;

/// Unpolarized light of radiance 1 along one direction, scattered by dipoles into another: each of two fields
/// across the first direction drives dipoles along it, which send what of them lies across the second. Times
/// 3 / 4, as a1 of rayleigh_matrix, whose mean over the sphere is 1, is 3 / 4 (1 + c^2).
StokesVector dipoles(const Propagation& from, const Propagation& to) {
  const radiometry::PolarizationFrame in = from.frame(), out = to.frame();
  StokesVector light;
  for (const Vec3& field : {in.x, in.y()}) {
    const double ex = dot(field, out.x), ey = dot(field, out.y());
    light += 0.75 * StokesVector{ex * ex + ey * ey, ex * ex - ey * ey, 2.0 * ex * ey, 0.0};
  }
  return light;
}

constexpr double kSun = 60.0 * kDegree;
const Propagation kSunlight{-std::cos(kSun), 0.0};

TEST(PolarizationSigns, OnceScatteredLightIsThatOfDipoles) {
  double with_other_u = 0.0;
  for (const double mu : {-1.0, -0.9, -0.5, -0.1, 0.2, 0.7, 1.0})
    for (const double azimuth : {0.0, 0.4, 1.5, 3.1, -0.4, -1.5}) {
      const Propagation to{mu, azimuth};
      const StokesVector expected = dipoles(kSunlight, to);
      const StokesVector found =
          scatter_unpolarized(kSunlight, to, rayleigh_matrix(scattering_cosine(kSunlight, to), 0.0));
      EXPECT_NEAR(found.i, expected.i, 1e-12);
      EXPECT_NEAR(found.q, expected.q, 1e-12) << mu << " " << azimuth;
      EXPECT_NEAR(found.u, expected.u, 1e-12) << mu << " " << azimuth;
      with_other_u = std::max(with_other_u, std::abs(found.u + expected.u));
    }
  EXPECT_GT(with_other_u, 0.5) << "U of the other sign passes";
}

// 90 degrees from the Sun light swings across the plane of Sun, air and observer.
TEST(PolarizationSigns, AtNinetyDegreesLightSwingsAcrossThePlane) {
  const test::Column column = test::rayleigh_layer(0.02);
  const ColumnSolution solution = ColumnSolver(test::flat()).solve(column.levels, column.optics, kSun);
  const Vec3 sunlight = kSunlight.frame().direction;
  // In the Sun's plane, and one direction on each side of it.
  const Vec3 opposite{-std::cos(kSun), 0.0, -std::sin(kSun)};
  for (const double aside : {0.0, 0.7, -0.7}) {
    const Vec3 k = std::cos(aside) * opposite + std::sin(aside) * Vec3{0.0, 1.0, 0.0};
    ASSERT_NEAR(dot(k, sunlight), 0.0, 1e-12);
    const Propagation direction{k.z, std::atan2(k.y, k.x)};
    const StokesVector light = solution.sunlit().path(direction, 0.0).single;
    EXPECT_NEAR(degree_of_linear_polarization(light), 1.0, 1e-9);
    const radiometry::PolarizationFrame frame = direction.frame();
    const double angle = angle_of_linear_polarization_rad(light);
    const Vec3 line = std::cos(angle) * frame.x + std::sin(angle) * frame.y();
    EXPECT_NEAR(dot(line, sunlight), 0.0, 1e-6);
    EXPECT_NEAR(std::abs(dot(line, normalized(cross(sunlight, k)))), 1.0, 1e-9);
    // In the Sun's plane that is level: Q < 0. U is above 0 on the left of sunlight, below on the right.
    if (aside == 0.0) {
      EXPECT_NEAR(light.q, -light.i, 1e-9 * light.i);
    } else {
      EXPECT_GT(light.u * aside, 0.0);
      EXPECT_GT(std::abs(light.u), 0.1 * light.i);
    }
  }
}

// All orders together turn with the frame: the zenith's light, told about any azimuth, is the same light.
TEST(PolarizationSigns, TheZenithIsOneLight) {
  const test::Column column = test::Air().column();
  const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, kSun);
  for (const double mu : {-1.0, 1.0}) {
    const double observer_km = mu < 0.0 ? 0.0 : 100.0;
    const Propagation first{mu, 0.0};
    const StokesVector expected = solution.sunlit().path(first, observer_km).radiance();
    EXPECT_GT(degree_of_linear_polarization(expected), 0.05);
    for (const double azimuth : {0.3, 1.4, 2.8, -1.0}) {
      const Propagation other{mu, azimuth};
      const StokesVector found =
          turned(other.frame(), first.frame()) * solution.sunlit().path(other, observer_km).radiance();
      EXPECT_NEAR(found.q, expected.q, 1e-12);
      EXPECT_NEAR(found.u, expected.u, 1e-12);
    }
  }
}

TEST(PolarizationSigns, ARingIsItsDirections) {
  test::Air air;
  air.aerosol = 0.3;
  const test::Column column = air.column();
  constexpr double kAzimuths[] = {0.0, 0.3, 1.2, 3.0, -1.2};
  const ColumnSolution solution = ColumnSolver().solve(column.levels, column.optics, 1.0);
  for (const ScatteredField* field : {&solution.sunlit(), &solution.groundlit()})
    for (const double mu : {-1.0, -0.6, -0.01}) {
      const std::vector<StokesVector> ring = sky_ring_stokes(*field, mu, kAzimuths, 0.7);
      const std::vector<double> scalar = sky_ring(*field, mu, kAzimuths, 0.7);
      for (std::size_t a = 0; a < ring.size(); ++a) {
        const StokesVector light = field->sky({mu, kAzimuths[a]}, 0.7).radiance();
        EXPECT_EQ(ring[a].i, scalar[a]);
        EXPECT_NEAR(ring[a].q, light.q, 1e-11 * light.i) << mu << " " << kAzimuths[a];
        EXPECT_NEAR(ring[a].u, light.u, 1e-11 * light.i) << mu << " " << kAzimuths[a];
      }
    }
}

}  // namespace
}  // namespace ifov::atmosphere::test_polarization_signs
