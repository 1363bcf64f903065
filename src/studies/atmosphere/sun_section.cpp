#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/format.h"
#include "geodesy/sun_position.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/sun_references.h"

namespace ifov::studies {
AtmosphereSection sun_section(const AtmosphereOptions&) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  AtmosphereSection section;
  section.title = "The Sun";
  section.text = "Positions of the Sun (ERFA) against NREL's Solar Position Algorithm.";
  double example = 0.0;
  std::vector<double> sweep;
  for (const SunReference& reference : kSunReferences) {
    const geodesy::SunPosition sun =
        geodesy::sun_position(geodesy::parse_utc(reference.time), reference.latitude_deg * kDegree,
                              reference.longitude_deg * kDegree, reference.height_m);
    const double off =
        math::length(sun.direction_enu - geodesy::direction_enu(reference.azimuth_deg * kDegree,
                                                                reference.elevation_deg * kDegree)) /
        kDegree;
    if (&reference == kSunReferences) example = off;
    sweep.push_back(off);
  }
  std::sort(sweep.begin(), sweep.end());
  section.figures.at_most("sun_example", example, 1e-4, "degrees",
                          "the report's worked example: angle between both");
  section.figures.at_most(
      "sun_sweep", sweep[sweep.size() * 95 / 100], 1e-4, "degrees",
      format("{} places and times from 1950 to 2050: angle that 95 % stay below", sweep.size()));
  section.figures.at_most("sun_sweep_worst", sweep.back(), 3e-4, "degrees",
                          "the largest; the algorithm's own uncertainty is 0.0003 degrees");
  return section;
}

}  // namespace ifov::studies
