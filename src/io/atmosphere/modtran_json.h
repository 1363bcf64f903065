#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/tables/text_table.h"

namespace ifov::io {

/// What a case of a MODTRAN 6 input file (.json) asks for. Fields that the file leaves out are absent; texts
/// are MODTRAN's own words (ATM_MIDLAT_SUMMER, AER_RURAL).
struct ModtranCase {
  std::string name;
  int case_number = 0;
  std::string run_mode;             ///< RTOPTIONS.IEMSCT
  std::string multiple_scattering;  ///< RTOPTIONS.IMULT

  std::string model;  ///< ATMOSPHERE.MODEL
  std::optional<double> co2_ppm;
  /// ATMOSPHERE.H2OSTR with its unit: g cm-2, relative to the model's ("scale"), or cm atm.
  std::optional<double> water_vapour;
  std::string water_vapour_unit;
  std::optional<double> ozone;  ///< in cm atm ("a"), g cm-2 ("g") or relative ("scale")
  std::string ozone_unit;

  std::string aerosol;                              ///< AEROSOLS.IHAZE
  std::optional<double> visibility_km;              ///< AEROSOLS.VIS above 0
  std::optional<double> aerosol_optical_depth_550;  ///< AEROSOLS.VIS below 0: minus the depth

  std::optional<double> sensor_altitude_km, end_altitude_km, ground_altitude_km;
  std::optional<double> zenith_rad;        ///< of the line of sight at the sensor
  std::optional<double> true_azimuth_rad;  ///< of the line of sight, from north by east
  std::optional<int> day_of_year;
  std::optional<double> time_utc_h;
  std::optional<int> sun_option;  ///< GEOMETRY.IPARM, says what the next two are
  std::optional<double> parameter_1, parameter_2;

  std::string surface;                             ///< SURFACE.SURFP.CSALB
  std::optional<double> surface_albedo;            ///< of LAMB_CONST_x_PCT
  std::optional<double> first, last, step, width;  ///< SPECTRAL V1, V2, DV, FWHM
  std::string spectral_unit;                       ///< of these: "cm-1", "nm" or "um"
};

/// All cases of the file. Keys that are not listed above are not looked at. Throws InputError with position,
/// excerpt and expectation.
std::vector<ModtranCase> read_modtran_json(const std::filesystem::path& path);
std::vector<ModtranCase> parse_modtran_json(std::string text, const std::string& file_name);

}  // namespace ifov::io
