#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "atmosphere/profile/profile.h"

namespace ifov::atmosphere {

/// How much of one gas there shall be, in place of the model atmosphere's.
struct GasRequest {
  struct Level {
    double altitude_km = 0.0;  ///< above mean sea level
    double ppmv = 0.0;         ///< of the moist air, by volume
  };
  bool off = false;  ///< none; nothing else is then given
  /// At rising altitudes, linear between; below the first its value holds, above the last the model's own. Empty: the model's.
  std::vector<Level> levels = {};
  /// At most one: the whole profile is scaled to a mixing ratio at the ground, or to a column above it.
  std::optional<double> ground_ppmv = {}, column_atm_cm = {};
};

struct GasRequests {
  std::array<std::optional<GasRequest>, kGasCount> of = {};  ///< in the order of Gas
  bool nitrogen = true;                                      ///< false: its continuum is left out
};

/// The profile with the levels of a request, and what of it had to be made up, in words. InputError where altitudes do not rise or
/// leave the air, or amounts are below 0.
Profile with_gas_levels(const Profile& profile, Gas gas, const GasRequest& request, double ground_km,
                        std::vector<std::string>& remarks);

/// Scales a gas as the request says, or takes it away; water vapour's column is not done here. InputError where there is nothing
/// to be scaled.
void scale_gas(Profile& profile, Gas gas, const GasRequest& request);

/// What 1 g cm-2 of water vapour is in atm-cm.
inline constexpr double kVapourAtmCmPerGram = 6.022045e23 / (18.015 * kLoschmidtCm3);

}  // namespace ifov::atmosphere
