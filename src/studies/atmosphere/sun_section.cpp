#include <algorithm>
#include <cmath>
#include <vector>

#include "core/format.h"
#include "geodesy/sun_position.h"
#include "math/angle.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/sun_references.h"

namespace ifov::studies {
namespace {

double angle_deg(math::Vec3 a, math::Vec3 b) { return math::length(a - b) / math::kDegree; }

/// The angle that 95 % stay below, and the largest.
struct Sweep {
  std::vector<double> angles_deg;
  double most_of_them() const { return angles_deg[angles_deg.size() * 95 / 100]; }
  double largest() const { return angles_deg.back(); }
};

}  // namespace

AtmosphereSection sun_section(const SectionOptions&) {
  AtmosphereSection section;
  section.title = "The Sun";
  section.text =
      "Positions of the Sun (ERFA) against JPL's ephemeris DE431, as the Swiss Ephemeris 2.10 has it, and "
      "against NREL's Solar Position Algorithm (SPA, Reda and Andreas 2004), whose authors state 0.0003 "
      "degrees. Geometric directions of all, without refraction, at the same UT1 and TT. What ifov and SPA "
      "differ by is SPA's: it keeps the larger terms of the series of VSOP87 alone.";
  Sweep spa, jpl, between;
  for (const SunReference& reference : kSunReferences) {
    const math::Vec3 ours =
        geodesy::sun_position(geodesy::parse_utc(reference.time),
                              {reference.latitude_deg * math::kDegree,
                               reference.longitude_deg * math::kDegree, reference.height_m})
            .direction_enu.v;
    const math::Vec3 by_spa =
        geodesy::direction_enu(reference.azimuth_deg * math::kDegree, reference.elevation_deg * math::kDegree)
            .v;
    const math::Vec3 by_jpl = geodesy::direction_enu(reference.jpl_azimuth_deg * math::kDegree,
                                                     reference.jpl_elevation_deg * math::kDegree)
                                  .v;
    spa.angles_deg.push_back(angle_deg(ours, by_spa));
    jpl.angles_deg.push_back(angle_deg(ours, by_jpl));
    between.angles_deg.push_back(angle_deg(by_spa, by_jpl));
  }
  FigureTable& figures = section.figures;
  figures.at_most("sun_example", spa.angles_deg.front(), 1e-4, "degrees",
                  "the worked example of SPA's report: angle between both");
  for (Sweep* sweep : {&spa, &jpl, &between}) std::sort(sweep->angles_deg.begin(), sweep->angles_deg.end());
  figures.at_most(
      "sun_sweep", jpl.largest(), 1e-4, "degrees",
      format("{} places and times from 1950 to 2050, against DE431: largest angle", jpl.angles_deg.size()));
  figures.at_most("sun_sweep_spa", spa.most_of_them(), 1e-4, "degrees",
                  "the same against SPA: angle that 95 % stay below");
  figures.at_most("sun_sweep_spa_worst", spa.largest(), 3e-4, "degrees", "the largest");
  figures.report("spa_against_jpl", between.largest(), "degrees", "SPA against DE431: the largest");
  return section;
}

}  // namespace ifov::studies
