#pragma once

#include "materials/bsdf/bsdf.h"
#include "scene/resolved_surface.h"
#include "transport/surface_lobe.h"

namespace ifov::transport {

class SpectralScene;

/// As lobe_factor(), the Mueller matrix of a lobe that polarizes and is a delta or not separable, for one of an event's directions. `work` has as
/// many rows as `rows`.
void lobe_mueller(const SpectralScene& scene, const scene::ResolvedSurface& surface, const SurfaceLobe& lobe,
                  const materials::BsdfEvent& event, const materials::MuellerRows& rows, float* work);

}  // namespace ifov::transport
