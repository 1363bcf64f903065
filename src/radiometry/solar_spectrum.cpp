#include "radiometry/solar_spectrum.h"

#include <string_view>

#include "radiometry/embedded_table.h"

namespace ifov::data {
extern const std::string_view solar_irradiance_csv;
}

namespace ifov::radiometry {

const Spectrum& solar_irradiance_1au() {
  static const Spectrum spectrum =
      embedded_spectrum(data::solar_irradiance_csv, OutsideRange::zero, "solar irradiance");
  return spectrum;
}

}  // namespace ifov::radiometry
