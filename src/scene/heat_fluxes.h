#pragma once

namespace ifov::scene {

/// Heat that a surface gains now, W m-2; all of it together is 0.
struct HeatFluxes {
  double sun = 0.0, sky = 0.0,
         reflected = 0.0;  ///< absorbed sunlight: direct, of the sky, by way of the scene
  double sky_longwave = 0.0, scene_longwave = 0.0, emitted = 0.0;
  double convection = 0.0, latent = 0.0;
  double power = 0.0;       ///< from inside, at the surface
  double conduction = 0.0;  ///< from the solid below
};

}  // namespace ifov::scene
