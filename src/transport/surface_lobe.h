#pragma once

#include "materials/scattering.h"
#include "transport/spectral_scene.h"

namespace ifov::transport {

/// What a resolved surface does with the light that meets it: constituents of one shape, added up.
struct SurfaceLobe {
  const materials::Scattering* scattering = nullptr;
  materials::ScatteringKind kind{};
  double chance = 1.0;                 ///< of that shape; its factors are divided by it
  double highest_reflectance = 0.0;    ///< at least the largest factor in any node
  double highest_transmittance = 0.0;  ///< 0: opaque
};

/// Constituents of one shape are added up, weighed by area: no chance is in it. Where they have unlike shapes
/// (a mirror in a meadow), `choice` in [0, 1) picks one shape in proportion to weight and brightness, and its factors
/// are divided by that chance: right in the mean, and never above 1 in sum.
SurfaceLobe surface_lobe(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice);

/// The lobe's spectral factor, reflectance or (`through`) transmittance; in `scratch` (stride() floats, 64-byte
/// aligned) where the surface has several constituents.
const float* lobe_factor(const SpectralScene& scene, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                         bool through, float* scratch);

}  // namespace ifov::transport
