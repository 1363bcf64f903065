#pragma once

namespace ifov::thermal {

/// Where the heat comes from and goes, W m-2, positive where the surface gains it.
struct Fluxes {
  double sun = 0.0, sky = 0.0, reflected = 0.0;  ///< absorbed sunlight: direct, of the sky, from the ground
  double sky_longwave = 0.0, ground_longwave = 0.0, emitted = 0.0;
  double convection = 0.0, latent = 0.0,
         power = 0.0;  ///< latent: of water that evaporates, and of ice that melts

  double sum() const {
    return sun + sky + reflected + sky_longwave + ground_longwave + emitted + convection + latent + power;
  }
};

}  // namespace ifov::thermal
