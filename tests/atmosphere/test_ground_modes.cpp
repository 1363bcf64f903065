// A ground's azimuthal modes against integrals of its BRDF, and what thin air makes of its light against dipoles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column_maker.h"
#include "atmosphere/ground_monte_carlo.h"
#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/reflected_light.h"
#include "atmosphere/test_ground.h"

namespace test_ground_modes {
using namespace ifov::atmosphere;
using namespace ifov::atmosphere::test;

namespace {

constexpr double kPi = std::numbers::pi, kSun = 0.6;

/// Every element counts and has three modes; those between U and the others are odd.
GroundMatrix three_modes(const GroundEvent& e) {
  const double in = -e.in_mu, out = e.out_mu, between = e.out_azimuth_rad - e.in_azimuth_rad;
  GroundMatrix matrix{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const double a = 0.1 * static_cast<double>(1 + row), b = 0.07 * static_cast<double>(1 + column);
      matrix[row][column] =
          (row == 2) != (column == 2)
              ? (0.3 + a * in) * std::sin(between) + b * out * std::sin(2.0 * between)
              : 1.0 + a * out + (0.4 + b * in) * std::cos(between) + a * b * std::cos(2.0 * between);
    }
  return matrix;
}

/// What a factor on one element makes worse.
FormulaGround ground(std::size_t row = 0, std::size_t column = 0, double factor = 1.0) {
  return {[=](const GroundEvent& e) {
            GroundMatrix matrix = three_modes(e);
            matrix[row][column] *= factor;
            return matrix;
          },
          true};
}

std::array<double, 3> added(const GroundShape& shape, double mu, double azimuth) {
  const StokesVector light = shape.radiance(mu, azimuth);
  return {light.i, light.q, light.u};
}

/// In parts of 1, over directions between the nodes.
double worst_of_beam(const GroundModes& modes) {
  GroundShape shape{modes.out(), 3, {}};
  for (int m = 0; m < modes.modes(); ++m) shape.modes.push_back(modes.of_beam(m));
  double worst = 0.0;
  for (const double mu : {0.15, 0.5, 0.93})
    for (const double azimuth : {0.0, 0.7, 2.0, -1.4}) {
      const GroundMatrix brdf = three_modes({mu, -kSun, azimuth, 0.0});
      const auto found = added(shape, mu, azimuth);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(found[c] - kSun * brdf[c][0]));
    }
  return worst;
}

double worst_of_diffuse(const GroundModes& modes, const GaussNodes& in) {
  const std::size_t ins = in.position.size();
  // Light of three modes; that of U is odd.
  const auto down = [](std::size_t c, int m, double mu) {
    return (c == 2 && m == 0) || m > 2 ? 0.0 : (1.0 + mu) / (1.0 + static_cast<double>(c) + m);
  };
  GroundShape shape{modes.out(), 3, {}};
  for (int m = 0; m < 3; ++m) {
    std::vector<double> light;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < ins; ++j) light.push_back(down(c, m, in.position[j]));
    shape.modes.push_back(modes.of_diffuse(m, light));
  }
  double worst = 0.0;
  for (const double mu : {0.2, 0.8})
    for (const double azimuth : {0.4, 2.5, -1.9}) {
      std::array<double, 3> wanted{};
      constexpr int kSteps = 24;
      for (std::size_t j = 0; j < ins; ++j)
        for (int a = 0; a < kSteps; ++a) {
          const double from = 2.0 * kPi * a / kSteps,
                       weight = in.weight[j] * in.position[j] * 2.0 * kPi / kSteps;
          const GroundMatrix brdf = three_modes({mu, -in.position[j], azimuth, from});
          for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < 3; ++k)
              for (int m = 0; m < 3; ++m)
                wanted[c] += weight * brdf[c][k] * down(k, m, in.position[j]) *
                             (k == 2 ? std::sin(m * from) : std::cos(m * from));
        }
      const auto found = added(shape, mu, azimuth);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(found[c] - wanted[c]));
    }
  return worst;
}

}  // namespace

