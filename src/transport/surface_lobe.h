#pragma once

#include "materials/bsdf/bsdf.h"
#include "scene/resolved_surface.h"

namespace ifov::transport {

class SpectralScene;

/// What a resolved surface does with the light that meets it: constituents of one model, added up.
struct SurfaceLobe {
  const materials::Bsdf* bsdf = nullptr;
  bool directional = false;            ///< the model is not separable: events are kept
  bool isotropic = true;               ///< the model has no direction: events need no tangent
  double probability = 1.0;            ///< of that model; its factors are divided by it
  double highest_reflectance = 0.0;    ///< at least the largest factor in any node
  double highest_transmittance = 0.0;  ///< 0: opaque

  /// What weights of a directional lobe, whose shape is 1, are multiplied by where probabilities are made of them without a
  /// spectrum.
  double grey(const materials::BsdfEvent& event) const { return directional ? bsdf->grey(event) : 1.0; }
  /// In place of one model: all constituents that reflect as mirrors, or all that let light through straight on.
  enum class Deltas : std::uint8_t { none, mirrors, panes };
  Deltas deltas = Deltas::none;
};

/// Whether a constituent is one of those that a lobe adds up.
bool belongs(const SpectralScene& scene, const SurfaceLobe& lobe, const scene::Constituent& constituent);

/// Of a lobe that is a delta and not separable, whose factors depend on the angle: puts its highest factors at this view in place of
/// those at any.
void narrow_to_angle(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                     const materials::BsdfEvent& view, SurfaceLobe& lobe);

/// Whether some of a surface lets light through straight on, as panes do.
bool passes_straight(const SpectralScene& scene, const scene::ResolvedSurface& surface);

/// What goes on in any node, at most, where light meets all its mirrors, or all its panes, from a direction.
double highest_of_deltas(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                         const materials::BsdfEvent& view, SurfaceLobe::Deltas deltas);

/// Constituents whose model is the same object are added up, weighed by area: nothing random is in it. Where they have unlike
/// models (a mirror in a meadow), `choice` in [0, 1) picks one in proportion to weight and brightness, and its factors
/// are divided by that probability: right in the mean, and never above 1 in sum.
SurfaceLobe surface_lobe(const SpectralScene& scene, const scene::ResolvedSurface& surface, double choice);

/// An event at a surface as a path keeps it where spectra depend on direction. Under a shading normal light may have come
/// from either of two directions, one of which is the other mirrored by the surface: their BSDFs add up with weights.
struct LobeEvent {
  materials::BsdfEvent event;
  math::Vec3 image;  ///< the other direction
  float weight = 1.0f, image_weight = 0.0f;
};

/// The lobe's spectral factor, reflectance or (`through`) transmittance, or the BSDF of an event where the model is not
/// separable; `event` is null where none was kept, and then the lobe's model is separable. In `scratch` (stride()
/// floats, 64-byte aligned) where the spectrum is not kept; `work` has twice as many.
const float* lobe_factor(const SpectralScene& scene, const scene::ResolvedSurface& surface,
                         const SurfaceLobe& lobe, bool transmitted, const LobeEvent* event, float* scratch,
                         float* work);

}  // namespace ifov::transport
