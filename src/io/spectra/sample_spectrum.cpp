#include "io/spectra/sample_spectrum.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr double kNoise = 0.02;

}  // namespace

const char* quantity_name(SampleQuantity quantity) {
  switch (quantity) {
    case SampleQuantity::transmittance: return "transmittance";
    case SampleQuantity::emissivity: return "emissivity";
    case SampleQuantity::reflectance: break;
  }
  return "reflectance";
}

radiometry::Spectrum cut(const radiometry::Spectrum& spectrum, const WavelengthRange& range) {
  if (!(range.first_um < range.last_um) || range.first_um < spectrum.first_um() - 1e-9 ||
      range.last_um > spectrum.last_um() + 1e-9)
    throw InputError(
        format("the range {:g} to {:g} um is not within the spectrum, which reaches from {:g} to {:g} um",
               range.first_um, range.last_um, spectrum.first_um(), spectrum.last_um()));
  const double first = std::max(range.first_um, spectrum.first_um());
  const double last = std::min(range.last_um, spectrum.last_um());
  std::vector<double> wavelength_um{first}, values{spectrum.at(first)};
  for (std::size_t i = 0; i < spectrum.values().size(); ++i) {
    if (spectrum.wavelength_um()[i] <= first || spectrum.wavelength_um()[i] >= last) continue;
    wavelength_um.push_back(spectrum.wavelength_um()[i]);
    values.push_back(spectrum.values()[i]);
  }
  wavelength_um.push_back(last);
  values.push_back(spectrum.at(last));
  return radiometry::Spectrum(std::move(wavelength_um), std::move(values), spectrum.outside(),
                              spectrum.name());
}

radiometry::Spectrum without_noise(const radiometry::Spectrum& spectrum) {
  for (std::size_t i = 0; i < spectrum.values().size(); ++i) {
    const double value = spectrum.values()[i];
    if (value < -kNoise || value > 1.0 + kNoise)
      throw InputError(
          format("'{}' holds {:g} at {:g} um; expected 0 to 1 ('range' cuts a spectrum, 'scale' multiplies)",
                 spectrum.name(), value, spectrum.is_constant() ? 0.0 : spectrum.wavelength_um()[i]));
  }
  return spectrum.mapped([](double value) { return std::clamp(value, 0.0, 1.0); });
}

radiometry::Spectrum join(const radiometry::Spectrum& vswir, const radiometry::Spectrum& tir) {
  if (vswir.is_constant() || tir.is_constant() || tir.last_um() <= vswir.last_um() ||
      tir.first_um() <= vswir.first_um())
    throw InputError(format("'{}' and '{}' do not join: expected a second spectrum of longer wavelengths",
                            vswir.name(), tir.name()));
  std::vector<double> wavelength_um, values;
  for (std::size_t i = 0; i < vswir.values().size() && vswir.wavelength_um()[i] < tir.first_um(); ++i) {
    wavelength_um.push_back(vswir.wavelength_um()[i]);
    values.push_back(vswir.values()[i]);
  }
  wavelength_um.insert(wavelength_um.end(), tir.wavelength_um().begin(), tir.wavelength_um().end());
  values.insert(values.end(), tir.values().begin(), tir.values().end());
  return radiometry::Spectrum(std::move(wavelength_um), std::move(values), vswir.outside(), vswir.name());
}

}  // namespace ifov::io
