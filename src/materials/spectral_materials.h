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

  std::size_t count() const { return maximum_reflectance_.size(); }
  std::size_t stride() const { return reflectance_.stride(); }
  const float* reflectance(std::uint32_t material) const { return reflectance_.row(material); }
  const float* emissivity(std::uint32_t material) const { return emissivity_.row(material); }
  /// Largest reflectance over the nodes (for Russian roulette).
  float maximum_reflectance(std::uint32_t material) const { return maximum_reflectance_[material]; }

 private:
  radiometry::SpectrumBlock reflectance_, emissivity_;
  std::vector<float> maximum_reflectance_;
};

}  // namespace ifov::materials
