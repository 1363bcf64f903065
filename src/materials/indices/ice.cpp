#include "materials/indices/ice.h"

#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ifov::data {
extern const std::string_view index_ice;
}

namespace ifov::materials {
namespace {

/// Third column of a file of data/indices, by the first.
radiometry::Spectrum extinction_index(std::string_view text, std::string name) {
  std::vector<double> wavelength_um, k;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream row(line);
    double um = 0.0, real = 0.0, imaginary = 0.0;
    if (!(row >> um >> real >> imaginary)) continue;
    wavelength_um.push_back(um);
    k.push_back(imaginary);
  }
  return {std::move(wavelength_um), std::move(k), radiometry::OutsideRange::error, std::move(name)};
}

}  // namespace

const radiometry::Spectrum& ice_extinction_index() {
  static const radiometry::Spectrum spectrum = extinction_index(data::index_ice, "absorption of ice");
  return spectrum;
}

}  // namespace ifov::materials
