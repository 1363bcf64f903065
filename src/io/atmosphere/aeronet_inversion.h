#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "atmosphere/particles/phase_function_table.h"
#include "io/tables/text_table.h"

namespace ifov::io {

/// One retrieval of AERONET's inversions, version 3 (docs/formats/phase_functions.md): at wavelengths where all three are there.
struct AeronetInversion {
  std::string site, time;             ///< "2019-08-15T21:46:45Z"
  std::vector<double> wavelength_um;  ///< rising
  std::vector<double> optical_depth, single_scattering_albedo, asymmetry;
};

/// Reads a file of all products (.all) or one that joins .aod, .ssa and .asy by its columns: AOD_Extinction-Total[440nm],
/// Single_Scattering_Albedo[440nm], Asymmetry_Factor-Total[440nm] and so on. `time` as in AeronetInversion chooses the retrieval;
/// empty: the file's only one. Throws InputError with the place; SystemError where the file cannot be read.
AeronetInversion read_aeronet_inversion(const std::filesystem::path& path, const std::string& time);
AeronetInversion parse_aeronet_inversion(const TextFile& file, const std::string& time);

/// The phase functions (.pfn) of a retrieval, columns 180.000000[440nm] and so on.
atmosphere::PhaseFunctionTable read_aeronet_phase_functions(const std::filesystem::path& path,
                                                            const std::string& time);
atmosphere::PhaseFunctionTable parse_aeronet_phase_functions(const TextFile& file, const std::string& time);

}  // namespace ifov::io
