#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/bsdf/sea/sea.h"
#include "radiometry/refractive_index.h"

namespace ifov::materials {

using radiometry::Spectrum;

double whitecap_share(double wind) { return std::min(1.0, 2.95e-6 * std::pow(wind, 3.52)); }

const Spectrum& whitecap_reflectance() {
  // Every 0.1 um.
  static const Spectrum spectrum = [] {
    constexpr double kFirst = 0.2, kStep = 0.1;
    const std::vector<double> values{0.220, 0.220, 0.220, 0.220, 0.220, 0.220, 0.215, 0.210, 0.200,
                                     0.190, 0.175, 0.155, 0.130, 0.080, 0.100, 0.105, 0.100, 0.080,
                                     0.045, 0.055, 0.065, 0.060, 0.055, 0.040, 0.000};
    std::vector<double> um;
    for (std::size_t k = 0; k < values.size(); ++k) um.push_back(kFirst + kStep * static_cast<double>(k));
    return Spectrum(std::move(um), values, radiometry::OutsideRange::extend, "reflectance of whitecaps");
  }();
  return spectrum;
}

Spectrum sea_water_index(double salinity) {
  const double more = 0.006 * salinity / 34.3;
  return radiometry::refractive_index("water").n.mapped([more](double n) { return n + more; });
}

}  // namespace ifov::materials
