#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "radiometry/coherency.h"
#include "radiometry/fresnel.h"
#include "radiometry/polarization_frame.h"
#include "support/truth_data.h"

namespace ifov::radiometry::test_fresnel {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(Fresnel, NormalIncidence) {
  for (const double n : {1.33, 1.5, 0.7}) {
    const MuellerMatrix r = fresnel_reflection(n, 1.0), t = fresnel_transmission(n, 1.0);
    const double share = std::pow((n - 1.0) / (n + 1.0), 2);
    EXPECT_NEAR(r(0, 0), share, 1e-15);
    EXPECT_NEAR(t(0, 0), 1.0 - share, 1e-15);
    EXPECT_NEAR(r(0, 1), 0.0, 1e-15);
    // Seen in a mirror U and V are the other way round.
    EXPECT_NEAR(r(2, 2), -share, 1e-15);
    EXPECT_NEAR(r(3, 3), -share, 1e-15);
  }
  const std::complex<double> metal{1.28, 7.3};
  EXPECT_NEAR(fresnel_reflection(metal, 1.0)(0, 0), std::norm((metal - 1.0) / (metal + 1.0)), 1e-15);
}

TEST(Fresnel, BrewstersAngle) {
  for (const double n : {1.33, 1.5, 2.4}) {
    const double cosine = std::cos(std::atan(n));
    const StokesVector s = fresnel_reflection(n, cosine) * StokesVector{1.0, 0.0, 0.0, 0.0};
    EXPECT_NEAR(s.i, 0.5 * std::pow((n * n - 1.0) / (n * n + 1.0), 2), 1e-15);
    EXPECT_NEAR(s.q, -s.i, 1e-15) << "across the plane of incidence";
    EXPECT_LT(degree_of_linear_polarization(fresnel_reflection(n, 0.8 * cosine) * StokesVector{1, 0, 0, 0}),
              0.99);
  }
}

TEST(Fresnel, NoLightIsLost) {
  for (const double n : {1.33, 1.5, 0.75})
    for (const double cosine : {1e-6, 0.05, 0.3, 0.66, 0.7, 0.99, 1.0})
      for (const StokesVector s : {StokesVector{1, 0, 0, 0}, {1, 1, 0, 0}, {1, -0.5, 0.5, 0.5}}) {
        EXPECT_NEAR((fresnel_reflection(n, cosine) * s).i + (fresnel_transmission(n, cosine) * s).i, 1.0,
                    1e-12)
            << n << " " << cosine;
      }
  EXPECT_NEAR(fresnel_reflection(1.0, 0.0)(0, 0), 0.0, 1e-15);
}

// Light finds the same way back: n from one side is 1 / n from the other (Stokes' relations).
TEST(Fresnel, TransmissionIsReciprocal) {
  const double n = 1.5, sine = 0.8, beyond = std::sqrt(1.0 - sine * sine / (n * n));
  const MuellerMatrix in = fresnel_transmission(n, 0.6),
                      out = fresnel_transmission(1.0 / n, beyond).reversed();
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) EXPECT_NEAR(in(row, column), out(row, column), 1e-14);
}

// Born and Wolf (1999), section 1.5.4: arg(r_s / r_p) = d with tan(d / 2) = cos t sqrt(sin^2 t - n^2) / sin^2 t, and
// Fresnel's rhomb of n = 1.51 has d = 45 degrees at 48 deg 37' and 54 deg 37'.
TEST(Fresnel, TotalReflectionShiftsThePhase) {
  const double n = 1.0 / 1.51;
  for (const double angle : {48.0 + 37.0 / 60.0, 54.0 + 37.0 / 60.0, 45.0, 70.0}) {
    const double cosine = std::cos(angle * kDegree), square = 1.0 - cosine * cosine;
    const FresnelAmplitudes r = fresnel_reflection_amplitudes(n, cosine);
    EXPECT_NEAR(std::norm(r.p), 1.0, 1e-12);
    EXPECT_NEAR(std::norm(r.s), 1.0, 1e-12);
    const double expected = 2.0 * std::atan(cosine * std::sqrt(square - n * n) / square);
    EXPECT_NEAR(std::arg(r.s * std::conj(r.p)), expected, 1e-12);
    if (angle > 48.0 && angle < 60.0) {
      EXPECT_NEAR(expected / kDegree, 45.0, 0.05);
    }
    EXPECT_NEAR(fresnel_transmission(n, cosine)(0, 0), 0.0, 0.0);
  }
  // Two such reflections make circular light of what swings at 45 degrees.
  const MuellerMatrix once = fresnel_reflection(n, std::cos((54.0 + 37.0 / 60.0) * kDegree));
  const StokesVector s = once * (once * StokesVector{1.0, 0.0, 1.0, 0.0});
  EXPECT_GT(degree_of_circular_polarization(s), 0.9999);
}

