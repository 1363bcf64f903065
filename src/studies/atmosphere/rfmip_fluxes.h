#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace ifov::studies {

/// Fluxes down to the ground of clear columns of RFMIP's first experiment (Pincus et al. 2016), ours and
/// those that RTE+RRTMGP computes, W m-2.
struct RfmipColumn {
  std::size_t site = 0;
  double weight = 0.0;  ///< of the column in the global mean
  double longwave = 0.0, longwave_reference = 0.0;
  double shortwave = 0.0, shortwave_reference = 0.0;     ///< 0 where the Sun is down
  double longwave_stated = 0.0, shortwave_stated = 0.0;  ///< how far the model may be off, by its own table
  double water_in_beam_g_cm2 = 0.0;  ///< water vapour that sunlight crosses, in flat layers
};

struct RfmipQuestion {
  int threads = 0;
  double water_share = 1.0;  ///< of the water vapour that the columns hold
  /// Distances of the wavenumbers that are summed, multiples of 5. At half of 25 the shortwave flux moves by 0.03 %.
  double longwave_step_cm1 = 5.0, shortwave_step_cm1 = 25.0;
};

/// `folder` holds rfmip_inputs.nc, rld.nc and rsd.nc; sites count from 0 to 99.
std::vector<RfmipColumn> rfmip_fluxes(const std::filesystem::path& folder, std::span<const std::size_t> sites,
                                      const RfmipQuestion& question);

}  // namespace ifov::studies
