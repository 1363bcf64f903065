#pragma once

#include "materials/scattering.h"
#include "render/spectral_scene.h"

namespace ifov::render {

/// What a resolved surface does with the light that meets it, as spectral factors of one shape.
struct SurfaceRows {
  const materials::Scattering* scattering = nullptr;
  const float* reflectance = nullptr;
  const float* transmittance = nullptr;   ///< null: opaque
  double highest_reflectance = 0.0;       ///< at least the largest of each row
  double highest_transmittance = 0.0;
};

/// Constituents of one shape are added up, weighed by area: no chance is in it. Where they have unlike shapes
/// (a mirror in a meadow), `choice` in [0, 1) picks one shape in proportion to weight and brightness, and its rows are
/// divided by that chance: right in the mean, and never above 1 in sum. `scratch` holds 2 stride() floats, 64-byte
/// aligned, and is used for blends only.
SurfaceRows surface_rows(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice,
                         float* scratch);

}  // namespace ifov::render
