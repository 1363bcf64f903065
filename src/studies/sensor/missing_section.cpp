#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

ReportSection missing_section(const SectionOptions&) {
  return unmeasured_of(
      "sensors",
      {{"zernike", "points through Zernike 4 to 11 against quadrature of the pupil: 1 % of the peak",
        "wavefront of the pupil"},
       {"moving_car", "a moving car under a frame of 10 ms and a rolling shutter: 0.02 pixels",
        "rows here; `tests/session/test_moving_objects.py` measures it"},
       {"moving_coverage", "coverage of intervals in scenes that hold what moves: 0.93 to 0.995",
        "rows here; `tests/session/test_moving_objects.py --full` tells, and `test_scanned_coverage.py --full` of scanned, shaken and swept "
        "ones"},
       {"ray_time_cost", "cost of a time in every ray: 2 %", "build without it to compare with"},
       {"products_of_others", "products opened by GDAL, SPy, xarray; cubes of others read and rewritten",
        "other programs here; the tests of `tests/io` and `tests/cli` do so"},
       {"memory", "2048 x 2048 pixels of 210 channels with truth: 2 GiB of memory",
        "measure of one run's memory here"}});
}

}  // namespace ifov::studies
