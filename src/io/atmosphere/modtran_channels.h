#pragma once

#include <filesystem>
#include <vector>

#include "atmosphere/imported_path.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// Runs of a MODTRAN channel file (.chn): one path per block of headings and line of sight, its wavelengths
/// the channels' first moments, its widths their equivalent widths, its values means over the channels. All
/// blocks have the same channels. Besides radiances: from MODTRAN's A = T_sun t and B = T_sun T_dif (direct
/// and diffuse reflectance coefficients) and the direct transmittance t of the path, T_sun = A / t is
/// sun_ground_transmittance and B / T_sun is diffuse_ground_sensor_transmittance. Where `sun_zenith_rad` is
/// given, also solar_irradiance = pi (cos TOA_SUN / pi) / cos and two_way_transmittance. Throws InputError
/// with the place.
std::vector<atmosphere::ImportedPath> read_modtran_channels(
    const std::filesystem::path& path, std::optional<double> sun_zenith_rad = std::nullopt);
std::vector<atmosphere::ImportedPath> parse_modtran_channels(
    const TextFile& file, std::optional<double> sun_zenith_rad = std::nullopt);

}  // namespace ifov::io
