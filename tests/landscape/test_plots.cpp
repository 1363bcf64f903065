#include <gtest/gtest.h>

#include "landscape/plots/garden_plan.h"
#include "landscape/plots/plot_plan.h"
#include "landscape/plots/traffic.h"
#include "landscape/things/court.h"

namespace ifov::landscape::test_plots {
namespace {

struct Plan {
  StreetPlan streets;
  PlotPlan plots;
  Plan(double half_m, std::uint64_t seed)
      : streets(plan_streets(half_m, RandomStream(seed))),
        plots(plan_plots(streets, RandomStream(seed).of(1))) {}
};

TEST(Plots, HousesKeepApartAndOffTheStreets) {
  for (const double half_m : {50.0, 120.0, 200.0})
    for (const std::uint64_t seed : {1u, 7u, 12u}) {
      const Plan plan(half_m, seed);
      ASSERT_FALSE(plan.plots.plots.empty());
      const std::vector<Plot>& plots = plan.plots.plots;
      for (std::size_t a = 0; a < plots.size(); ++a) {
        EXPECT_LT((Region::rectangle(plots[a].house_footprint) & plan.streets.corridor).area_m2(), 1e-6);
        EXPECT_FALSE(overlap(plots[a].house_footprint, plan.plots.court_park));
        for (std::size_t b = 0; b < a; ++b)
          EXPECT_LT(
              (Region::rectangle(plots[a].house_footprint) & Region::rectangle(plots[b].house_footprint))
                  .area_m2(),
              1e-6)
              << half_m << " m, seed " << seed << ": houses " << a << " and " << b;
      }
    }
}

TEST(Plots, BothRoofKindsAreBuilt) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Plan plan(50.0, seed);
    int gabled = 0, hipped = 0;
    for (const Plot& plot : plan.plots.plots)
      ++(plan.plots.designs[static_cast<std::size_t>(plot.design)].roof == RoofKind::gabled ? gabled
                                                                                            : hipped);
    EXPECT_GT(gabled, 0) << seed;
    EXPECT_GT(hipped, 0) << seed;
  }
}

TEST(Plots, CarsKeepApart) {
  const Plan plan(120.0, 7);
  const std::vector<ParkedCar> cars = plan_cars(plan.streets, plan.plots, RandomStream(5));
  EXPECT_GT(cars.size(), 20u);
  for (std::size_t a = 0; a < cars.size(); ++a) {
    const Footprint own = car_footprint(cars[a].stand);
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(own, car_footprint(cars[b].stand)));
    for (const Plot& plot : plan.plots.plots) EXPECT_FALSE(overlap(own, plot.house_footprint));
  }
}

TEST(Plots, TreesKeepClearOfHousesAndWires) {
  const Plan plan(120.0, 7);
  const PowerLine line =
      plan_power_line(plan.streets.mains[plan.plots.court_street], plan.plots.plots, 120.0);
  ASSERT_GT(line.poles.size(), 3u);
  std::vector<Stock> stocks{{"a", 4.0, false, {}}, {"b", 2.0, true, {}}};
  plant_trees(stocks, {plan.streets, plan.plots, line}, RandomStream(3));
  std::size_t count = 0;
  for (const Stock& stock : stocks)
    for (const Planted& tree : stock.copies) {
      ++count;
      for (const Plot& plot : plan.plots.plots) {
        EXPECT_GT(distance(plot.house_footprint, tree.at), stock.crown_radius_m * tree.scale);
        EXPECT_GT(distance(plot.driveway, tree.at), 0.5);
      }
      for (const Stand& pole : line.poles)
        EXPECT_GT(length(pole.origin - tree.at), stock.crown_radius_m * tree.scale);
      EXPECT_FALSE(plan.streets.asphalt.contains(tree.at));
    }
  EXPECT_GT(count, 60u);
}

/// Separating axes against areas: rectangles at random.
TEST(Plane, OverlapIsArea) {
  const RandomStream random(11);
  int touching = 0;
  for (int k = 0; k < 400; ++k) {
    const RandomStream draw = random.of(k);
    const auto rectangle = [&](int n) {
      const double angle = draw.between(0.0, 6.28, n);
      return Footprint{{{draw.between(-5.0, 5.0, n + 1), draw.between(-5.0, 5.0, n + 2)},
                        {std::cos(angle), std::sin(angle)}},
                       -draw.between(0.5, 4.0, n + 3),
                       draw.between(0.5, 4.0, n + 4),
                       -draw.between(0.5, 4.0, n + 5),
                       1.0};
    };
    const Footprint a = rectangle(0), b = rectangle(10);
    const double area = (Region::rectangle(a) & Region::rectangle(b)).area_m2();
    if (area > 0.01) {
      EXPECT_TRUE(overlap(a, b)) << k;
    }
    if (!overlap(a, b)) {
      EXPECT_LT(area, 1e-3) << k;
    }
    touching += overlap(a, b);
  }
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 350);
}

}  // namespace
}  // namespace ifov::landscape::test_plots
