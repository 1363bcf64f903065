#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "outdoors.h"
#include "thermal/linear_kernel.h"
#include "thermal/solid.h"
#include "thermal/surface_classes.h"
#include "thermal/wind_levels.h"

namespace ifov::thermal::test_surface_classes {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Solid road() { return {{{0.06, 0.75, 2360.0, 920.0}, {0.5, 0.30, 1600.0, 800.0}}, DeepGround{290.0}}; }

math::Vec3 facing(double tilt_deg, double azimuth_deg) {
  const double tilt = tilt_deg * kDegree, azimuth = azimuth_deg * kDegree;
  return {std::sin(tilt) * std::sin(azimuth), std::sin(tilt) * std::cos(azimuth), std::cos(tilt)};
}

/// Ends at two in the afternoon, when what the Sun did counts most.
OutdoorsSeries afternoon() {
  OutdoorsSeries series = test::june(4.0);
  series.rows.resize(series.rows.size() - 120);
  return series;
}

double full_k(const Solid& solid, const OutdoorsSeries& series, double tilt_deg, double azimuth_deg,
              double free_sky, const std::vector<double>& visibility) {
  Stand stand;
  stand.tilt_rad = tilt_deg * kDegree;
  stand.azimuth_rad = azimuth_deg * kDegree;
  stand.free_sky = free_sky;
  return solve_surface(solid, {}, stand, series, Start::steady, visibility).history.nodes.back().surface_k;
}

double class_k(const SurfaceClasses& classes, const Pose& pose, double free_sky,
               const std::vector<double>& visibility) {
  std::vector<double> weight_k(classes.sunlit_rows());
  const double shaded_k = classes.shaded(pose, free_sky, weight_k).kelvin;
  std::vector<double> per_pair(weight_k.size()), sum_k_to(weight_k.size());
  std::partial_sum(weight_k.begin(), weight_k.end(), sum_k_to.begin());
  classes.bends(pose, sum_k_to, per_pair);
  const auto seen = [&](std::size_t k) { return visibility[classes.row_of_series(k)]; };
  double sum_k = shaded_k;
  for (std::size_t k = 0; k < weight_k.size(); ++k) {
    sum_k += weight_k[k] * seen(k);
    for (std::size_t j = 0; j < weight_k.size(); ++j)
      sum_k -= 0.5 * per_pair[std::max(j, k)] * weight_k[j] * weight_k[k] * seen(j) * (1.0 - seen(k));
  }
  return sum_k;
}

TEST(SurfaceClasses, AreTheWholeSolutionInFullSunAndInTheShade) {
  const OutdoorsSeries series = afternoon();
  const Solid solid = road();
  const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series), {solid, Skin{}, Stand{}}, 0);
  for (const double visible : {0.0, 1.0})
    for (const double tilt : {0.0, 45.0, 90.0})
      for (const double free_sky : {0.0, 1.0}) {
        const std::vector<double> visibility(series.rows.size(), visible);
        EXPECT_NEAR(class_k(classes, facing(tilt, 180.0), free_sky, visibility),
                    full_k(solid, series, tilt, 180.0, free_sky, visibility), 0.002)
            << tilt << " " << free_sky << " " << visible;
      }
}

