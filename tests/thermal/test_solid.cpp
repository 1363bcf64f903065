#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "exchanges.h"
#include "thermal/cells.h"
#include "thermal/conduction.h"
#include "thermal/faces/air_gap.h"
#include "thermal/solid.h"
#include "thermal/tridiagonal.h"

namespace ifov::thermal::test_solid {
namespace {

std::string message(const Solid& solid) {
  try {
    check(solid);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Solid, SaysWhichLayerIsWrong) {
  const SolidLayer good = test::concrete(0.1);
  EXPECT_EQ(message({{good}, Insulated{}}), "");
  EXPECT_EQ(message({{}, Insulated{}}), "expected at least one layer, found none");
  SolidLayer thin = good, hard = good;
  thin.thickness_m = 5e-6;
  hard.conductivity_w_m_k = 0.0;
  EXPECT_EQ(message({{good, thin}, Insulated{}}), "layer 2: it is 5 um thick, expected at least 10 um");
  EXPECT_EQ(message({{hard}, Insulated{}}),
            "layer 1: conductivity is 0 W m-1 K-1, expected a number above 0");
}

TEST(Solid, AirBehindItLeadsSomewhere) {
  SolidLayer last = test::concrete(0.1);
  last.gap_behind_m2_k_w = 0.18;
  EXPECT_EQ(message({{last, test::concrete(0.1)}, Insulated{}}), "");
  EXPECT_EQ(message({{last}, RoomAir{293.0, 8.0}}), "");
  EXPECT_EQ(message({{last}, Insulated{}}),
            "the last layer has air behind it and then nothing that heat passes to");
  EXPECT_EQ(message({{last}, DeepGround{285.0}}), "the last layer goes on as ground, and has air behind it");
  last.gap_behind_m2_k_w = -0.1;
  EXPECT_EQ(message({{last}, RoomAir{293.0, 8.0}}),
            "layer 1: the resistance behind it is -0.1 m2 K W-1, expected 0 or above");
}

// ISO 6946, table of unventilated air layers between faces of high emissivity, m2 K W-1, told to two digits.
TEST(AirGap, AsIsoHasIt) {
  struct Row {
    double mm, up, horizontal, down;
  };
  const std::vector<Row> table{{5, 0.11, 0.11, 0.11},   {7, 0.13, 0.13, 0.13},  {10, 0.15, 0.15, 0.15},
                               {15, 0.16, 0.17, 0.17},  {25, 0.16, 0.18, 0.19}, {50, 0.16, 0.18, 0.21},
                               {100, 0.16, 0.18, 0.22}, {300, 0.16, 0.18, 0.23}};
  const auto resistance = [](double mm, HeatFlow flow, double emissivity = 0.9) {
    return resistance_m2_k_w({1e-3 * mm, emissivity, emissivity, flow});
  };
  for (const Row& row : table) {
    EXPECT_NEAR(resistance(row.mm, HeatFlow::up), row.up, 0.005) << row.mm;
    EXPECT_NEAR(resistance(row.mm, HeatFlow::horizontal), row.horizontal, 0.005) << row.mm;
    EXPECT_NEAR(resistance(row.mm, HeatFlow::down), row.down, 0.005) << row.mm;
  }
  // Faults: heat that goes down taken to go up; black faces. The table tells.
  EXPECT_GT(std::abs(resistance(100, HeatFlow::up) - 0.22), 0.05);
  EXPECT_GT(std::abs(resistance(25, HeatFlow::horizontal, 1.0) - 0.18), 0.015);
  // Between bright foils hardly anything is radiated.
  EXPECT_NEAR(resistance(25, HeatFlow::horizontal, 0.03), 1.0 / 1.25, 0.06);
}

// Two digits would not tell 1 % from nothing: ISO's coefficients by hand, with h_r0 = 5.149 W m-2 K-1 of black faces at 10 degrees Celsius
// (Stefan-Boltzmann) and 0.8182 of it between faces of 0.9.
TEST(AirGap, AsIsosCoefficientsMakeIt) {
  constexpr double kRadiation = 0.8182 * 5.149;
  const auto resistance = [](double metres, HeatFlow flow) {
    return resistance_m2_k_w({metres, 0.9, 0.9, flow});
  };
  EXPECT_NEAR(resistance(0.005, HeatFlow::up), 1.0 / (5.0 + kRadiation), 2e-5);
  EXPECT_NEAR(resistance(0.05, HeatFlow::up), 1.0 / (1.95 + kRadiation), 2e-5);
  EXPECT_NEAR(resistance(0.05, HeatFlow::horizontal), 1.0 / (1.25 + kRadiation), 2e-5);
  EXPECT_NEAR(resistance(0.3, HeatFlow::down), 1.0 / (0.2038 + kRadiation), 2e-5);
}

TEST(Solid, DepthAndInertiaOfConcrete) {
  EXPECT_NEAR(daily_depth_m(test::concrete(1.0)), 0.138, 5e-4);
  EXPECT_NEAR(thermal_inertia(test::concrete(1.0)), 1683.33, 0.01);
}

TEST(Cells, HoldTheWholeSolid) {
  const Solid solid{{test::concrete(0.1), {0.02, 0.04, 50.0, 1000.0}}, RoomAir{293.0, 8.0}};
  for (const int parts : {1, 4}) {
    const Cells cells = cut_into_cells(solid, {1.0 / 60.0, 1.15, parts});
    EXPECT_NEAR(std::accumulate(cells.capacity_j_m2_k.begin(), cells.capacity_j_m2_k.end(), 0.0),
                0.1 * 2300.0 * 880.0 + 0.02 * 50.0 * 1000.0, 1e-6);
    double resistance = 1.0 / cells.back_conductance_w_m2_k;
    for (const double conductance : cells.conductance_w_m2_k) resistance += 1.0 / conductance;
    EXPECT_NEAR(resistance, 0.1 / 1.4 + 0.02 / 0.04 + 1.0 / 8.0, 1e-12);
    Solid airy = solid;
    airy.layers[0].gap_behind_m2_k_w = 0.18;
    airy.layers[1].gap_behind_m2_k_w = 0.16;
    EXPECT_NEAR(1.0 / whole_conductance_w_m2_k(cut_into_cells(airy)), resistance + 0.34, 1e-12);
  }
}

TEST(Tridiagonal, SolvesWithALossInPlaceOfTheSurface) {
  const Cells cells = cut_into_cells({{test::concrete(0.1)}, HeldBack{0.0}});
  const Tridiagonal matrix(cells, 300.0);
  const std::size_t count = cells.depth_m.size();
  std::vector<double> x(count, 0.0), p;
  x[2] = 1.0;
  const std::vector<double> right = x;
  const double loss = 7.0;
  matrix.solve_with_loss(loss, x, p);
  for (std::size_t i = 0; i < count; ++i) {
    const double above = i > 0 ? cells.conductance_w_m2_k[i] * (x[i] - x[i - 1]) : loss * x[0];
    const double below = i + 1 < count ? cells.conductance_w_m2_k[i + 1] * (x[i] - x[i + 1])
                                       : cells.back_conductance_w_m2_k * x[i];
    EXPECT_NEAR(cells.capacity_j_m2_k[i] * x[i] + 300.0 * (above + below), right[i], 1e-12);
  }
}

}  // namespace
}  // namespace ifov::thermal::test_solid
