#include "landscape/plots/garden_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::landscape {
namespace {

using Section = StreetSection;

double distance_to_line(const PowerLine& line, Vec2 at) {
  double nearest = 1e9;
  for (std::size_t k = 0; k + 1 < line.poles.size(); ++k) {
    const Vec2 a = line.poles[k].origin, way = line.poles[k + 1].origin - a;
    const double t = std::clamp(dot(at - a, way) / dot(way, way), 0.0, 1.0);
    nearest = std::min(nearest, length(at - (a + way * t)));
  }
  return nearest;
}

bool near(const Plot& plot, Vec2 at) { return length(plot.stand.origin - at) < 60.0; }

/// Nothing flat that a trunk would grow through within `margin_m`.
bool on_soil(const Obstacles& o, Vec2 at, double margin_m) {
  for (const Plot& plot : o.plots.plots) {
    if (!near(plot, at)) continue;
    if (distance(plot.driveway, at) < margin_m || distance(plot.front_walk, at) < margin_m ||
        distance(plot.patio, at) < margin_m || (plot.has_pool && distance(plot.pool_deck, at) < margin_m))
      return false;
  }
  return true;
}

double distance_to_houses(const Obstacles& o, Vec2 at) {
  double nearest = 1e9;
  for (const Plot& plot : o.plots.plots)
    if (near(plot, at)) nearest = std::min(nearest, distance(plot.house_footprint, at));
  return nearest;
}

class Planting {
 public:
  Planting(std::vector<Stock>& stocks, const Obstacles& obstacles) : stocks_(stocks), obstacles_(obstacles) {}

  /// Whether the tree stands.
  bool try_to_plant(Vec2 at, const RandomStream& draw, bool in_verge) {
    const auto choice = static_cast<std::size_t>(draw.pick(static_cast<int>(stocks_.size()), 50));
    Stock& stock = stocks_[choice];
    if (in_verge && stock.low_branches) return false;
    const Planted tree{at, draw.between(0.0, 2.0 * M_PI, 51), draw.between(0.75, 1.12, 52)};
    const double crown = stock.crown_radius_m * tree.scale;
    const double flat_margin = stock.low_branches ? crown : 0.9;
    if (std::max(std::abs(at.x), std::abs(at.y)) > obstacles_.streets.half_m - 1.0) return false;
    if (!on_soil(obstacles_, at, flat_margin)) return false;
    if (!in_verge &&
        !obstacles_.streets.is_clear({{at}, -flat_margin, flat_margin, -flat_margin, flat_margin}))
      return false;
    if (distance_to_houses(obstacles_, at) < crown + 0.3) return false;
    if (distance_to_line(obstacles_.line, at) < crown + 1.8) return false;
    const Footprint court{obstacles_.plots.court_stand, -18.9, 18.9, -9.7, 9.7};
    if (distance(court, at) < std::max(1.0, 0.55 * crown)) return false;
    for (const auto& [other, radius] : standing_)
      if (length(other - at) < 0.85 * (radius + crown)) return false;
    standing_.emplace_back(at, crown);
    stock.copies.push_back(tree);
    return true;
  }

 private:
  std::vector<Stock>& stocks_;
  const Obstacles& obstacles_;
  std::vector<std::pair<Vec2, double>> standing_;
};

}  // namespace

void plant_trees(std::vector<Stock>& species, const Obstacles& o, const RandomStream& random) {
  Planting planting(species, o);
  for (std::size_t s = 0; s < o.streets.mains.size(); ++s) {
    const Street& street = o.streets.mains[s];
    const double total = street.length_m();
    for (const int side : {1, -1})
      for (double along = 6.0; along < total; along += 3.0) {
        const RandomStream draw = random.of(1, s, side, static_cast<int>(along));
        if (!draw.happens(0.3, 0)) continue;
        const double off = 0.5 * street.width + Section::kKerb + 0.5 * Section::kVerge;
        const Vec2 at = street.at(along) + left_of(street.direction(along)) * (side * off);
        const bool in_junction =
            std::any_of(o.streets.sides.begin(), o.streets.sides.end(), [&](const Street& other) {
              return std::abs(other.axis.front().y - at.y) < 13.0 && at.x > other.axis.front().x - 12.0 &&
                     at.x < other.axis.back().x + 12.0;
            });
        if (!in_junction) planting.try_to_plant(at, draw, true);
      }
  }
  // Around the court, beyond its fence.
  const Footprint& park = o.plots.court_park;
  for (int k = 0; k < 40; ++k) {
    const RandomStream draw = random.of(2, k);
    planting.try_to_plant(
        park.stand.at(draw.between(park.x0, park.x1, 0), draw.between(park.y0, park.y1 + 2.0, 1)), draw,
        false);
  }
  for (const Plot& plot : o.plots.plots) {
    const int wanted = 3 + random.of(3, plot.number).pick(4, 0);
    int standing = 0;
    for (int k = 0; k < 40 && standing < wanted; ++k) {
      const RandomStream draw = random.of(3, plot.number, k);
      const double x = draw.between(-0.5, 0.5, 0) * plot.width, y = draw.between(1.0, plot.depth + 1.0, 1);
      standing += planting.try_to_plant(plot.stand.at(x, y), draw, false);
    }
  }
}

