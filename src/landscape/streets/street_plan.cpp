#include "landscape/streets/street_plan.h"

#include <algorithm>
#include <cmath>

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr double kMainSpacing_m = 84.0;
constexpr double kSideSpacing_m = 130.0;
constexpr double kBeyond_m = 12.0;  // streets leave the square at full width

}  // namespace

double Street::length_m() const {
  double sum = 0.0;
  for (std::size_t k = 1; k < axis.size(); ++k) sum += length(axis[k] - axis[k - 1]);
  return sum;
}

Vec2 Street::at(double along_m) const {
  for (std::size_t k = 1; k < axis.size(); ++k) {
    const double piece = length(axis[k] - axis[k - 1]);
    if (along_m <= piece || k + 1 == axis.size()) return axis[k - 1] + unit(axis[k] - axis[k - 1]) * along_m;
    along_m -= piece;
  }
  return axis.front();
}

Vec2 Street::direction(double along_m) const { return unit(at(along_m + 1.5) - at(along_m - 1.5)); }

bool StreetPlan::is_clear(const Footprint& footprint) const {
  const double reach = 0.5 * std::hypot(footprint.x1 - footprint.x0, footprint.y1 - footprint.y0) + 10.0;
  const Vec2 middle =
      footprint.stand.at(0.5 * (footprint.x0 + footprint.x1), 0.5 * (footprint.y0 + footprint.y1));
  for (const auto* streets : {&mains, &sides})
    for (const Street& street : *streets)
      for (const Vec2& p : street.axis) {
        if (std::abs(p.x - middle.x) > reach || std::abs(p.y - middle.y) > reach) continue;
        if (distance(footprint, p) < 0.5 * street.width + StreetSection::kCorridor) return false;
      }
  return true;
}

StreetPlan plan_streets(double half_m, const RandomStream& random) {
  StreetPlan plan;
  plan.half_m = half_m;
  const Stand centre;
  plan.domain = Region::rectangle({centre, -half_m, half_m, -half_m, half_m});
  const int mains = std::max(1, static_cast<int>(std::lround(2.0 * half_m / kMainSpacing_m)));
  const double wave = random.between(190.0, 260.0, 0), phase = random.between(0.0, 2.0 * M_PI, 1);
  const double sway = random.between(4.0, 7.0, 2), shift = random.between(-8.0, 8.0, 3);
  // All bend alike, so that the blocks between them keep their depth.
  const auto main_x = [&](int k, double y) {
    return (k - 0.5 * (mains - 1)) * kMainSpacing_m + shift + sway * std::sin(2.0 * M_PI * y / wave + phase);
  };
  for (int k = 0; k < mains; ++k) {
    Street street;
    for (double y = -half_m - kBeyond_m; y <= half_m + kBeyond_m; y += 1.0)
      street.axis.push_back({main_x(k, y), y});
    plan.mains.push_back(std::move(street));
  }
  for (int gap = 0; gap <= mains; ++gap) {
    const RandomStream draw = random.of(gap);
    // Junctions of neighbouring gaps are staggered.
    const double first = -half_m + (gap % 2 == 0 ? 0.35 : 0.85) * kSideSpacing_m + draw.between(-9.0, 9.0, 0);
    for (double y = first; y < half_m - 15.0; y += kSideSpacing_m) {
      if (y < -half_m + 15.0) continue;
      const Vec2 west = gap == 0 ? Vec2{-half_m - kBeyond_m, y} : Vec2{main_x(gap - 1, y), y};
      const Vec2 east = gap == mains ? Vec2{half_m + kBeyond_m, y} : Vec2{main_x(gap, y), y};
      if (east.x - west.x < 30.0) continue;
      Street street;
      street.width = Section::kSideWidth;
      const int steps = static_cast<int>(std::ceil(east.x - west.x));
      for (int k = 0; k <= steps; ++k)
        street.axis.push_back(west + (east - west) * (static_cast<double>(k) / steps));
      plan.sides.push_back(std::move(street));
    }
  }
  std::vector<Region> ribbons;
  for (const auto* streets : {&plan.mains, &plan.sides})
    for (const Street& street : *streets) ribbons.push_back(Region::ribbon(street.axis, street.width));
  // Growing and shrinking again rounds the corners that streets make with each other.
  const Region open = Region::all_of(ribbons).grown(Section::kKerbReturn).grown(-Section::kKerbReturn);
  plan.asphalt = open & plan.domain;
  plan.corridor = open.grown(Section::kCorridor) & plan.domain;
  return plan;
}

}  // namespace ifov::landscape
