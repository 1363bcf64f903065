#include "radiometry/embedded_table.h"

#include <charconv>
#include <utility>
#include <vector>

namespace ifov::radiometry {

Spectrum embedded_spectrum(std::string_view text, OutsideRange outside, std::string name) {
  std::vector<double> wavelength_um, values;
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
    values.push_back(y);
  }
  return Spectrum(std::move(wavelength_um), std::move(values), outside, std::move(name));
}

}  // namespace ifov::radiometry
