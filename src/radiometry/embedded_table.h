#pragma once

#include <string>
#include <string_view>

#include "radiometry/spectrum.h"

namespace ifov::radiometry {

/// A spectrum that is compiled in: the lines of a file of data/ that begin with a digit, wavelength in um and value.
Spectrum embedded_spectrum(std::string_view csv, OutsideRange outside, std::string name);

}  // namespace ifov::radiometry
