#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atmosphere/scattering/column_solver.h"
#include "column_maker.h"

namespace ifov::atmosphere::test_thick_columns {
namespace {

/// A cloud of flat layers that are thin at both sides, where light changes fast.
test::Column cloud(double depth, double albedo, double asymmetry) {
  std::vector<double> edges{0.0};
  std::vector<double> from_side;
  for (double step = 0.25, at = step; at < 0.5 * depth; step *= 2.0, at += step)
    from_side.push_back(at / depth);
  edges.insert(edges.end(), from_side.begin(), from_side.end());
  for (std::size_t k = from_side.size(); k-- > 0;) edges.push_back(1.0 - from_side[k]);
  edges.push_back(1.0);
  test::Column column;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const double part = depth * (edges[k] - edges[k - 1]);
    column.add_layer(edges[k], 0.0, albedo * part, asymmetry, 0.0, (1.0 - albedo) * part);
  }
  return column;
}

struct Shares {
  double up, diffuse, direct;
};
Shares shares(const test::Column& column, double sun_mu) {
  ScatteringOptions options = test::flat(8, 0.01, false);
  options.most_sublayers = 24;
  const FluxProfile fluxes =
      ColumnSolver(options).solve(column.levels, column.optics, std::acos(sun_mu)).sunlit().fluxes();
  return {fluxes.up.front() / sun_mu, fluxes.diffuse_down.back() / sun_mu,
          fluxes.direct_down.back() / sun_mu};
}

}  // namespace

// Van de Hulst (1980), Multiple Light Scattering, table 37 (g = 0.75, no absorption, light straight down), with the digits of
// DISORT's test 3 (Stamnes et al. 1988), which is checked against it. Incident flux is pi there.
TEST(ThickColumns, ReflectAndTransmitAsVanDeHulstSays) {
  constexpr double kPi = 3.14159265358979;
  const Shares thin = shares(cloud(1.0, 1.0, 0.75), 1.0), thick = shares(cloud(8.0, 1.0, 0.75), 1.0);
  EXPECT_NEAR(thin.up / (0.247374 / kPi), 1.0, 1e-3);
  EXPECT_NEAR(thin.diffuse / (1.73849 / kPi), 1.0, 1e-3);
  EXPECT_NEAR(thick.up / (1.59096 / kPi), 1.0, 1e-3);
  EXPECT_NEAR(thick.diffuse / (1.54958 / kPi), 1.0, 1e-3);
  EXPECT_NEAR(thick.direct / (1.05389e-3 / kPi), 1.0, 1e-4);
  EXPECT_GT(std::abs(shares(cloud(8.0, 1.0, 0.7425), 1.0).up / (1.59096 / kPi) - 1.0), 5e-3)
      << "g 1 % less passes";
}

// Without absorption all light goes somewhere, and what a thick layer lets through of diffuse light is
// 1 / (3/4 (1 - g) t + 1.07) (van de Hulst 1980, ch. 5; the asymptotic form for thick layers).
TEST(ThickColumns, LoseNoLight) {
  for (const double depth : {10.0, 50.0}) {
    const test::Column column = cloud(depth, 1.0, 0.85);
    const Shares found = shares(column, 0.5);
    EXPECT_NEAR(found.up + found.diffuse + found.direct, 1.0, 1.5e-3) << depth;
    ScatteringOptions options = test::flat(8, 0.01, false);
    options.most_sublayers = 24;
    const double sent_back =
        ColumnSolver(options).solve(column.levels, column.optics, 1.0).spherical_albedo();
    EXPECT_NEAR((1.0 - sent_back) * (0.75 * 0.15 * depth + 1.07), 1.0, 0.02) << depth;
  }
}

}  // namespace ifov::atmosphere::test_thick_columns
