#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/ground_coupling.h"
#include "core/error.h"

namespace ifov::atmosphere::test_ground_coupling {
namespace {

using Q = PathQuantity;

const std::vector<double> kWavelengths{0.4, 0.55, 0.7};
const std::vector<double> kPath{40.0, 20.0, 8.0}, kReflected{120.0, 250.0, 300.0}, kAlbedo{0.25, 0.12, 0.06};
constexpr double kDirectPart = 0.7;

/// A run over a ground of this albedo by the equation itself.
ImportedPath run(double albedo, bool parts, double error = 0.0) {
  ImportedPath path("run " + std::to_string(albedo).substr(0, 4), kWavelengths);
  std::vector<double> total, scattered, reflected;
  for (std::size_t i = 0; i < kWavelengths.size(); ++i) {
    const double x = albedo / (1.0 - albedo * kAlbedo[i]) * (1.0 + error);
    scattered.push_back(kPath[i] + (1.0 - kDirectPart) * kReflected[i] * x);
    reflected.push_back(kDirectPart * kReflected[i] * x);
    total.push_back(scattered.back() + reflected.back());
  }
  path.set(Q::total_radiance, total);
  if (parts) {
    path.set(Q::solar_path_radiance, scattered);
    path.set(Q::ground_reflected_radiance, reflected);
  }
  return path;
}

void expect_terms(const GroundCoupling& coupling) {
  for (std::size_t i = 0; i < kWavelengths.size(); ++i) {
    EXPECT_NEAR(coupling.spherical_albedo[i], kAlbedo[i], 1e-10);
    EXPECT_NEAR(coupling.path_radiance[i], kPath[i], 1e-9);
    EXPECT_NEAR(coupling.reflected[i], kReflected[i], 1e-8);
    EXPECT_NEAR(coupling.radiance(i, 0.3), kPath[i] + kReflected[i] * 0.3 / (1.0 - 0.3 * kAlbedo[i]), 1e-8);
  }
}

std::string error_of(std::initializer_list<AlbedoRun> runs) {
  try {
    ground_coupling(std::vector<AlbedoRun>(runs));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GroundCoupling, ThreeRunsInAnyOrder) {
  const ImportedPath dark = run(0.0, false), grey = run(0.5, false), white = run(1.0, false),
                     low = run(0.2, false);
  for (const auto& runs : {std::vector<AlbedoRun>{{0.0, &dark}, {0.5, &grey}, {1.0, &white}},
                           std::vector<AlbedoRun>{{1.0, &white}, {0.0, &dark}, {0.5, &grey}},
                           std::vector<AlbedoRun>{{0.2, &low}, {1.0, &white}, {0.5, &grey}}}) {
    const GroundCoupling coupling = ground_coupling(runs);
    expect_terms(coupling);
    EXPECT_TRUE(coupling.direct_reflected.empty());
    EXPECT_EQ(coupling.cut, 0u);
  }
}

TEST(GroundCoupling, TwoRuns) {
  const ImportedPath grey = run(0.5, true), white = run(1.0, true);
  ImportedPath dark = run(0.0, true);
  const GroundCoupling from_reflected = ground_coupling(std::vector<AlbedoRun>{{0.5, &grey}, {1.0, &white}});
  expect_terms(from_reflected);
  for (std::size_t i = 0; i < kWavelengths.size(); ++i)
    EXPECT_NEAR(from_reflected.direct_reflected[i], kDirectPart * kReflected[i], 1e-8);
  dark.set(Q::spherical_albedo, kAlbedo);
  expect_terms(ground_coupling(std::vector<AlbedoRun>{{0.5, &grey}, {0.0, &dark}}));
}

// A run that does not belong to the others shows in the terms: the comparison above can fail.
TEST(GroundCoupling, AWrongRunShows) {
  const ImportedPath dark = run(0.0, false), grey = run(0.5, false), wrong = run(1.0, false, 0.01);
  const GroundCoupling coupling =
      ground_coupling(std::vector<AlbedoRun>{{0.0, &dark}, {0.5, &grey}, {1.0, &wrong}});
  EXPECT_GT(std::abs(coupling.spherical_albedo[0] - kAlbedo[0]), 0.01);
}

// Rounding at a wavelength where the ground is not seen gives no albedo below 0 or above 1.
TEST(GroundCoupling, NoiseIsCut) {
  ImportedPath dark("dark", {1.38}), grey("grey", {1.38}), white("white", {1.38});
  dark.set(Q::total_radiance, {1.0});
  grey.set(Q::total_radiance, {1.00002});
  white.set(Q::total_radiance, {1.00001});
  const GroundCoupling coupling =
      ground_coupling(std::vector<AlbedoRun>{{0.0, &dark}, {0.5, &grey}, {1.0, &white}});
  EXPECT_EQ(coupling.cut, 1u);
  EXPECT_GE(coupling.spherical_albedo[0], 0.0);
  EXPECT_LT(coupling.spherical_albedo[0], 1.0);
}

TEST(GroundCoupling, ErrorsNameTheRuns) {
  const ImportedPath dark = run(0.0, false), grey = run(0.5, false);
  const ImportedPath other("other.csv", {0.4, 0.5, 0.7}), shorter("short.csv", {0.4});
  EXPECT_EQ(error_of({{0.0, &dark}}), "found 1 runs of different albedo; expected 2 or 3");
  EXPECT_EQ(error_of({{0.0, &dark}, {0.0, &grey}}),
            "run 0.00 and run 0.50 have the same albedo, 0; expected runs that differ");
  EXPECT_EQ(error_of({{0.0, &dark}, {1.5, &grey}}), "run 0.50: found an albedo of 1.5; expected 0 to 1");
  EXPECT_EQ(error_of({{0.0, &dark}, {0.5, &other}}),
            "wavelength 2 is 0.55 um in run 0.00 and 0.5 um in other.csv; expected the same");
  EXPECT_EQ(error_of({{0.0, &dark}, {0.5, &shorter}}),
            "run 0.00 has 3 wavelengths and short.csv has 1; expected runs over the same");
  EXPECT_EQ(error_of({{0.0, &dark}, {0.5, &grey}}),
            "run 0.00 and run 0.50 do not tell the spherical albedo; expected a third run, or a column of "
            "spherical_albedo, or albedos above 0 and columns of ground_reflected_radiance");
}

}  // namespace
}  // namespace ifov::atmosphere::test_ground_coupling
