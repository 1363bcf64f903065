#include "io/envi/wavelength_unit.h"

#include "io/tables/text_table.h"

namespace ifov::io {

std::optional<double> micrometres_per(const std::string& wavelength_units) {
  const std::string unit = lower_case(wavelength_units);
  if (unit.starts_with("micro") || unit == "um") return 1.0;
  if (unit.starts_with("nano") || unit == "nm") return 1e-3;
  return std::nullopt;
}

}  // namespace ifov::io