/// Against the whole solution with as much more and as much less from inside, throughout: by what the square of a gain is worth less. In
/// still air convection bends, and evaporation where it is wet; in wind hardly anything but emission does.
TEST(SurfaceClasses, GainsBendAsTheWholeSolutionDoes) {
  constexpr double kGain_w_m2 = 60.0;
  const auto near = [](double bend) { return 0.5 * bend + 0.0007; };
  std::vector<double> bends;
  for (const double wind_m_s : {0.1, 8.0})
    for (const double wet : {0.0, 0.6}) {
      OutdoorsSeries series = afternoon();
      for (Outdoors& now : series.rows) now.wind_m_s = wind_m_s;
      const Solid sheet{{{0.004, 0.2, 1000.0, 1500.0}}, Insulated{}};
      Skin skin;
      skin.wetness = {wet, 70.0};
      const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series),
                                   {sheet, skin, Stand{}, Start::steady}, 0, false, 0.0, true);
      // About halfway between the histories that classes know.
      double worth_k = 0.0, bent_k = 0.0;
      for (const double visible : {0.4, 0.8})
        for (const double free_sky : {0.0, 1.0}) {
          const auto at_k = [&](double power_w_m2) {
            Skin warmed = skin;
            warmed.power_w_m2 = power_w_m2;
            Stand stand;
            stand.free_sky = free_sky;
            return solve_surface(sheet, warmed, stand, series, Start::steady,
                                 std::vector<double>(series.rows.size(), visible))
                .history.nodes.back()
                .surface_k;
          };
          const double more_k = at_k(kGain_w_m2), same_k = at_k(0.0), less_k = at_k(-kGain_w_m2);
          worth_k += 0.25 * (more_k - less_k) / (2.0 * kGain_w_m2);
          bent_k += 0.25 * (more_k - 2.0 * same_k + less_k) / (2.0 * kGain_w_m2 * kGain_w_m2);
        }
      const double bend = -bent_k / (worth_k * worth_k);
      const SurfaceClasses::Corners at = classes.corners(facing(0.0, 0.0));
      EXPECT_NEAR(classes.bend_of_gain(at), bend, near(bend)) << wind_m_s << " " << wet;
      bends.push_back(bend);
    }
  // No one number is that near to all of them.
  const auto [least, most] = std::minmax_element(bends.begin(), bends.end());
  EXPECT_GT(*most - near(*most), *least + near(*least));
}

/// The kernel of a row holds what its gain does by way of the mean that the solution begins with.
TEST(SurfaceClasses, KernelsKnowHowTheSolutionBegan) {
  const OutdoorsSeries series = afternoon();
  const Solid solid = road();
  const auto solved = [&](double first_day) {
    std::vector<double> visibility(series.rows.size(), 1.0);
    std::fill_n(visibility.begin(), 288, first_day);
    return solve_surface(solid, {}, Stand{}, series, Start::steady, visibility);
  };
  const SurfaceSolution solution = solved(1.0);
  const std::vector<double> kernel = kernel_by_row(solution),
                            without = linear_kernel(solution.cells, solution.history,
                                                    solution.history.nodes.size() - 1);
  double foretold_k = 0.0, without_k = 0.0;
  for (std::size_t row = 0; row < 288; ++row) {
    foretold_k -= 0.02 * kernel[row] * solution.balance.full_sun_w_m2(row);
    if (row > 0) without_k -= 0.02 * without[solution.node_of_row(row)] * solution.balance.full_sun_w_m2(row);
  }
  const double changed_k =
      solved(0.98).history.nodes.back().surface_k - solution.history.nodes.back().surface_k;
  EXPECT_NEAR(foretold_k / changed_k, 1.0, 0.01);
  EXPECT_LT(without_k / changed_k, 0.9);
}

TEST(SurfaceClasses, BetweenDirectionsSharesOfTheSkyAndHoursOfSun) {
  const OutdoorsSeries series = afternoon();
  const Solid solid = road();
  const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series), {solid, Skin{}, Stand{}}, 0);
  double squares = 0.0, worst = 0.0, most = 0.0;
  int count = 0;
  for (const auto& [tilt, azimuth] : {std::pair{0.0, 0.0}, {22.0, 200.0}, {52.0, 160.0}, {83.0, 250.0}})
    for (const double free_sky : {0.35, 0.8})
      for (const int hours : {2, 5, 9}) {
        std::vector<double> visibility(series.rows.size());
        for (std::size_t i = 0; i < visibility.size(); ++i)
          visibility[i] = (static_cast<int>(i) / (12 * hours)) % 2 == 0 ? 1.0 : 0.0;
        const double off_k = class_k(classes, facing(tilt, azimuth), free_sky, visibility) -
                             full_k(solid, series, tilt, azimuth, free_sky, visibility);
        squares += off_k * off_k;
        worst = std::max(worst, std::abs(off_k));
        most = std::max(most, std::abs(class_k(classes, facing(tilt, azimuth), 1.0, visibility) -
                                       class_k(classes, facing(tilt, azimuth), free_sky, visibility)));
        ++count;
      }
  EXPECT_LT(std::sqrt(squares / count), 0.2);
  EXPECT_LT(worst, 0.5);
  EXPECT_GT(most, 1.0);  // a share of the sky that is not looked at would be noticed
}

