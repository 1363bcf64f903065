#pragma once

#include <optional>
#include <string>

#include "radiometry/spectrum.h"

namespace ifov::io {

enum class SampleQuantity { reflectance, transmittance, emissivity };
const char* quantity_name(SampleQuantity quantity);

/// One spectrum of a spectral library or of a field instrument, as the file holds it: fractions, ascending in
/// wavelength, deleted points left out, noise and all. Outside its range it is an error.
struct SampleSpectrum {
  std::string name;
  SampleQuantity quantity = SampleQuantity::reflectance;
  radiometry::Spectrum values;
};

struct WavelengthRange {
  double first_um = 0.0, last_um = 0.0;
};

/// The part of a spectrum within a range, whose ends are interpolated where it has no point there. An
/// InputError where the range is not within the spectrum.
radiometry::Spectrum cut(const radiometry::Spectrum& spectrum, const WavelengthRange& range);

/// Values up to 0.02 below 0 or above 1 are noise of the measurement and become 0 or 1; an InputError names
/// the wavelength of a worse one.
radiometry::Spectrum without_noise(const radiometry::Spectrum& spectrum);

/// A visible-to-shortwave spectrum and a thermal one of the same sample, as one. In an overlap the thermal
/// one counts from its first wavelength on; a gap is bridged by a straight line. Throws InputError where
/// either is a constant or the second does not reach beyond the first.
radiometry::Spectrum join(const radiometry::Spectrum& vswir, const radiometry::Spectrum& tir);

}  // namespace ifov::io