void plant_hedges(std::vector<Stock>& segments, const std::vector<Stock>& trees, const Obstacles& o,
                  const RandomStream& random) {
  std::vector<Vec2> trunks;
  for (const Stock& stock : trees)
    for (const Planted& tree : stock.copies) trunks.push_back(tree.at);
  std::vector<Vec2> placed;
  const auto plant = [&](const Stand& stand, const RandomStream& draw) {
    const Footprint taken{stand, -0.5, 0.5, -0.45, 0.45};
    const Vec2 at = stand.origin;
    if (distance_to_houses(o, at) < 0.9 || !on_soil(o, at, 0.75) || !o.streets.is_clear(taken)) return;
    if (distance(o.plots.court_park, at) < 0.5) return;
    if (std::max(std::abs(at.x), std::abs(at.y)) > o.streets.half_m - 0.6) return;
    for (const Vec2& trunk : trunks)
      if (length(trunk - at) < 0.9) return;
    for (const Vec2& other : placed)
      if (length(other - at) < 0.9) return;
    placed.push_back(at);
    Stock& stock = segments[static_cast<std::size_t>(draw.pick(static_cast<int>(segments.size()), 0))];
    const bool turned = draw.happens(0.5, 1);
    stock.copies.push_back({at, stand.rotation_rad() + (turned ? M_PI : 0.0), draw.between(0.94, 1.0, 2)});
  };
  for (const Plot& plot : o.plots.plots) {
    const RandomStream draw = random.of(plot.number);
    const Stand& stand = plot.stand;
    for (const double side : {-1.0, 1.0}) {
      if (!draw.happens(0.4, side > 0.0)) continue;
      for (int k = 0; k < 22; ++k)
        plant({stand.at(side * 0.5 * plot.width, 11.5 + k), stand.along()}, draw.of(side > 0.0, k));
    }
    if (draw.happens(0.3, 2))
      for (int k = 0; k < static_cast<int>(plot.width) - 1; ++k)
        plant({stand.at(-0.5 * plot.width + 1.0 + k, 0.8), stand.inward}, draw.of(2, k));
    if (draw.happens(0.35, 3))
      for (int k = 0; k < static_cast<int>(plot.width) - 1; ++k)
        plant({stand.at(-0.5 * plot.width + 1.0 + k, plot.depth), stand.inward}, draw.of(3, k));
  }
}

Footprint front_bed(const Plot& plot, const HousePlan& design) {
  // From the free corner of the house to the door.
  const double corner = -design.garage_side * (0.5 * design.width - 0.2),
               door = design.door_x - design.garage_side * 0.9;
  return {plot.house, std::min(corner, door), std::max(corner, door), -1.5, 0.0};
}

void plant_shrubs(std::vector<Stock>& shrubs, const Obstacles& o, const RandomStream& random) {
  for (const Plot& plot : o.plots.plots) {
    const Footprint bed = front_bed(plot, o.plots.designs[static_cast<std::size_t>(plot.design)]);
    int number = 0;
    for (double x = bed.x0 + 0.7; x < bed.x1 - 0.5; x += 1.25, ++number) {
      const RandomStream draw = random.of(plot.number, number);
      if (draw.happens(0.2, 0)) continue;
      Stock& stock = shrubs[static_cast<std::size_t>(draw.pick(static_cast<int>(shrubs.size()), 1))];
      stock.copies.push_back(
          {plot.house.at(x, -0.85), draw.between(0.0, 2.0 * M_PI, 2), draw.between(0.75, 1.0, 3)});
    }
  }
}

}  // namespace ifov::landscape
