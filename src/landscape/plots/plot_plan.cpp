#include "landscape/plots/plot_plan.h"

#include <algorithm>
#include <cmath>

#include "landscape/things/court.h"

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr double kPlotDepth_m = 33.0;
constexpr double kBetweenHouses_m = 3.0;
constexpr int kDesigns = 18;

/// The place on the sidewalk's inner edge, on the left (+1) or right (-1) of a street.
Stand frontage(const Street& street, double along_m, int side) {
  const Vec2 inward = left_of(street.direction(along_m)) * side;
  return {street.at(along_m) + inward * (0.5 * street.width + Section::kCorridor), inward};
}

bool inside(const Footprint& footprint, double half_m) {
  for (int k = 0; k < 4; ++k) {
    const Vec2 corner = footprint.corner(k);
    if (std::max(std::abs(corner.x), std::abs(corner.y)) > half_m) return false;
  }
  return true;
}

/// Where a house with its garden goes on a plot.
void furnish(Plot& plot, const HousePlan& design, const RandomStream& random) {
  const double setback = random.between(6.0, 8.0, 0) + design.garage_depth;
  const double room = 0.5 * (plot.width - design.width) - 1.6;
  plot.house = {plot.stand.at(std::clamp(random.between(-1.0, 1.0, 1), -room, room), setback),
                plot.stand.inward};
  plot.house_footprint = design.footprint(plot.house);
  const double garage = design.garage_middle(), reach = setback + Section::kCorridor + 1.0;
  plot.driveway = {plot.house, garage - 2.7, garage + 2.7, -reach, -design.garage_depth};
  plot.front_walk = {plot.house, design.door_x - 0.6, design.door_x + 0.6, -setback, -1.2};
  plot.patio = {plot.house, -0.5 * design.width + 0.5, random.between(0.0, 3.0, 2), design.depth,
                design.depth + random.between(3.0, 4.5, 3)};
  plot.paved_driveway = random.happens(0.65, 4);
  plot.has_pool = random.happens(0.22, 5);
  const double pool_y = design.depth + random.between(6.8, 7.5, 6);
  const double pool_x = random.between(-3.0, -1.0, 7), length = random.between(7.0, 9.0, 8);
  plot.pool = {plot.house, pool_x, pool_x + length, pool_y, pool_y + 3.8};
  plot.pool_deck = plot.pool.grown(0.9);
}

}  // namespace

PlotPlan plan_plots(const StreetPlan& streets, const RandomStream& random) {
  PlotPlan plan;
  for (int k = 0; k < kDesigns; ++k) plan.designs.push_back(draw_house(random.of(1, k)));
  plan.designs[0].roof = RoofKind::gabled;
  plan.designs[1].roof = RoofKind::hipped;

  double nearest = 1e9;
  for (std::size_t s = 0; s < streets.mains.size(); ++s) {
    const Street& street = streets.mains[s];
    const double total = street.length_m();
    for (const int side : {1, -1})
      for (double along = 30.0; along < total - 30.0; along += 4.0) {
        const Stand stand = frontage(street, along, side);
        const Footprint park{stand, -0.5 * CourtSize::kLot_length - 2.0, 0.5 * CourtSize::kLot_length + 2.0,
                             2.5, CourtSize::kLot_width + 8.0};
        const Vec2 middle = stand.at(0.0, 0.5 * (park.y0 + park.y1));
        const double off = length(middle);
        if (off >= nearest || !streets.is_clear(park)) continue;
        nearest = off;
        plan.court_stand = {middle, stand.inward};
        plan.court_park = park;
        plan.court_street = s;
      }
  }

  int number = 0;
  for (std::size_t s = 0; s < streets.mains.size(); ++s)
    for (const int side : {1, -1}) {
      const Street& street = streets.mains[s];
      const double total = street.length_m();
      double along = 8.0 + random.of(2, s, side).between(0.0, 6.0, 0);
      while (along < total) {
        const RandomStream draw = random.of(3, s, side, static_cast<int>(along));
        Plot plot;
        plot.width = draw.between(19.0, 22.5, 0);
        plot.depth = kPlotDepth_m;
        // Two short designs in a row look alike, so neighbours are drawn apart.
        plot.design = number < 2 ? number : (draw.pick(kDesigns, 1) + number) % kDesigns;
        const double middle = along + 0.5 * plot.width;
        if (middle > total) break;
        plot.stand = frontage(street, middle, side);
        furnish(plot, plan.designs[static_cast<std::size_t>(plot.design)], draw);
        const Footprint house = plot.house_footprint;
        const bool free = streets.is_clear(house.grown(2.0)) && inside(house.grown(1.0), streets.half_m) &&
                          !overlap(house.grown(1.0), plan.court_park) &&
                          std::none_of(plan.plots.begin(), plan.plots.end(), [&](const Plot& other) {
                            return overlap(house.grown(kBetweenHouses_m), other.house_footprint);
                          });
        if (!free) {
          along += 3.0;
          continue;
        }
        const bool pool_free =
            streets.is_clear(plot.pool_deck.grown(1.0)) && !overlap(plot.pool_deck, plan.court_park) &&
            inside(plot.pool_deck, streets.half_m) &&
            std::none_of(plan.plots.begin(), plan.plots.end(), [&](const Plot& other) {
              return overlap(plot.pool_deck.grown(1.0), other.house_footprint) ||
                     (other.has_pool && overlap(plot.pool_deck.grown(0.5), other.pool_deck));
            });
        plot.has_pool = plot.has_pool && pool_free;
        plot.number = ++number;
        plan.plots.push_back(plot);
        along += plot.width;
      }
    }
  return plan;
}

}  // namespace ifov::landscape
