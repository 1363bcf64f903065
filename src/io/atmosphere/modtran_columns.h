#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "atmosphere/imported_path.h"
#include "io/atmosphere/spectral_table.h"

namespace ifov::io {

/// What the spectral output of MODTRAN holds: its run mode IEMSCT.
enum class ModtranMode { transmittance, thermal_radiance, radiance, solar_irradiance };

/// MODTRAN's own name of a column from any of its spellings ("PTH THRML", "path emission", "THRML_EM"): as in
/// tape7, with underscores. Nothing for what is none of those used here.
std::optional<std::string> modtran_column(std::string_view heading);

/// The unit that the heading of a spectral column says: "FREQ" (cm-1), "FREQ CM-1", "WAVLEN MCRN",
/// "wavelength [nm]"; a bare "WAVELENGTH" says none. Nothing as well for other headings.
struct SpectralHeading {
  std::optional<WavelengthUnit> unit;
};
std::optional<SpectralHeading> modtran_spectral_heading(std::string_view heading);

/// A path from MODTRAN's columns, radiances in W cm-2 sr-1 and irradiances in W cm-2 per unit of the table's
/// spectral column. Where TOTAL_RAD is there, its parts must add up to it within the rounding of the file,
/// else the columns were taken for what they are not: InputError.
atmosphere::ImportedPath modtran_path(const SpectralTable& table, ModtranMode mode, std::string source);

}  // namespace ifov::io
