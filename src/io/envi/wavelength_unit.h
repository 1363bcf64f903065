#pragma once

#include <optional>
#include <string>

namespace ifov::io {

/// Micrometres for each unit of a header's "wavelength units", as ENVI and others write it ("Nanometers", "um"); none where that is
/// neither micrometres nor nanometres.
std::optional<double> micrometres_per(const std::string& wavelength_units);

}  // namespace ifov::io
