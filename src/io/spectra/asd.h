#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/spectra/sample_spectrum.h"

namespace ifov::io {

/// A file of an ASD field spectrometer, versions 1 to 8 ("Indico Version 8 File Format", ASD document
/// 600979): a header of 484 bytes, the spectrum, and from version 2 on the white reference. Reflectance and
/// transmittance are spectrum / reference, or the spectrum itself where the file has no reference and says
/// that this is what it holds. `name` is what messages call the file. Throws InputError where the bytes are
/// not such a file, are cut short, or hold a radiance, an irradiance or counts without a reference.
SampleSpectrum parse_asd(std::string_view bytes, const std::string& name);

/// Of at most 64 MiB; SystemError where it cannot be read.
SampleSpectrum read_asd(const std::filesystem::path& path);

}  // namespace ifov::io
