#include "session/surface_at.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"

namespace ifov::session {

using materials::Side;
using radiometry::Spectrum;

radiometry::CommonWavelengths wavelengths_of(const materials::Material& material,
                                             const std::optional<double>& wavelength_um) {
  std::vector<const Spectrum*> spectra;
  for (const Spectrum& spectrum : material.bsdf->spectra()) spectra.push_back(&spectrum);
  if (material.bsdf->is_separable()) spectra.push_back(&material.reflectance);
  if (material.transmittance) spectra.push_back(&*material.transmittance);
  const radiometry::CommonWavelengths known = radiometry::common_wavelengths(spectra);
  std::erase_if(spectra, [](const Spectrum* spectrum) { return spectrum->is_constant(); });
  if (spectra.empty()) return known;
  double first = 0.0, last = 1e300;
  for (const Spectrum* spectrum : spectra) {
    first = std::max(first, spectrum->first_um());
    last = std::min(last, spectrum->last_um());
  }
  if (!wavelength_um)
    throw InputError(format(
        "material '{}': its spectra reach from {:g} to {:g} um; say at which wavelength, such as --at {:g}um",
        material.name, first, last, first <= 0.55 && last >= 0.55 ? 0.55 : first));
  for (const Spectrum* spectrum : spectra)
    if (spectrum->outside() == radiometry::OutsideRange::error &&
        (*wavelength_um < spectrum->first_um() || *wavelength_um > spectrum->last_um()))
      throw InputError(
          format("material '{}': {:g} um is outside its spectra, which reach from {:g} to {:g} um",
                 material.name, *wavelength_um, first, last));
  return known;
}

SurfaceAt::SurfaceAt(const materials::Material& material, const std::vector<double>& wavelength_um)
    : material_(material), count_(wavelength_um.size()) {
  for (const Spectrum& spectrum : material.bsdf->spectra()) {
    std::vector<float>& row = rows_.emplace_back();
    for (const double um : wavelength_um) row.push_back(static_cast<float>(spectrum.at(um)));
  }
  for (const std::vector<float>& row : rows_) parameters_.push_back(row.data());
  if (!material.bsdf->is_separable()) return;
  for (const double um : wavelength_um) {
    reflectance_.push_back(material.reflectance.at(um));
    if (material.transmittance) transmittance_.push_back(material.transmittance->at(um));
  }
}

double SurfaceAt::brdf(double light_rad, double view_rad, double azimuth_rad) const {
  materials::BsdfEvent event;
  event.incoming = {std::sin(light_rad), 0.0, std::cos(light_rad)};
  event.outgoing = {std::sin(view_rad) * std::cos(azimuth_rad), std::sin(view_rad) * std::sin(azimuth_rad),
                    std::cos(view_rad)};
  event.normal = {0.0, 0.0, 1.0};
  event.tangent = {1.0, 0.0, 0.0};
  if (material_.bsdf->is_separable()) return reflectance_[0] * material_.bsdf->shape(event);
  std::vector<float> values(count_);
  material_.bsdf->evaluate(event, parameters_, count_, values.data());
  return static_cast<double>(values[0]);
}

SurfaceAt::Shares SurfaceAt::shares(double zenith_rad) const {
  Shares shares{reflectance_, transmittance_, {}};
  if (!material_.bsdf->is_separable()) {
    const auto whole = [&](Side side) {
      std::vector<float> values(count_);
      materials::directional_hemispherical(*material_.bsdf, side, parameters_, count_, std::cos(zenith_rad),
                                           values.data());
      return std::vector<double>(values.begin(), values.end());
    };
    shares.reflectance = whole(Side::reflected);
    if (material_.bsdf->may_transmit()) shares.transmittance = whole(Side::transmitted);
  }
  for (std::size_t n = 0; n < count_; ++n)
    shares.emissivity.push_back(std::max(
        0.0, 1.0 - shares.reflectance[n] - (shares.transmittance.empty() ? 0.0 : shares.transmittance[n])));
  return shares;
}

}  // namespace ifov::session
