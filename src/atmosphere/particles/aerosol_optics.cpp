#include "atmosphere/particles/aerosol_optics.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/particles/aerosol_tables.h"
#include "atmosphere/tables/table_text.h"

namespace ifov::atmosphere {
namespace {

std::vector<double> between(const std::vector<double>& low, const std::vector<double>& high, double f) {
  std::vector<double> values(low.size());
  for (std::size_t i = 0; i < low.size(); ++i)
    values[i] = low[i] > 0.0 && high[i] > 0.0 ? low[i] * std::pow(high[i] / low[i], f)
                                              : low[i] + (high[i] - low[i]) * f;
  return values;
}

}  // namespace

AerosolOptics::AerosolOptics(std::string_view kind, double relative_humidity_percent) {
  const auto& all = AerosolTables::instance().optics;
  const std::vector<AerosolTables::Optics>& nodes = all.at(std::string(kind));
  const double humidity =
      std::clamp(relative_humidity_percent, nodes.front().humidity_percent, nodes.back().humidity_percent);
  std::size_t i = 0;
  while (i + 2 < nodes.size() && nodes[i + 1].humidity_percent < humidity) ++i;
  const AerosolTables::Optics& low = nodes[i];
  const AerosolTables::Optics& high = nodes[std::min(i + 1, nodes.size() - 1)];
  const double f = high.humidity_percent > low.humidity_percent
                       ? std::log((100.0 - humidity) / (100.0 - low.humidity_percent)) /
                             std::log((100.0 - high.humidity_percent) / (100.0 - low.humidity_percent))
                       : 0.0;
  wavelength_um_ = low.wavelength_um;
  extinction_ = between(low.extinction, high.extinction, f);
  absorption_ = between(low.absorption, high.absorption, f);
  asymmetry_ = between(low.asymmetry, high.asymmetry, f);
}

AerosolProperties AerosolOptics::at(double wavelength_um) const {
  const auto value = [&](const std::vector<double>& y) {
    return interpolate(wavelength_um_, y, wavelength_um, y.front(), y.back());
  };
  return {value(extinction_), value(absorption_), value(asymmetry_)};
}

}  // namespace ifov::atmosphere
