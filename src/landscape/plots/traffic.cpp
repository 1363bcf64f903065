#include "landscape/plots/traffic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr std::array kPaints{"car paint, white", "car paint, silver", "car paint, black",
                             "car paint, red",   "car paint, blue",   "car paint, green"};

class Traffic {
 public:
  Traffic(const StreetPlan& streets, const PlotPlan& plots) : streets_(streets), plots_(plots) {}

  void try_to_park(Vec2 at, Vec2 heading, double ground_m, const RandomStream& draw) {
    // A stand's `inward` is what lies left of its `along`.
    const Stand stand{at, left_of(heading)};
    const Footprint taken = car_footprint(stand);
    for (int k = 0; k < 4; ++k)
      if (std::max(std::abs(taken.corner(k).x), std::abs(taken.corner(k).y)) > streets_.half_m) return;
    if (std::any_of(cars_.begin(), cars_.end(), [&](const ParkedCar& other) {
          return overlap(taken.grown(0.25), car_footprint(other.stand));
        }))
      return;
    cars_.push_back({stand, static_cast<CarKind>(draw.pick(kCarKinds, 90)),
                     kPaints[static_cast<std::size_t>(draw.pick(kPaints.size(), 91))], ground_m});
  }

  bool before_a_driveway(Vec2 at) const {
    return std::any_of(plots_.plots.begin(), plots_.plots.end(),
                       [&](const Plot& plot) { return distance(plot.driveway, at) < 4.5; });
  }
  bool near_a_junction(Vec2 at) const {
    return std::any_of(streets_.sides.begin(), streets_.sides.end(), [&](const Street& side) {
      return std::abs(side.axis.front().y - at.y) < 18.0 && at.x > side.axis.front().x - 18.0 &&
             at.x < side.axis.back().x + 18.0;
    });
  }

  std::vector<ParkedCar> take() { return std::move(cars_); }

 private:
  const StreetPlan& streets_;
  const PlotPlan& plots_;
  std::vector<ParkedCar> cars_;
};

}  // namespace

Footprint car_footprint(const Stand& stand) { return {stand, -2.5, 2.5, -1.0, 1.0}; }

std::vector<ParkedCar> plan_cars(const StreetPlan& streets, const PlotPlan& plots,
                                 const RandomStream& random) {
  Traffic traffic(streets, plots);
  for (const Plot& plot : plots.plots) {
    const RandomStream draw = random.of(1, plot.number);
    const HousePlan& house = plots.designs[static_cast<std::size_t>(plot.design)];
    for (const int side : {-1, 1}) {
      if (!draw.happens(0.42, side)) continue;
      const RandomStream own = draw.of(side);
      const Vec2 at =
          plot.house.at(house.garage_middle() + side * 1.32, -house.garage_depth - own.between(3.2, 3.45, 0));
      traffic.try_to_park(at, plot.house.inward * (own.happens(0.7, 1) ? 1.0 : -1.0), Section::kLand, own);
    }
  }
  for (std::size_t s = 0; s < streets.mains.size(); ++s) {
    const Street& street = streets.mains[s];
    const double total = street.length_m();
    for (const int side : {-1, 1})
      for (double along = 6.0; along < total - 6.0; along += 6.5) {
        const RandomStream draw = random.of(2, s, side, static_cast<int>(along));
        const Vec2 way = street.direction(along) * (side > 0 ? -1.0 : 1.0);
        const Vec2 left = left_of(street.direction(along)) * side;
        const Vec2 kerb = street.at(along) + left * (0.5 * street.width - 1.15);
        if (draw.happens(0.2, 0) && !traffic.before_a_driveway(kerb) && !traffic.near_a_junction(kerb))
          traffic.try_to_park(kerb, way, 0.0, draw);
        else if (draw.happens(0.03, 1))
          traffic.try_to_park(street.at(along) + left * 1.2, way, 0.0, draw.of(1));
      }
  }
  return traffic.take();
}

}  // namespace ifov::landscape
