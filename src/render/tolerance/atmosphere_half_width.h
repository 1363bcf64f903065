#pragma once

namespace ifov::render {

/// How far a channel's radiance may be off because of how the air was computed: the same for every path and every ray, so no number of rays makes it smaller. W m-2 sr-1 um-1.
struct AtmosphereHalfWidth {
  double path = 0.0;           ///< of the light that the path adds
  double surface = 0.0;        ///< of light from surfaces, relative
  double sky = 0.0;            ///< of skylight that they reflect, relative
  double path_radiance = 0.0;  ///< what is above it comes from surfaces
  double white_in_sky = 0.0;   ///< what a white surface reflects of the sky: no surface reflects more
  /// Of a level surface of reflectance 0.2 and 288 K, to say how much all this is.
  double grey_radiance = 0.0;
  double nodes_path = 0.0, nodes_surface = 0.0,
         nodes_sky = 0.0;  ///< what of the first three the few spectral nodes make

  /// How far Q and U of the path, and of the sky that surfaces reflect, may be off beside that, in parts of the radiance (docs/theory/polarization.md).
  double polarization_path = 0.0, polarization_sky = 0.0;

  /// Of Q, U or V of light of this radiance; `before` as below.
  double of_polarization(double radiance, double before = 0.0) const;
  /// What polarizers leave of unpolarized light; all else here is of light before them. 0: there are none.
  double passed = 0.0;

  /// Of radiance as the channel has it; behind polarizers with what Q and U err by, of all light `before` them (0: not known).
  double of(double radiance, double before = 0.0) const;
  /// By the model's own error (docs/theory/atmosphere_model_error.md); 1: intervals hold it, there are clouds, it is that of bands beside a gas model.
  double model_surface = 0.0, model_sunlight = 0.0, model_path = 0.0, model_emission = 0.0, model_sky = 0.0,
         model_counted = 0.0, model_under_clouds = 0.0, model_of_bands = 0.0;
  double of_model(double radiance, double before = 0.0) const;
  double in_interval(double radiance, double before = 0.0) const;
  /// All that an interval holds of the air: numbers, and the model where it is counted.
  double all_of(double radiance, double before = 0.0) const {
    return of(radiance, before) + in_interval(radiance, before);
  }
  /// The nodes' part of it.
  double of_nodes(double radiance) const;

 private:
  double of_polarization_alone(double radiance) const;
  double model_sum(double radiance) const;
  double sum(double of_path, double of_surface, double of_sky, double radiance) const;
};

}  // namespace ifov::render
