#pragma once

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

/// Of a Hapke surface, the same at all wavelengths. The phase function of a grain is
///   P(g) = (1 + backward)/2 F(lobe) + (1 - backward)/2 F(-lobe) + b cos g + c (3 cos^2 g - 1)/2,
/// with g the phase angle (0: light goes straight back) and F Henyey and Greenstein's function, whose asymmetry here is that of
/// light that goes back; its mean over the sphere is 1.
struct HapkeParameters {
  double b0 = 0.0;  ///< height of the opposition surge, 0 to 1
  double h = 0.05;  ///< its width: half its height at a phase angle of 2 atan h
  double b = 0.0, c = 0.0;
  double lobe = 0.0;           ///< asymmetry of both lobes, 0 to below 1
  double backward = 0.0;       ///< 1: all light in the lobe that goes back, -1: in the one that goes on
  double roughness_rad = 0.0;  ///< theta-bar, mean slope angle of the relief below what is resolved
};

/// Soil and regolith, a powder of grains: Hapke 1981 (Bidirectional reflectance spectroscopy 1, J. Geophys. Res. 86, B4) for
/// light scattered once with the opposition surge and, by his two-stream H function, many times; Hapke 1984 (the same, 3:
/// correction for macroscopic roughness, Icarus 59) for relief. The material's reflectance is w, the single-scattering albedo
/// of a grain, which is not the surface's reflectance as a whole. Directions as ReflectionAngles has them.
class Hapke final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// Throws InputError where the phase function would be below 0.
  Hapke(radiometry::Spectrum albedo, const HapkeParameters& parameters);

  std::span<const radiometry::Spectrum> spectra() const override { return {&albedo_, 1}; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

  /// P, by the cosine of the phase angle.
  double phase_function(double cos_phase) const;

  /// Cosines to the facets that are lit and seen, and what relief makes of the BRDF: S x effective cosine of the light / its
  /// cosine. Symmetric in the two directions.
  struct Relief {
    double cos_in, cos_out, factor;
  };
  Relief relief(const ReflectionAngles& angles) const;

 private:
  radiometry::Spectrum albedo_;
  HapkeParameters p_;
  double tan_slope_, mean_cosine_;
};

}  // namespace ifov::materials
