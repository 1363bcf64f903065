#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::atmosphere {

class Particles;

/// A kind of aerosol that documents name: of LOWTRAN7's tables, or a mixture of components.
struct AerosolType {
  std::string name, optics;
  double visibility_km = 0.0;  ///< where none is given
  bool composed =
      false;  ///< `optics` is one of composed_aerosols(), else a kind of data/atmosphere/aerosols.txt
};

/// InputError, with what there is, for a name that there is not.
const AerosolType& aerosol_type(const std::string& name);
const std::vector<std::string>& aerosol_kinds();  ///< their names: aerosol_types() without "none"

/// Particles of a type at a relative humidity, per cent.
std::shared_ptr<const Particles> particles_of(const AerosolType& type, double humidity_percent);
/// Particles of a kind of data/atmosphere/aerosols.txt.
std::shared_ptr<const Particles> tabulated_particles(std::string_view kind, double humidity_percent);

}  // namespace ifov::atmosphere