/// A lawn's skin on its soil has forgotten within minutes, and what it loses by the air and by vapour bends sharply where it is as warm as the
/// air: edges of shadows that move, half of the Sun. It is 14 K from shade to Sun.
TEST(SurfaceClasses, OfAThinWetLawnHalfInTheSun) {
  OutdoorsSeries series = test::june(2.0, 600.0);
  series.rows.resize(series.rows.size() - 72);
  const Solid solid{{{0.004, 0.06, 100.0, 1900.0}, {1.0, 1.58, 2000.0, 1550.0}}, DeepGround{290.0}};
  Skin skin;
  skin.roughness = Roughness::very_rough;
  skin.wetness = {1.0, 70.0};
  const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series), {solid, skin, Stand{}}, 0);
  const auto off_k = [&](const std::vector<double>& visibility) {
    const double full_k =
        solve_surface(solid, skin, {}, series, Start::steady, visibility).history.nodes.back().surface_k;
    return class_k(classes, facing(0.0, 0.0), 1.0, visibility) - full_k;
  };
  const std::size_t count = series.rows.size();
  for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9})
    EXPECT_NEAR(off_k(std::vector<double>(count, share)), 0.0, 0.25) << share;
  for (const double last : {0.0, 1.0})
    for (const std::size_t rows : {1, 2, 4, 8, 16}) {
      std::vector<double> visibility(count, 1.0 - last);
      std::fill(visibility.end() - static_cast<std::ptrdiff_t>(rows), visibility.end(), last);
      EXPECT_NEAR(off_k(visibility), 0.0, 0.25) << rows << " rows at " << last;
    }
  std::vector<double> never(count, 0.0), always(count, 1.0);
  EXPECT_GT(class_k(classes, facing(0.0, 0.0), 1.0, always) - class_k(classes, facing(0.0, 0.0), 1.0, never),
            8.0);
}

/// Between levels of the wind: each height against the whole solution there. Twenty metres up a sunlit surface is cooler than at the
/// ground; a class that did not know would be noticed.
TEST(SurfaceClasses, HigherUpTheWindTakesMore) {
  const OutdoorsSeries series = afternoon();
  const Solid solid = road();
  for (const Terrain terrain : {Terrain::open, Terrain::suburb}) {
    Stand stand;
    stand.terrain = terrain;
    const ClassSurface surface{solid, Skin{}, stand};
    const auto shared = std::make_shared<const OutdoorsSeries>(series);
    const SurfaceClasses classes(shared, surface, 0, false, 80.0), low(shared, surface, 0);
    const auto full = [&](double height_m, double tilt_deg, const std::vector<double>& visibility) {
      Stand here = stand;
      here.height_m = height_m;
      here.tilt_rad = tilt_deg * kDegree;
      here.azimuth_rad = 200.0 * kDegree;
      return solve_surface(solid, {}, here, series, Start::steady, visibility).history.nodes.back().surface_k;
    };
    double least_drop_k = INFINITY;
    for (const double tilt : {0.0, 30.0, 90.0})
      for (const int hours : {3, 24 * 4}) {
        std::vector<double> visibility(series.rows.size());
        for (std::size_t i = 0; i < visibility.size(); ++i)
          visibility[i] = (static_cast<int>(i) / (12 * hours)) % 2 == 0 ? 1.0 : 0.0;
        const math::Vec3 normal = facing(tilt, 200.0);
        for (const double height_m : {3.0, 6.0, 11.0, 20.0, 45.0, 75.0})
          EXPECT_NEAR(class_k(classes, {normal, height_m}, 1.0, visibility), full(height_m, tilt, visibility),
                      0.15)
              << tilt << " " << height_m << " " << hours;
        // As low as the lowest wind nothing has changed, to the last bit.
        EXPECT_EQ(class_k(classes, {normal, 1.9}, 0.6, visibility), class_k(low, normal, 0.6, visibility));
        if (hours > 24)
          least_drop_k = std::min(least_drop_k, class_k(low, {normal, 20.0}, 1.0, visibility) -
                                                    class_k(classes, {normal, 20.0}, 1.0, visibility));
      }
    EXPECT_GT(least_drop_k, terrain == Terrain::open ? 1.0 : 3.0);
    // What one level alone is off by between: halfway to the next it is much more than what is left.
    const WindLevels levels(terrain);
    const double between_m = std::sqrt(levels.height_m(1) * 2.0);
    const std::vector<double> sunlit(series.rows.size(), 1.0);
    EXPECT_NEAR(class_k(classes, {{0.0, 0.0, 1.0}, between_m}, 1.0, sunlit), full(between_m, 0.0, sunlit),
                0.03);
    EXPECT_GT(class_k(low, {{0.0, 0.0, 1.0}, between_m}, 1.0, sunlit) - full(between_m, 0.0, sunlit), 0.2);
  }
}

