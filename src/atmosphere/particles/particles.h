#pragma once

#include "atmosphere/particles/aerosol_optics.h"
#include "atmosphere/scattering/phase/phase_function.h"

namespace ifov::atmosphere {

/// By what share of itself what particles do may be off where their depth at 0.55 um is right (docs/theory/atmosphere_clouds.md).
struct ParticleError {
  double extinction = 0.0;    ///< at another wavelength
  double backward = 0.0;      ///< 1 - asymmetry
  double absorbed = 0.0;      ///< 1 - single-scattering albedo
  double by_direction = 0.0;  ///< light scattered once into a single direction, beside that
};

/// What haze or a cloud consists of: its optics by wavelength, from 0.2 to 50 um. May be asked by several threads.
class Particles {
 public:
  static constexpr double kReference_um = 0.55;  ///< of AerosolProperties
  virtual ~Particles() = default;
  /// InputError where something was given that does not reach to this wavelength.
  virtual AerosolProperties properties(double wavelength_um) const = 0;
  virtual PhaseFunction phase_function(double wavelength_um) const = 0;
  /// How far light that they scatter may be off because they are taken for something else (dust for spheres), relative, beside what
  /// the table of the model's error says of haze.
  virtual double scattering_error(double /*wavelength_um*/) const { return 0.0; }
  /// Of a cloud; 0 where they are what they are said to be.
  virtual ParticleError cloud_error(double /*wavelength_um*/) const { return {}; }
};

}  // namespace ifov::atmosphere
