#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"

namespace ifov::materials {

/// A model that is not separable in the nodes of a sensor. Rows have SpectrumBlock::stride() floats.
class NodeBsdf {
 public:
  /// `polarized`: what the last two functions need is kept.
  NodeBsdf(std::shared_ptr<const Bsdf> bsdf, const radiometry::SpectralNodes& nodes, bool polarized = false);

  const Bsdf& model() const { return *bsdf_; }
  /// 1/sr.
  void evaluate(const BsdfEvent& event, float* spectrum) const {
    bsdf_->evaluate(event, pointers_, parameters_.stride(), spectrum);
  }
  /// Towards a direction of this cosine above the surface: 1 - reflectance - transmittance of light from there (Kirchhoff),
  /// linear between 33 angles; of a delta at that angle itself. A delta uses `work` (stride floats).
  void emissivity(double cosine, float* spectrum, float* work) const;
  /// Largest share of a delta at this angle, in any node.
  double highest_share(const BsdfEvent& view, Side side) const;
  /// What the medium behind the surface absorbs, 1/m; null: nothing.
  const float* absorption() const { return has_absorption_ ? absorption_.row(0) : nullptr; }
  /// Where it was asked for and the model polarizes.
  void evaluate_mueller(const BsdfEvent& event, const MuellerRows& rows) const {
    bsdf_->evaluate_mueller(event, pointers_, parameters_.stride(), rows);
  }
  /// Q of what a black body's radiance would be 1 of, towards a direction of this cosine, in its plane with the normal
  /// (radiometry::surface_frame): -DHR_10 - DHT_10, as emissivity(); U of a mean over azimuths is 0. False: 0, nothing is written.
  bool polarized_emission(double cosine, float* spectrum) const;
  /// Largest directional-hemispherical values in any node and at any of those angles.
  double highest_reflectance() const { return highest_[0]; }
  double highest_transmittance() const { return highest_[1]; }

 private:
  std::shared_ptr<const Bsdf> bsdf_;
  radiometry::SpectrumBlock parameters_;
  std::vector<const float*> pointers_;
  void between_angles(const radiometry::SpectrumBlock& rows, double cosine, float* spectrum) const;
  radiometry::SpectrumBlock emissivity_;  // by angle
  radiometry::SpectrumBlock absorption_;
  bool has_absorption_ = false;
  bool polarized_ = false;
  radiometry::SpectrumBlock emitted_q_;  // likewise; empty: unpolarized
  double highest_[2] = {0.0, 0.0};       // by Side
};

}  // namespace ifov::materials
