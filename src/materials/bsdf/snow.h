#pragma once

#include <array>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

/// Deep snow by the asymptotic theory of weakly absorbing media (Kokhanovsky and Zege 2004, Scattering optics of snow, Appl. Opt.
/// 43; Kokhanovsky et al. 2018, On the reflectance spectroscopy of snow, The Cryosphere 12):
///   pi x BRDF = reflectance x R0 r^(u u' / R0), u = 3/7 (1 + 2 cos),
/// with r the spherical albedo (snow_albedo) and R0 the reflectance of snow that does not absorb. The material's reflectance is a
/// factor: 1 for snow that is nothing else. Directions as ReflectionAngles has them.
class Snow final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// `grain_m`: effective diameter, 1.5 times the volume of the grains over their mean projected area. `soot`: its mass
  /// over that of the snow.
  Snow(radiometry::Spectrum reflectance, double grain_m, double soot = 0.0);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  /// Where its spherical albedo is first lower than that of grains of 0.5 mm to 1.3 um (docs/theory/surfaces.md).
  double holds_to_um() const override;
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

  /// R0 as Kokhanovsky and Breon 2012 (IEEE GRSL 9) fit it. To 78 deg its hemispherical integral is within 1.4 % of 1, the one
  /// value that energy allows; at 88.9 deg it is 1.14.
  static double fitted_r0(const ReflectionAngles& angles);
  /// The same times s(cos) s(cos'), which brings the integral to 1 - 1e-4 / cos and leaves it reciprocal; s is within
  /// 1.2 % of 1 to 78 deg, and 0.88 at the horizon.
  static double white_r0(const ReflectionAngles& angles);

 private:
  std::array<radiometry::Spectrum, 2> spectra_;
};

/// r = exp(-sqrt(4 pi L (k + k_soot) / wavelength)), k of ice, L = 16.36 grain diameters. Soot is mixed in from outside:
/// k_soot = 0.47 x 0.9 / 1.6 x its volume over that of the ice, with densities 1270 and 917 kg/m3, 7.6 m2 of absorption a gram
/// at 0.55 um. 0.191 to 160 um.
radiometry::Spectrum snow_albedo(double grain_m, double soot);

}  // namespace ifov::materials
