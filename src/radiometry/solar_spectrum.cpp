#include "radiometry/solar_spectrum.h"

#include <charconv>
#include <string_view>
#include <vector>

namespace ifov::data {
extern const std::string_view solar_irradiance_csv;
}

namespace ifov::radiometry {
namespace {

Spectrum parse(std::string_view text) {
  std::vector<double> wavelength_um, irradiance;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    double x = 0.0, y = 0.0;
    const std::size_t comma = line.find(',');
    std::from_chars(line.data(), line.data() + comma, x);
    std::from_chars(line.data() + comma + 1, line.data() + line.size(), y);
    wavelength_um.push_back(x);
    irradiance.push_back(y);
  }
  return Spectrum(std::move(wavelength_um), std::move(irradiance), OutsideRange::zero, "solar irradiance");
}

}  // namespace

const Spectrum& solar_irradiance_1au() {
  static const Spectrum spectrum = parse(data::solar_irradiance_csv);
  return spectrum;
}

}  // namespace ifov::radiometry
