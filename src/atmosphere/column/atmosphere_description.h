#pragma once

#include "atmosphere/gas/gas_model.h"
#include "atmosphere/particles/aerosol_description.h"
#include "atmosphere/profile/profile_description.h"

namespace ifov::atmosphere {

/// All that a user says of an atmosphere; everything has a default.
struct AtmosphereDescription {
  ProfileDescription air;
  AerosolDescription aerosol;
  GasModel gas_model = GasModel::standard;
  std::shared_ptr<const struct GasTermTable> gas_terms = {};  ///< in place of the bands of its gases
  std::optional<double> depolarization = {};  ///< of light that molecules scatter; none: that of air
};

}  // namespace ifov::atmosphere
