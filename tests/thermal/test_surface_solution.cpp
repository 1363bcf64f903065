#include <gtest/gtest.h>

#include "exchanges.h"
#include "outdoors.h"
#include "thermal/faces/time_table.h"
#include "thermal/linear_kernel.h"
#include "thermal/surface_solution.h"
#include "thermal/therm_slab.h"

namespace ifov::thermal::test_surface_solution {
namespace {

using test::june;

Solid road() { return {{{0.06, 0.75, 2360.0, 920.0}, {0.5, 0.30, 1600.0, 800.0}}, DeepGround{290.0}}; }

TEST(SurfaceBalance, FluxesOfATiltedSurface) {
  OutdoorsSeries series;
  Outdoors now;
  now.direct_w_m2 = 800.0;
  now.diffuse_w_m2 = 100.0;
  now.sun_azimuth_rad = std::numbers::pi;
  now.sun_elevation_rad = std::numbers::pi / 6.0;
  now.longwave_w_m2 = 300.0;
  now.air = {290.0, 1000.0, 101325.0};
  series.rows = {now, now};
  Skin skin;
  skin.solar_absorptance = 0.5;
  skin.emissivity = 0.9;
  skin.power_w_m2 = 7.0;
  Stand wall;
  wall.tilt_rad = 0.5 * std::numbers::pi;
  wall.azimuth_rad = std::numbers::pi;
  const SurfaceBalance balance(series, skin, wall, {0.25, 0.25});
  const Fluxes fluxes = balance.fluxes(10.0, 300.0);
  const double sigma = kStefanBoltzmann_w_m2_k4;
  EXPECT_NEAR(balance.full_sun_w_m2(0), 0.5 * 800.0 * std::cos(std::numbers::pi / 6.0), 1e-9);
  EXPECT_NEAR(fluxes.sun, 0.25 * balance.full_sun_w_m2(0), 1e-9);
  EXPECT_NEAR(fluxes.sky, 0.5 * 100.0 * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.reflected, 0.5 * 0.2 * (100.0 + 400.0) * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.sky_longwave, 0.9 * 300.0 * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.ground_longwave, 0.9 * sigma * std::pow(290.0, 4) * 0.5, 1e-9);
  EXPECT_NEAR(fluxes.emitted, -0.9 * sigma * std::pow(300.0, 4), 1e-9);
  EXPECT_NEAR(fluxes.convection, -natural_convection(10.0, 0.0).h_w_m2_k * 10.0, 0.01);
  EXPECT_EQ(fluxes.power, 7.0);
  const SurfaceGain gain = balance.gain(10.0, 300.0);
  EXPECT_NEAR(gain.w_m2, fluxes.sum(), 1e-9);
  EXPECT_NEAR(gain.slope_w_m2_k, (balance.gain(10.0, 300.01).w_m2 - balance.gain(10.0, 299.99).w_m2) / 0.02,
              1e-4);
}

/// An engine that runs for two hours, in still water of a sheet in the dark: C dT/dt = P(t) - losses, by steps of a second, and the mean over
/// rows of what the table says.
TEST(SurfaceSolution, PowerOverTimeAsItsTable) {
  OutdoorsSeries night = june(1.0);
  for (Outdoors& now : night.rows) now.direct_w_m2 = now.diffuse_w_m2 = 0.0;
  const double at_s = night.begin_s + 43200.0;
  TimeTable engine{{at_s, at_s + 1.0, at_s + 7200.0, at_s + 7201.0}, {0.0, 300.0, 300.0, 0.0}};
  EXPECT_NEAR(engine.mean(at_s - 10.0, at_s + 11.0), (0.5 + 10.0) * 300.0 / 21.0, 1e-9);
  EXPECT_NEAR(engine.mean(at_s + 100.0, at_s + 400.0), 300.0, 1e-9);
  EXPECT_NEAR(engine.mean(at_s + 7000.0, at_s + 8000.0), 200.5 * 300.0 / 1000.0, 1e-9);
  EXPECT_EQ(engine.mean(at_s - 900.0, at_s - 600.0), 0.0);
  const Solid hood{{{2e-3, 50.0, 7800.0, 450.0}}, Insulated{}};
  Skin skin;
  const SurfaceSolution cold = solve_surface(hood, skin, Stand{}, night);
  skin.power_over_time = std::make_shared<const TimeTable>(engine);
  const SurfaceSolution warm = solve_surface(hood, skin, Stand{}, night);
  double lumped_k = cold.surface_k(144);
  for (int i = 0; i < 10800; ++i) {
    const double power = i < 7200 ? 300.0 : 0.0;
    lumped_k += (power + cold.balance.gain(at_s + i, lumped_k).w_m2) / (2e-3 * 7800.0 * 450.0);
    if ((i + 1) % 1800 != 0 || i + 1 == 7200) continue;  // a row at a jump has half of it
    EXPECT_NEAR(warm.surface_k(144 + static_cast<std::size_t>(i + 1) / 300), lumped_k, 0.1) << i;
  }
  EXPECT_GT(warm.surface_k(144 + 24), cold.surface_k(144 + 24) + 10.0);
  // A fault: it ran two hours before.
  EXPECT_LT(cold.surface_k(144 + 24), warm.surface_k(144 + 24) - 5.0);
}

/// A hall that is heated in the morning warms its sheet metal wall in the dark: C dT/dt = gain + U (T_room(t) - T) by steps of a second. A table
/// that always says the same is the number.
TEST(SurfaceSolution, RoomOverTimeAsItsTable) {
  OutdoorsSeries night = june(1.0);
  for (Outdoors& now : night.rows) now.direct_w_m2 = now.diffuse_w_m2 = 0.0;
  const double at_s = night.begin_s + 43200.0;
  const auto heated = std::make_shared<const TimeTable>(
      TimeTable{{at_s, at_s + 3600.0, at_s + 10800.0}, {283.0, 303.0, 293.0}});
  const std::vector<SolidLayer> sheet{{2e-3, 50.0, 7800.0, 450.0}};
  const Skin skin;
  const SurfaceSolution wall = solve_surface({sheet, RoomAir{0.0, 7.7, heated}}, skin, Stand{}, night);
  double lumped_k = wall.surface_k(144);
  for (int i = 0; i < 10800; ++i) {
    lumped_k += (wall.balance.gain(at_s + i, lumped_k).w_m2 + 7.7 * (heated->at(at_s + i) - lumped_k)) /
                (2e-3 * 7800.0 * 450.0);
    if ((i + 1) % 1800 != 0) continue;
    EXPECT_NEAR(wall.surface_k(144 + static_cast<std::size_t>(i + 1) / 300), lumped_k, 0.03) << i;
  }
  EXPECT_GT(wall.surface_k(144 + 12), wall.surface_k(144) + 3.0);
  const auto same = std::make_shared<const TimeTable>(TimeTable{{at_s}, {293.15}});
  const SurfaceSolution told = solve_surface({sheet, RoomAir{0.0, 7.7, same}}, skin, Stand{}, night),
                        number = solve_surface({sheet, RoomAir{293.15, 7.7}}, skin, Stand{}, night);
  for (std::size_t row = 0; row < night.rows.size(); ++row)
    EXPECT_NEAR(told.surface_k(row), number.surface_k(row), 1e-7) << row;
}

TEST(SurfaceSolution, WhatIsHeldIsAsWarmAsTold) {
  const OutdoorsSeries series = june(1.0);
  const Solid any{{{1e-3, 50.0, 7800.0, 450.0}}, Insulated{}};
  Skin air, told, free;
  air.as_air = true;
  const double at_s = series.begin_s + 43200.0;
  told.held_k = std::make_shared<const TimeTable>(TimeTable{{at_s - 7200.0, at_s + 7200.0}, {290.0, 350.0}});
  const SurfaceSolution as_air = solve_surface(any, air, Stand{}, series),
                        as_told = solve_surface(any, told, Stand{}, series),
                        not_held = solve_surface(any, free, Stand{}, series);
  for (const std::size_t row : {20u, 100u, 144u, 200u, 288u})
    EXPECT_NEAR(as_air.surface_k(row), series.rows[row].air.temperature_k, 0.005) << row;
  EXPECT_NEAR(as_told.surface_k(100), 290.0, 0.005);
  EXPECT_NEAR(as_told.surface_k(144), 320.0, 0.01);
  EXPECT_NEAR(as_told.surface_k(156), 335.0, 0.01);
  EXPECT_NEAR(as_told.surface_k(288), 350.0, 0.005);
  EXPECT_GT(not_held.surface_k(144) - as_air.surface_k(144), 10.0);
  // What holds it is what is left of the balance, and the heat that it stores.
  const Fluxes now = as_told.balance.fluxes(series.begin_s + 200.0 * 300.0, as_told.surface_k(200));
  EXPECT_NEAR(now.sum(), 0.0, 1.0);
  EXPECT_GT(now.power, 100.0);
}

/// Snow under a warm June day: no warmer than 0 degrees, and what it gains there goes into melting, worked out by hand. What does not melt
/// gets warmer than that.
TEST(SurfaceSolution, MeltingSnowStaysAtItsMeltingPoint) {
  const OutdoorsSeries series = june(4.0);
  const Solid snow{{{0.3, 1.7, 800.0, 2090.0}}, Insulated{}};
  Skin skin;
  skin.solar_absorptance = 0.3;
  const auto hottest_k = [&](const SurfaceSolution& solution) {
    double most_k = 0.0;
    for (const SurfaceNode& node : solution.history.nodes) most_k = std::max(most_k, node.surface_k);
    return most_k;
  };
  EXPECT_GT(hottest_k(solve_surface(snow, skin, {}, series)), 290.0);
  skin.melts_k = 273.15;
  const SurfaceSolution solution = solve_surface(snow, skin, {}, series);
  EXPECT_LT(hottest_k(solution), 273.15 + 0.08);
  const std::size_t noon = series.rows.size() - 1 - 144;
  const double surface_k = solution.surface_k(noon);
  EXPECT_GT(surface_k, 273.15);
  const Fluxes fluxes =
      solution.balance.fluxes(series.begin_s + 300.0 * static_cast<double>(noon), surface_k);
  const Outdoors& now = series.rows[noon];
  const double taken = 0.3 * (now.direct_w_m2 * std::sin(now.sun_elevation_rad) + now.diffuse_w_m2) +
                       0.95 * (now.longwave_w_m2 - kStefanBoltzmann_w_m2_k4 * std::pow(surface_k, 4)) +
                       fluxes.convection;
  EXPECT_GT(taken, 200.0);
  // All of it melts: snow that is at 0 degrees throughout takes nothing.
  EXPECT_NEAR(-fluxes.latent, taken, 0.01 * taken);
  const History& history = solution.history;
  const double all_s = history.nodes.back().time_s - history.nodes.front().time_s;
  EXPECT_NEAR(solution.mean.sum() * all_s, history.out_of_back_j_m2 + history.stored_j_m2,
              1e-6 * solution.mean.sun * all_s);
}

/// A wall at 100 degrees from a wind of 4 m/s is half of the time to windward: 3.26 * 4^0.89 and 3.55 * 4^0.617, W m-2 K-1; glass
/// as warm as the air but for a hair.
TEST(SurfaceBalance, WindOfAWallAtItsEdge) {
  OutdoorsSeries series;
  Outdoors now;
  now.air = {290.0, 1000.0, 101325.0};
  now.wind_m_s = 4.0;
  now.wind_from_rad = 0.4;
  series.rows = {now, now};
  Skin glass;
  glass.roughness = Roughness::very_smooth;
  Stand wall;
  wall.tilt_rad = 0.5 * std::numbers::pi;
  wall.height_m = 10.0;
  const auto forced = [&](double off_deg) {
    wall.azimuth_rad = now.wind_from_rad + off_deg * std::numbers::pi / 180.0;
    return -SurfaceBalance(series, glass, wall).fluxes(10.0, 290.0001).convection / 1e-4;
  };
  EXPECT_NEAR(forced(100.0), 0.5 * (3.26 * 3.4344 + 3.55 * 2.3522), 0.01);
  EXPECT_NEAR(forced(0.0), 3.26 * 3.4344, 0.01);
  EXPECT_NEAR(forced(180.0), 3.55 * 2.3522, 0.01);
}

TEST(SurfaceSolution, EnergyOfASpunUpDay) {
  Skin wet;
  wet.wetness = {0.4, 70.0};
  for (const Skin& skin : {Skin{}, wet}) {
    const OutdoorsSeries series = june(4.0);
    const SurfaceSolution solution = solve_surface(road(), skin, {}, series);
    const History& history = solution.history;
    const Fluxes& mean = solution.mean;
    const double all_s = history.nodes.back().time_s - history.nodes.front().time_s;
    const double in = mean.sun + mean.sky + mean.sky_longwave;
    const double out = -(mean.emitted + mean.convection + mean.latent) + history.out_of_back_j_m2 / all_s;
    EXPECT_LT(std::abs(in - out - history.stored_j_m2 / all_s), 1e-6 * in);
    EXPECT_GT(in, 400.0);
  }
}

TEST(SurfaceSolution, StepsOfFiveAndFifteenMinutesAgreeWithFineOnes) {
  const SurfaceSolution fine = solve_surface(road(), {}, {}, june(4.0, 20.0));
  for (const double step_s : {300.0, 900.0}) {
    const SurfaceSolution coarse = solve_surface(road(), {}, {}, june(4.0, step_s));
    double worst = 0.0;
    const int a_day = static_cast<int>(86400.0 / step_s);
    for (int i = 3 * a_day; i <= 4 * a_day; ++i)
      worst = std::max(worst,
                       std::abs(coarse.surface_k(i) - fine.surface_k(i * static_cast<int>(step_s / 20.0))));
    EXPECT_LT(worst, step_s > 300.0 ? 0.1 : 0.02);
  }
}

TEST(SurfaceSolution, HistoryOfTheWrongDayIsNoticed) {
  // Yesterday was overcast: 24 hours on, the surface still knows it by a third of a kelvin.
  OutdoorsSeries cloudy = june(4.0);
  for (std::size_t i = 576; i < 864; ++i) cloudy.rows[i].direct_w_m2 = 0.0;
  const double clear_k = solve_surface(road(), {}, {}, june(4.0)).surface_k(1152);
  EXPECT_GT(clear_k - solve_surface(road(), {}, {}, cloudy).surface_k(1152), 0.25);
}

TEST(SurfaceSolution, GrassIsCoolerThanAsphaltInTheSun) {
  Skin grass;
  grass.wetness = {1.0, 70.0};
  grass.roughness = Roughness::very_rough;
  const OutdoorsSeries series = june(3.0);
  const double lawn = solve_surface(road(), grass, {}, series).surface_k(720);
  const double asphalt = solve_surface(road(), {}, {}, series).surface_k(720);
  EXPECT_GT(asphalt - lawn, 10.0);
  EXPECT_LT(std::abs(lawn - series.rows[720].air.temperature_k), 10.0);
}

/// The sunlit day with the Sun let in, or kept out, for a while is the kernel's sum over what was absorbed more.
TEST(LinearKernel, IsTheDifferenceOfFullSolutions) {
  const OutdoorsSeries series = june(3.0);
  const std::size_t now = 2 * 288 + 180;  // 15 h of the third day
  Skin skin;
  const SurfaceSolution sunlit = solve_surface(road(), skin, {}, series);
  const std::vector<double> kernel = linear_kernel(sunlit.cells, sunlit.history, sunlit.node_of_row(now));
  const auto compare = [&](std::size_t from, std::size_t to, double visibility) {
    std::vector<double> seen(series.rows.size(), 1.0);
    for (std::size_t i = from; i < to; ++i) seen[i] = visibility;
    double expected = 0.0;
    for (std::size_t i = from; i < to; ++i)
      expected += kernel[sunlit.node_of_row(i)] * sunlit.balance.full_sun_w_m2(i) * (visibility - 1.0);
    const double full =
        solve_surface(road(), skin, {}, series, Start::steady, seen).surface_k(now) - sunlit.surface_k(now);
    return std::pair(full, expected);
  };
  // To first order: a thousandth of the Sun, of a minute ago and of yesterday.
  for (const auto& [from, to] :
       {std::pair<std::size_t, std::size_t>{now, now + 1}, {now - 12, now}, {now - 288, now - 240}}) {
    const auto [full, expected] = compare(from, to, 0.999);
    EXPECT_NEAR(full / expected, 1.0, 2e-3) << from;
    EXPECT_LT(full, 0.0);
  }
  // All of the Sun for half an hour: what is left over is the bend, and small.
  const auto [full, expected] = compare(now - 6, now, 0.0);
  EXPECT_GT(std::abs(full), 3.0);
  EXPECT_NEAR(full, expected, 0.05 * std::abs(full));
  // A fault: the kernel of an hour earlier.
  const std::vector<double> earlier =
      linear_kernel(sunlit.cells, sunlit.history, sunlit.node_of_row(now - 12));
  EXPECT_GT(std::abs(earlier[sunlit.node_of_row(now - 18)] / kernel[sunlit.node_of_row(now - 18)] - 1.0),
            0.2);
}

/// Four millimetres of peat on clay forget within a minute or two, steps are of five and fifteen: what is left of a pulse fades, and does not
/// swing about nothing as Crank-Nicolson steps let it.
TEST(LinearKernel, FadesUnderAThinLayer) {
  const Solid lawn{{{0.004, 0.06, 100.0, 1900.0}, {1.0, 1.58, 2000.0, 1550.0}}, DeepGround{285.0}};
  for (const double step_s : {300.0, 900.0}) {
    const SurfaceSolution solution = solve_surface(lawn, {}, {}, june(1.5, step_s));
    const std::vector<double> kernel = kernel_by_row(solution);
    double largest = 0.0;
    for (const double value : kernel) largest = std::max(largest, value);
    for (std::size_t back = 1; back < 12; ++back)
      EXPECT_GT(kernel[kernel.size() - 1 - back], -1e-3 * largest) << step_s << " " << back;
  }
}

TEST(LinearKernel, SumsToTheSteadyAnswer) {
  // A constant gain for a long time: 1 / (h + resistance^-1), whatever the steps were.
  const Cells cells = cut_into_cells({{test::concrete(0.1)}, HeldBack{300.0}});
  const test::LinearExchange exchange([](double) { return 0.0; }, 10.0, 300.0);
  const History history =
      conduct(cells, std::vector<double>(cells.depth_m.size(), 300.0), exchange, {0.0, 900.0, 960});
  double sum = 0.0;
  for (const double value : linear_kernel(cells, history, history.nodes.size() - 1)) sum += value;
  EXPECT_NEAR(sum, 1.0 / (10.0 + 1.4 / 0.1), 1e-8);
}

/// THERM's case, integrated by hand: 50 slices, explicit steps of a quarter of a second.
TEST(ThermSlab, AsTheSameNumbersByHand) {
  ThermSlab slab;
  slab.density_kg_m3 = 2000.0;
  slab.specific_heat_j_kg_k = 900.0;
  slab.conductivity_w_m_k = 1.0;
  slab.thickness_m = 0.05;
  slab.solar_absorption = 0.7;
  slab.emissivity = 0.9;
  slab.exposed_area = 0.75;
  const OutdoorsSeries series = june(1.0, 300.0);
  const SurfaceSolution solution = solve_surface(solid_of(slab), skin_of(slab), {}, series, Start::air);

  constexpr int kSlices = 50;
  constexpr double kSlice_m = 0.05 / kSlices, kStep_s = 0.25;
  std::vector<double> t(kSlices, series.rows[0].air.temperature_k), flux(kSlices + 1, 0.0);
  double worst = 0.0, surface_k = t[0];
  for (std::size_t row = 0; row + 1 < series.rows.size(); ++row) {
    if (row >= 12) worst = std::max(worst, std::abs(surface_k - solution.surface_k(row)));
    for (int k = 0; k < static_cast<int>(300.0 / kStep_s); ++k) {
      const double share = k * kStep_s / 300.0;
      const Outdoors &a = series.rows[row], &b = series.rows[row + 1];
      const auto mixed = [&](double x, double y) { return x + share * (y - x); };
      const auto level = [](const Outdoors& now) {
        return now.direct_w_m2 * std::max(0.0, std::sin(now.sun_elevation_rad));
      };
      const double air_k = mixed(a.air.temperature_k, b.air.temperature_k);
      const double wind = mixed(a.wind_m_s, b.wind_m_s) * std::log(2.0 / 0.03) / std::log(10.0 / 0.03);
      const double sun = 0.7 * (mixed(level(a), level(b)) + mixed(a.diffuse_w_m2, b.diffuse_w_m2));
      const double longwave = 0.9 * mixed(a.longwave_w_m2, b.longwave_w_m2);
      const double warmer = surface_k - air_k;
      const double natural = warmer > 0.0 ? 1.52 * std::cbrt(warmer) : 0.76 * std::cbrt(-warmer);
      const double glass = std::sqrt(natural * natural + std::pow(3.26 * std::pow(wind, 0.89), 2));
      const double h = natural + 1.11 * (glass - natural);
      const double gain = sun + longwave - 0.9 * 5.670374419e-8 * std::pow(surface_k, 4) - 1.5 * h * warmer;
      surface_k += (gain - 2.0 / kSlice_m * (surface_k - t[0])) / (2.0 / kSlice_m + 6.0 + 1.5 * h);
      flux[0] = 2.0 / kSlice_m * (surface_k - t[0]);
      for (int i = 1; i < kSlices; ++i) flux[i] = (t[i - 1] - t[i]) / kSlice_m;
      for (int i = 0; i < kSlices; ++i)
        t[i] += kStep_s * (flux[i] - flux[i + 1]) / (2000.0 * 900.0 * kSlice_m);
    }
  }
  EXPECT_LT(worst, 0.05);
  // A fault: one face where three quarters of both are in the air.
  slab.exposed_area = 0.5;
  const SurfaceSolution other = solve_surface(solid_of(slab), skin_of(slab), {}, series, Start::air);
  EXPECT_GT(std::abs(other.surface_k(144) - solution.surface_k(144)), 1.0);
}

}  // namespace
}  // namespace ifov::thermal::test_surface_solution
