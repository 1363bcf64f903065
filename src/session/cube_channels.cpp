#include "session/cube_channels.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "io/envi/wavelength_unit.h"
#include "io/products/envi_reader.h"
#include "render/image_info.h"

namespace ifov::session {

void require_channels(const io::EnviReader& cube, std::span<const render::ChannelInfo> channels,
                      const std::string& radiance_unit, const std::string& document) {
  const io::EnviHeader& header = cube.header();
  const std::string file = cube.data_path().string();
  const std::size_t bands = static_cast<std::size_t>(header.bands);
  if (bands != channels.size())
    throw InputError(
        format("{}: {} bands, but the sensor of {} has {} channels", file, bands, document, channels.size()));
  if (header.wavelength.size() != bands)
    throw InputError(format(
        "{}: its header has no wavelengths (field 'wavelength'): expected one for each of the {} bands", file,
        bands));
  const std::optional<double> um_per_unit = io::micrometres_per(header.wavelength_units);
  if (!um_per_unit)
    throw InputError(format("{}: its header has wavelength units '{}': expected Micrometers or Nanometers",
                            file, header.wavelength_units));
  if (!header.data_units.empty() && header.data_units != radiance_unit)
    throw InputError(
        format("{}: its values are in '{}': expected {}", file, header.data_units, radiance_unit));
  for (std::size_t c = 0; c < bands; ++c) {
    const double found_um = header.wavelength[c] * *um_per_unit;
    const render::ChannelInfo& channel = channels[c];
    const double apart_um = std::max(0.1 * channel.fwhm_um, 1e-4 * channel.centre_um);
    if (!(std::abs(found_um - channel.centre_um) <= apart_um))
      throw InputError(format(
          "{}: band {} is at {:.5g} um, channel '{}' of {} at {:.5g} um; expected the same channels in the "
          "same order (within {:.2g} um)",
          file, c + 1, found_um, channel.name, document, channel.centre_um, apart_um));
  }
}

}  // namespace ifov::session
