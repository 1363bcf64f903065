#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "geodesy/attitude.h"
#include "geodesy/geodetic.h"
#include "geodesy/orbit/sgp4_verification.h"
#include "geodesy/orbit/teme.h"
#include "io/files/input_file.h"
#include "math/angle.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

double frames_there_and_back_m() {
  using namespace geodesy;
  const auto ecef_from_scene = ecef_from_enu({52.0116 * math::kDegree, 4.3571 * math::kDegree, 45.0});
  const auto ecef_of_date = ecef_from_teme(parse_utc("2024-07-01T10:30:00Z"), {-0.02});
  double worst_m = 0.0;
  for (const double height_m : {-400.0, 0.0, 9e3, 250e3, 500e3})
    for (double latitude = -90.0; latitude <= 90.0; latitude += 7.5)
      for (double longitude = -180.0; longitude < 180.0; longitude += 11.25) {
        const Geodetic place{latitude * math::kDegree, longitude * math::kDegree, height_m};
        const EcefPoint ecef = ecef_from_geodetic(place);
        const auto scene_from_body =
            ecef_from_scene.inverse() * ecef_from_enu(place) * enu_from_body({0.4, -0.1, 0.2});
        const BodyPoint lens{{1.5, -0.5, 0.25}};
        worst_m = std::max({worst_m, length(ecef_from_geodetic(geodetic_from_ecef(ecef)) - ecef),
                            length(ecef_from_scene(ecef_from_scene.inverse()(ecef)) - ecef),
                            length(ecef_of_date(ecef_of_date.inverse()(ecef)) - ecef),
                            length(scene_from_body.inverse()(scene_from_body(lens)) - lens)});
      }
  return worst_m;
}

ReportSection orbit_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Orbits and frames";
  section.text =
      "SGP4 with its deep-space part against the positions that Vallado, Crawford, Hujsak and Kelso (2006) verify implementations with, "
      "decays and impossible elements among them. Frames: geodetic, ECEF, ENU, body and TEME, from below the sea to 500 km up, there and back.";
  const auto elements = options.reference.file("orbit_sun/sgp4/SGP4-VER.TLE"),
             answers = options.reference.file("orbit_sun/sgp4/tcppver.out");
  if (!elements || !answers) {
    section.not_measured("sgp4_position", "SGP4: largest difference of a coordinate", "orbit_sun/sgp4");
  } else {
    const geodesy::Sgp4Verification found =
        geodesy::verify_sgp4(io::read_input(*elements), io::read_input(*answers));
    section.figures.at_most("sgp4_position", found.farthest_km(), 1e-6, "km",
                            format("SGP4: largest difference of a coordinate, {} positions of {} satellites",
                                   found.states(), found.satellites.size()));
    section.figures.report("sgp4_velocity", found.fastest_km_s(), "km/s", "and of a velocity's component");
    section.figures.between(
        "sgp4_faults", found.faults_as_made() ? 1.0 : 0.0, 1.0, 1.0, "",
        "elements that were made to fail do so, with the code that they were made for (1: all)");
    Plot plot;
    plot.title = "SGP4 against the verification of 2006";
    plot.x_label = "satellite of the verification, in its order";
    plot.y_label = "largest difference of a coordinate, km";
    plot.y_log = true;
    PlotSeries series{"33 satellites", "#0072b2", {}, {}, true};
    for (std::size_t k = 0; k < found.satellites.size(); ++k) {
      if (found.satellites[k].states == 0) continue;
      series.x.push_back(static_cast<double>(k + 1));
      series.y.push_back(found.satellites[k].farthest_km);
    }
    plot.series = {series};
    plot.levels = {{"must", "#00703c", 1e-6, 0.0}};
    section.plots.push_back(
        {"sgp4", plot, "Positions of the verification are rounded to 1e-8 km: half of that is its own."});
  }
  section.figures.at_most("frames", frames_there_and_back_m(), 1e-3, "m",
                          "frames there and back, up to 500 km: largest distance");
  return section;
}

}  // namespace ifov::studies
