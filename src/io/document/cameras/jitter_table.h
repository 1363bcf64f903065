#pragma once

#include <filesystem>

#include "platform/power_spectrum.h"

namespace ifov::io {

/// One-sided power spectra of turns about the body's axes, rad^2 / Hz over Hz.
struct JitterSpectra {
  platform::PowerSpectrum yaw, pitch, roll;
};

/// A table of docs/formats/paths.md. Throws InputError with file, line and column; SystemError where it cannot be read.
JitterSpectra read_jitter_table(const std::filesystem::path& path);

}  // namespace ifov::io