/// At the ends of days and at noon, of thin steel, which follows the Sun, and of a road.
TEST(SurfaceClasses, TellWhatIsColdestAndHottestOfAllDirections) {
  const Solid steel{{{0.001, 45.0, 7800.0, 490.0}}, Insulated{}};
  int beyond_ten_directions = 0;
  for (const Solid& solid : {road(), steel})
    for (const double hours : {2.0, 7.0, 12.0, 15.0, 18.5, 23.0}) {
      OutdoorsSeries series = test::june(2.0, 900.0);
      series.rows.resize(series.rows.size() -
                         static_cast<std::size_t>((24.0 - hours) * 3600.0 / series.step_s));
      for (Outdoors& now : series.rows) now.wind_from_rad = 0.4;
      const SurfaceClasses classes(std::make_shared<const OutdoorsSeries>(series), {solid, Skin{}, Stand{}},
                                   0);
      double coldest_k = INFINITY, hottest_k = 0.0, coldest_of_ten_k = INFINITY, hottest_of_ten_k = 0.0;
      std::vector<double> weight_k(classes.sunlit_rows());
      for (double tilt = 0.0; tilt <= 180.0; tilt += 7.5)
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0)
          for (const double free_sky : {0.0, 1.0}) {
            const double shaded_k = classes.shaded(facing(tilt, azimuth), free_sky, weight_k).kelvin;
            const double sunlit_k = std::accumulate(weight_k.begin(), weight_k.end(), shaded_k);
            coldest_k = std::min(coldest_k, shaded_k);
            hottest_k = std::max(hottest_k, sunlit_k);
            if (std::fmod(tilt, 45.0) == 0.0 && std::fmod(azimuth, 90.0) == 0.0) {
              coldest_of_ten_k = std::min(coldest_of_ten_k, shaded_k);
              hottest_of_ten_k = std::max(hottest_of_ten_k, sunlit_k);
            }
          }
      EXPECT_LE(classes.coldest_k(), coldest_k) << hours;
      EXPECT_GE(classes.hottest_k(), hottest_k) << hours;
      // A bound that is of no use would hold, too.
      EXPECT_LT(coldest_k - classes.coldest_k(), 3.0) << hours;
      EXPECT_LT(classes.hottest_k() - hottest_k, 12.0) << hours;
      beyond_ten_directions += hottest_k > hottest_of_ten_k + 0.1 || coldest_k < coldest_of_ten_k - 0.1;
    }
  EXPECT_GT(beyond_ten_directions, 3);  // without the margin it fails
}

}  // namespace
}  // namespace ifov::thermal::test_surface_classes
