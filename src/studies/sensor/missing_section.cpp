#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

ReportSection missing_section(const SectionOptions&) {
  return unmeasured_of(
      "sensors",
      {{"ray_time_cost", "cost of a time in every ray: 2 %", "build without it to compare with"},
       {"products_of_others", "products opened by GDAL, SPy, xarray; cubes of others read and rewritten",
        "other programs here; the tests of `tests/io` and `tests/cli` do so"}});
}

}  // namespace ifov::studies
