#include "landscape/streets/road_markings.h"

namespace ifov::landscape {
namespace {

using Section = StreetSection;

constexpr double kLine_m = 0.10;

/// A line beside a street's axis, to its left where `off_m` is positive.
Region line_beside(const Street& street, double off_m) {
  std::vector<Vec2> line;
  for (std::size_t k = 0; k < street.axis.size(); ++k) {
    const Vec2 before = street.axis[k > 0 ? k - 1 : 0],
               after = street.axis[std::min(k + 1, street.axis.size() - 1)];
    line.push_back(street.axis[k] + left_of(unit(after - before)) * off_m);
  }
  return Region::ribbon(line, kLine_m);
}

/// Where a side street meets a main one: `inward` points along the side street, away from the junction.
void paint_junction(const Stand& stand, std::vector<Region>& white) {
  const double middle =
      0.5 * Section::kMainWidth + Section::kKerb + Section::kVerge + 0.5 * Section::kSidewalk;
  const double half = 0.5 * Section::kSideWidth - 0.25;
  for (double x = -half; x + 0.45 <= half; x += 0.95)
    white.push_back(Region::rectangle({stand, x, x + 0.45, middle - 1.3, middle + 1.3}));
  // The lane that leads to the junction is at the left when one looks away from it.
  white.push_back(Region::rectangle({stand, -half, -0.1, middle + 2.3, middle + 2.7}));
}

}  // namespace

RoadMarkings paint_streets(const StreetPlan& streets) {
  std::vector<Region> white, yellow, junctions, crossings;
  for (const Street& side : streets.sides) {
    junctions.push_back(Region::ribbon(side.axis, side.width + 9.0));
    for (const bool at_start : {true, false}) {
      const Vec2 end = at_start ? side.axis.front() : side.axis.back();
      if (std::abs(end.x) > streets.half_m) continue;
      const double last = side.length_m();
      paint_junction({end, side.direction(at_start ? 2.0 : last - 2.0) * (at_start ? 1.0 : -1.0)}, crossings);
    }
  }
  for (const Street& main : streets.mains) {
    for (const double side : {-1.0, 1.0}) {
      yellow.push_back(line_beside(main, side * kLine_m));
      white.push_back(line_beside(main, side * (0.5 * main.width - 2.25)));
    }
  }
  const Region open = Region::all_of(junctions);
  const Region crossing = Region::all_of(crossings);
  return {((Region::all_of(white) - open) + crossing) & streets.asphalt,
          (Region::all_of(yellow) - open) & streets.asphalt};
}

}  // namespace ifov::landscape
