#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/tables/text_table.h"

namespace ifov::io {

/// What the input file of libRadtran's uvspec says about its output, which states none of it.
struct UvspecInput {
  bool thermal = false;              ///< source thermal instead of solar
  std::vector<std::string> columns;  ///< of a line without angles: "lambda", "edir", ...
  bool transmittance = false;        ///< output_quantity transmittance
  enum class Density { per_nm, per_cm } density = Density::per_nm;
  std::vector<double> umu, phi_deg;  ///< of radiances; umu above 0 looks down
  std::vector<double> altitude_km;   ///< zout; one level of unknown altitude where it is empty
  double sun_zenith_deg = 0.0;
  std::string name;  ///< of the file, for messages
};

/// Reads the file and what it includes (paths relative to it, or the same name beside it). Throws InputError
/// with file, line and column for what cannot be interpreted: polarized solvers, integrated output,
/// brightness temperatures and reflectivities, unknown columns; SystemError where a file cannot be read.
UvspecInput read_uvspec_input(const std::filesystem::path& path);
/// Without files that it includes.
UvspecInput parse_uvspec_input(const TextFile& file);

}  // namespace ifov::io
