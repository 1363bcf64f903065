#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "materials/material.h"
#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"

namespace ifov::materials {

/// The materials of a scene in the nodes of a sensor: aligned rows that the integrator multiplies. Rows are
/// indexed by material, padded and aligned as SpectrumBlock says.
class SpectralMaterials {
 public:
  SpectralMaterials(std::span<const Material> materials, const radiometry::SpectralNodes& nodes);

  std::size_t count() const { return scattering_.size(); }
  std::size_t stride() const { return reflectance_.stride(); }
  const float* reflectance(std::uint32_t material) const { return reflectance_.row(material); }
  const float* emissivity(std::uint32_t material) const { return emissivity_.row(material); }
  /// Emissivity x blackbody radiance at the material's own temperature; zeros where it has none.
  const float* emission(std::uint32_t material) const { return emission_.row(material); }
  bool emits(std::uint32_t material) const { return emits_[material] != 0; }
  /// Largest reflectance over the nodes (for Russian roulette).
  float maximum_reflectance(std::uint32_t material) const { return maximum_reflectance_[material]; }
  /// Reflects nothing in any node: paths end here.
  bool is_black(std::uint32_t material) const { return maximum_reflectance_[material] == 0.0f; }
  const Scattering& scattering(std::uint32_t material) const { return *scattering_[material]; }

 private:
  radiometry::SpectrumBlock reflectance_, emissivity_, emission_;
  std::vector<std::uint8_t> emits_;
  std::vector<float> maximum_reflectance_;
  std::vector<const Scattering*> scattering_;
};

}  // namespace ifov::materials