TEST(Fresnel, PublishedFiguresOfGlassAt45Degrees) {
  const FresnelAmplitudes r = fresnel_reflection_amplitudes(1.5, std::cos(45.0 * kDegree));
  EXPECT_NEAR(std::norm(r.s), 0.0920134, 5e-8);
  EXPECT_NEAR(std::norm(r.p), std::norm(r.s) * std::norm(r.s), 1e-15);  // a law of this angle
}

constexpr const char* kFacets = "atmosphere/pbrdf_scatmech/facet_gaussian_mueller.csv";

struct Difference {
  double worst = 0.0;
  int rows = 0;
};

/// Facets without shadow scatter with Fresnel's matrix of the facet halfway, whatever their slopes: its ratios
/// to M00 are those of the file. SCATMECH has Q = I_s - I_p about (s, p, k), and our V.
Difference against_scatmech(double sign_of_v, bool halfway) {
  std::ifstream file(*test::truth_file(kFacets));
  Difference found;
  for (std::string line; std::getline(file, line);) {
    std::istringstream stream(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 24 || cells[3] != "none") continue;
    std::vector<double> x(24, 0.0);
    for (std::size_t k = 1; k < 24; ++k)
      if (k != 3) x[k] = std::strtod(cells[k].c_str(), nullptr);
    if (!(x[8] > 1e-200)) continue;
    const double in = x[5] * kDegree, out = x[6] * kDegree, azimuth = x[7] * kDegree;
    const math::Vec3 before{std::sin(in), 0.0, -std::cos(in)},
        after{std::sin(out) * std::cos(azimuth), std::sin(out) * std::sin(azimuth), std::cos(out)};
    const double cosine = halfway ? std::sqrt(0.5 * (1.0 - dot(before, after))) : std::cos(in);
    // s is level, which x of SCATMECH's frames is; at the vertical the azimuth settles it.
    PolarizationFrame first = meridional_frame(before.z, 0.0), last = meridional_frame(after.z, azimuth);
    first.x = first.y();
    last.x = last.y();
    const MuellerMatrix m =
        about(fresnel_reflection({x[1], x[2]}, cosine), scattering_frames(before, after), first, last);
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t column = 0; column < 4; ++column) {
        const double v = (row == 3 ? sign_of_v : 1.0) * (column == 3 ? sign_of_v : 1.0);
        found.worst =
            std::max(found.worst, std::abs(m(row, column) / m(0, 0) - v * x[8 + 4 * row + column] / x[8]));
      }
    ++found.rows;
  }
  return found;
}

TEST(Fresnel, MatricesOfFacetsByAnotherProgram) {
  if (!test::truth_file(kFacets)) GTEST_SKIP() << "reference data not found: " << kFacets;
  const Difference right = against_scatmech(1.0, true);
  EXPECT_GT(right.rows, 300);
  EXPECT_LT(right.worst, 2e-9);
  EXPECT_GT(against_scatmech(-1.0, true).worst, 0.1) << "circular light of the other hand passes";
  EXPECT_GT(against_scatmech(1.0, false).worst, 0.1)
      << "the angle to the surface passes for that to the facet";
}

/// n and k of a file of refractiveindex.info at the row with this wavelength.
std::complex<double> index_at(const std::filesystem::path& path, double wavelength_um) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream stream(line);
    double um = 0.0, n = 0.0, k = 0.0;
    if (stream >> um >> n >> k && std::abs(um - wavelength_um) < 1e-4 * wavelength_um) return {n, k};
  }
  return 0.0;
}

// From measured n and k: 1 - R = 4 n / ((n + 1)^2 + k^2) at normal incidence.
TEST(Fresnel, MetalsAndWaterByMeasuredIndices) {
  const auto gold = test::truth_file("indices/Au_Ordal.yml"),
             water = test::truth_file("indices/H2O_Hale.yml");
  if (!gold || !water) GTEST_SKIP() << "reference data not found: indices/Au_Ordal.yml, indices/H2O_Hale.yml";
  const std::complex<double> m = index_at(*gold, 10.0), w = index_at(*water, 0.6);
  ASSERT_GT(m.imag(), 10.0);
  ASSERT_NEAR(w.real(), 1.332, 1e-9);
  EXPECT_NEAR(1.0 - fresnel_reflection(m, 1.0)(0, 0),
              4.0 * m.real() / (std::pow(m.real() + 1.0, 2) + m.imag() * m.imag()), 1e-12);
  EXPECT_NEAR(fresnel_reflection(w, 1.0)(0, 0), std::pow(0.332 / 2.332, 2), 1e-12);
  for (const double cosine : {0.05, 0.4, 0.9})
    EXPECT_GT(test::coherency_eigenvalues(fresnel_reflection(m, cosine))[0], -1e-13);
}

}  // namespace
}  // namespace ifov::radiometry::test_fresnel
