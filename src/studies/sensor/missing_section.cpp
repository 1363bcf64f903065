#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

ReportSection missing_section(const SensorOptions&) {
  ReportSection section;
  section.title = "Not measured";
  section.text =
      "What is asked of sensors and is not measured here, with the reason; none of it counts as met.";
  const auto missing = [&](const char* name, const char* meaning, const char* what) {
    section.not_measured(name, meaning, what);
  };
  missing("zernike", "points through Zernike 4 to 11 against quadrature of the pupil: 1 % of the peak",
          "wavefront of the pupil");
  missing("moving_car", "a moving car under a frame of 10 ms and a rolling shutter: 0.02 pixels",
          "objects that move while they are seen");
  missing("moving_coverage",
          "coverage of intervals in scenes that are scanned, jittered and hold what moves: 0.93 to 0.995",
          "objects that move while they are seen");
  missing("ray_time_cost", "cost of a time in every ray: 2 %", "build without it to compare with");
  missing("products_of_others", "products opened by GDAL, SPy, xarray; cubes of others read and rewritten",
          "other programs here; the tests of `tests/io` and `tests/cli` do so");
  missing("memory", "2048 x 2048 pixels of 210 channels with truth: 2 GiB of memory",
          "measure of one run's memory here");
  return section;
}

}  // namespace ifov::studies
