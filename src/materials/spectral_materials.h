#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "radiometry/spectrum_block.h"

namespace ifov::radiometry {
class SpectralNodes;
}

namespace ifov::materials {

class NodeBsdf;
struct Material;

/// The materials of a scene in the nodes of a sensor: aligned spectra that the integrator multiplies. They are
/// indexed by material, padded and aligned as SpectrumBlock says.
class SpectralMaterials {
 public:
  /// `polarized`: models keep what their polarization needs.
  SpectralMaterials(std::span<const Material> materials, const radiometry::SpectralNodes& nodes,
                    bool polarized = false);
  ~SpectralMaterials();

  std::size_t count() const { return maximum_reflectance_.size(); }
  std::size_t stride() const { return reflectance_.stride(); }
  const float* reflectance(std::uint32_t material) const { return reflectance_.row(material); }
  /// Zero for an opaque one.
  const float* transmittance(std::uint32_t material) const {
    return transmittance_.row(transmittance_index_[material]);
  }
  const float* emissivity(std::uint32_t material) const { return emissivity_.row(material); }
  /// A material whose model is not separable: all of its spectra depend on direction, and those above are bihemispherical.
  /// Null for the others.
  const NodeBsdf* directional(std::uint32_t material) const { return directional_[material].get(); }
  /// Largest value over the nodes, and directions (for Russian roulette).
  float maximum_reflectance(std::uint32_t material) const { return maximum_reflectance_[material]; }
  float maximum_transmittance(std::uint32_t material) const { return maximum_transmittance_[material]; }
  /// Whether light of any material comes straight through, as through a pane; or refracted, as into a medium.
  bool any_pane() const { return any_pane_; }
  bool any_medium() const { return any_medium_; }

 private:
  radiometry::SpectrumBlock reflectance_, emissivity_;
  radiometry::SpectrumBlock transmittance_;  // row 0: of the opaque ones
  std::vector<std::uint32_t> transmittance_index_;
  std::vector<float> maximum_reflectance_, maximum_transmittance_;
  bool any_pane_ = false, any_medium_ = false;
  std::vector<std::unique_ptr<const NodeBsdf>> directional_;
};

}  // namespace ifov::materials
