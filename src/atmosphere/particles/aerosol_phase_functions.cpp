#include "atmosphere/particles/aerosol_phase_functions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "atmosphere/tables/table_text.h"

namespace ifov::data {
extern const std::string_view atmosphere_phase_functions;
}

namespace ifov::atmosphere {
namespace {

struct PhaseTables {
  struct Numbers {
    double humidity_percent = 0.0;
    std::vector<std::size_t> by_wavelength;
  };
  std::shared_ptr<const PhaseAngles> angles;
  std::map<std::size_t, std::vector<double>> functions;  ///< logarithms, of a mean of 1
  std::vector<double> wavelength_um;
  std::map<std::string, std::vector<Numbers>, std::less<>> kinds;  ///< humidities rise

  static const PhaseTables& instance() {
    static const PhaseTables all;
    return all;
  }

 private:
  PhaseTables() {
    for (const TableSection& section : parse_table_text(data::atmosphere_phase_functions)) {
      const std::string& what = section.words[0];
      if (what == "angles") {
        std::vector<double> angle_rad;
        for (const double degrees : section.values) angle_rad.push_back(degrees * std::numbers::pi / 180.0);
        angles = std::make_shared<const PhaseAngles>(std::move(angle_rad));
      } else if (what == "function") {
        std::vector<double>& logarithms = functions[std::stoul(section.words[1])];
        for (const double per_sr : section.values)
          logarithms.push_back(std::log(4.0 * std::numbers::pi * per_sr));
      } else if (what == "wavelengths") {
        wavelength_um = section.values;
      } else {
        Numbers numbers{std::stod(section.words[2]), {}};
        for (const double number : section.values)
          numbers.by_wavelength.push_back(static_cast<std::size_t>(number));
        kinds[section.words[1]].push_back(std::move(numbers));
      }
    }
  }
};

}  // namespace

AerosolPhaseFunctions::AerosolPhaseFunctions(std::string_view kind, double relative_humidity_percent) {
  const std::vector<PhaseTables::Numbers>& nodes = PhaseTables::instance().kinds.at(std::string(kind));
  const double humidity =
      std::clamp(relative_humidity_percent, nodes.front().humidity_percent, nodes.back().humidity_percent);
  std::size_t i = 0;
  while (i + 2 < nodes.size() && nodes[i + 1].humidity_percent < humidity) ++i;
  const PhaseTables::Numbers &low = nodes[i], &high = nodes[std::min(i + 1, nodes.size() - 1)];
  number_ = {&low.by_wavelength, &high.by_wavelength};
  if (high.humidity_percent > low.humidity_percent)
    above_ = (humidity - low.humidity_percent) / (high.humidity_percent - low.humidity_percent);
}

PhaseFunction AerosolPhaseFunctions::at(double wavelength_um) const {
  const PhaseTables& tables = PhaseTables::instance();
  const std::vector<double>& x = tables.wavelength_um;
  const double um = std::clamp(wavelength_um, x.front(), x.back());
  const std::size_t after = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), um) - x.begin()), 1, x.size() - 1);
  const double longer = (um - x[after - 1]) / (x[after] - x[after - 1]);
  std::vector<double> values(tables.angles->angle_rad.size(), 0.0);
  for (const bool moist : {false, true}) {
    const double weight = moist ? above_ : 1.0 - above_;
    if (!(weight > 0.0)) continue;
    const std::vector<std::size_t>& number = *number_[moist ? 1 : 0];
    const std::vector<double>&a = tables.functions.at(number[after - 1]),
          &b = tables.functions.at(number[after]);
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] += weight * std::exp(std::lerp(a[k], b[k], longer));
  }
  for (double& value : values) value = std::log(value);
  return {tables.angles, std::move(values)};
}

}  // namespace ifov::atmosphere