TEST(GroundModes, AddUpToTheBrdf) {
  const GaussNodes in = gauss_nodes(8);
  const GroundModes modes(ground(), 0.5, in, kSun, 16, true);
  EXPECT_LT(worst_of_beam(modes), 1e-7);
  EXPECT_LT(worst_of_diffuse(modes, in), 1e-7);
  // Planted: a hundredth of each element.
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const GroundModes wrong(ground(row, column, 1.01), 0.5, in, kSun, 16, true);
      if (column == 0) {
        EXPECT_GT(worst_of_beam(wrong), 1e-3) << row;
      }
      EXPECT_GT(worst_of_diffuse(wrong, in), 1e-3) << row << column;
    }
}

// So thin that light is scattered once: each direction of the ground's light by itself.
TEST(GroundModes, ThinAirScattersLightOfTheGroundAsDipoles) {
  constexpr double kDepth = 1e-7;
  const GroundOfFields fields = facets_of_fields(1.34, 0.06);
  const FormulaGround facets(
      [fields](const GroundEvent& e) {
        const Vector in = towards(e.in_mu, e.in_azimuth_rad), out = towards(e.out_mu, e.out_azimuth_rad);
        GroundMatrix matrix{};
        for (std::size_t column = 0; column < 3; ++column) {
          std::array<double, 3> unit{};
          unit[column] = 1.0;
          const auto made = stokes_of(fields(dyad_of(unit, in), in, out), out);
          for (std::size_t row = 0; row < 3; ++row) matrix[row][column] = made[row];
        }
        return matrix;
      },
      true);
  Column column;
  column.add_layer(10.0, kDepth, 0.0, 0.0, 0.0);
  column.optics.depolarization = 0.0;
  const ColumnSolver solver(flat());
  const double zenith = std::acos(kSun);
  const GroundModes modes = solver.modes_of(facets, 0.55, zenith);
  const ColumnSolution solution = solver.solve(column.levels, column.optics, zenith, &modes);
  ASSERT_NE(solution.reflected(), nullptr);
  GroundShape shape = solution.reflected()->shape;
  for (const GroundLight& mode : shape.modes) ASSERT_EQ(mode.size(), 3 * shape.out.position.size());
  // `part` of Q and U of the ground, in parts of I.
  const auto worst = [&](double part) {
    double found = 0.0;
    for (const auto& [mu, azimuth] : {std::pair{0.9, 0.3}, {0.5, 1.6}, {0.5, 2.8}, {0.7, -1.0}, {0.3, 0.0}}) {
      const Vector out = towards(mu, azimuth);
      std::array<double, 3> wanted{};
      constexpr int kSteps = 128;
      for (std::size_t j = 0; j < shape.out.position.size(); ++j)
        for (int a = 0; a < kSteps; ++a) {
          const double from = 2.0 * kPi * a / kSteps, weight = shape.out.weight[j] * 2.0 * kPi / kSteps;
          const StokesVector light = shape.radiance(shape.out.position[j], from);
          const Dyad field =
              dyad_of({light.i, part * light.q, part * light.u}, towards(shape.out.position[j], from));
          const auto made = stokes_of(sandwich(across(out), field), out);
          for (std::size_t c = 0; c < 3; ++c) wanted[c] += weight * 1.5 / (4.0 * kPi) * made[c] * kDepth / mu;
        }
      const StokesVector given = solution.reflected_transmittance({mu, azimuth}, 1e4);
      const double values[] = {given.i, given.q, given.u};
      for (std::size_t c = 0; c < 3; ++c)
        found = std::max(found, std::abs(values[c] - wanted[c]) / wanted[0]);
    }
    return found;
  };
  EXPECT_LT(worst(1.0), 2e-4);
  EXPECT_GT(worst(1.01), 6e-4);
}

}  // namespace test_ground_modes
